"""Logs of drives that others open, and logs of others: MCAP and rosbag2."""
