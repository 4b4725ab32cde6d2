"""What a value of the package is to those who have it in a notebook: compared, told, shown, kept.

Most of that is done by rooms above, which a value mustn't import: see ``upper_doors``.
"""
