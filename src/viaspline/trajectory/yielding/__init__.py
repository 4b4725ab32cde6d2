"""The time law on a fixed path among things that move: waiting, slowing, passing before."""
