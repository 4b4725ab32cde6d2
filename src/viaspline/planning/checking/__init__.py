"""Is a path clear, and what does it cost?"""
