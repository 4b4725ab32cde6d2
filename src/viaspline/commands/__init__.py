"""Commands of the command line, one file each; ``viaspline.cli`` has the oldest."""
