"""Numbers for people: so many decimals, or more where these would leave nothing of a number."""

from __future__ import annotations

LEAST_TOLD = 1e-4
"""What is smaller is told as 0."""


def rounded(value: float, digits: int) -> str:
    """A number with so many decimals; with two significant digits where it is too small for them.

    Args:
        value: The number.
        digits: How many decimals most such numbers have.

    >>> rounded(812.345, 1), rounded(0.183, 1), rounded(0.0046, 2)
    ('812.3', '0.18', '0.0046')
    >>> rounded(-0.0, 2), rounded(1e-6, 2), rounded(0.09999, 2)
    ('0.00', '0.00', '0.10')
    """
    if LEAST_TOLD <= abs(value) < 10.0 ** (1 - digits):
        return f"{value:#.2g}".rstrip(".")
    return f"{value + 0.0:.{digits}f}"
