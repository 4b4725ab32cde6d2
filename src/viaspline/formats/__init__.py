"""Other people's mission files: QGroundControl plans and QGC WPL texts."""
