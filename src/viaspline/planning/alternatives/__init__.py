"""The sides on which obstacles may be passed: laid, compared, recorded."""
