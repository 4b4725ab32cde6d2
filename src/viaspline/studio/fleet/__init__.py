"""A fleet in the studio: its document planned robot by robot, and what the page is told of it."""
