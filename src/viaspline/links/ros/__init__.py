"""A robot that speaks ROS 2: beside it, without an installation of it."""
