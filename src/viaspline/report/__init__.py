"""Files, tables and pictures of plans and runs."""
