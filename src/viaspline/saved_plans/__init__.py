"""Plans that were saved, read again and proven again."""
