"""When each robot of a fleet drives along its path: by priority, by forced orders, improved."""
