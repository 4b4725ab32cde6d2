"""Drives, one file each: what moves a robot, what it asks of a time law, what it can't do."""
