"""Mission files, one file a kind: YAML, QGroundControl plans and QGC WPL texts."""
