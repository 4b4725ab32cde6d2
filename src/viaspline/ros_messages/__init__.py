"""Messages of ROS 2: their definitions, their bytes, and what viaspline says in them."""
