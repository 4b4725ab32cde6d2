"""What a notebook shows of a value: facts, pictures on plain axes, pages."""
