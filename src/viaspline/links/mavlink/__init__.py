"""MAVLink: missions to and from autopilots, and driving them."""
