"""The colours of a fleet's robots."""

from __future__ import annotations

from typing import Final

ROBOT_COLOURS: Final = (
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#0000ff", "#443311",
    "#440088", "#ee0055", "#ee22ff", "#660033", "#99bb55", "#bb0099", "#00626e", "#994433",
    "#ccaa77", "#4488ff", "#7a7a00", "#225500",
)  # fmt: skip
"""Okabe and Ito's without those that are too pale for a line on white paper, then each as far from
all before it as there is one, for common kinds of colour blindness as well."""

MAX_TOLD_APART: Final = len(ROBOT_COLOURS)
"""Robots of a fleet, beyond which colours come again: names and legends can't go by them."""


def colours_of(count: int) -> list[str]:
    """A colour for each robot of a fleet; beyond twenty they begin anew.

    Example:
        >>> colours_of(2), colours_of(1000)[999] == colours_of(20)[19]
        (['#0072b2', '#d55e00'], True)
    """
    return [ROBOT_COLOURS[robot % MAX_TOLD_APART] for robot in range(count)]
