"""The studio: a page in the browser where a mission is laid out, planned live and driven.

The page only draws. It edits a mission document (what a mission file holds, as JSON), sends the
parts that have changed, and is answered with the plan that the command line would make of it.
"""
