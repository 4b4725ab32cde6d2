"""Colours and sizes of every picture.

The colours are Okabe and Ito's, which stay apart for every common kind of colour blindness; what
matters differs in shape or dash as well.
"""

from __future__ import annotations

import re
from unicodedata import bidirectional

DPI = 135

INK = "#1b1f24"
MUTED = "#6a737d"
OBSTACLE = "#aeb5bf"
OBSTACLE_EDGE = "#4d5661"
OBSTACLES = (  # further maps: fill and edge
    (OBSTACLE, OBSTACLE_EDGE),
    ("#d3c3dd", "#7d6590"),
    ("#c5d3b8", "#64784f"),
)
UNKNOWN = "#dfe3e8"
UNKNOWN_STRIPE = "#b9c1ca"
OUTSIDE = "#e9ebee"
RING = "#6f7985"
PATH = "#0072b2"
OLD_PATH = "#8c6d31"
DETOUR = "#e69f00"
LOSER = "#a0468c"
TIGHTEST = "#d55e00"
SHARPEST = "#b3437f"
UNSEEN = "#d55e00"
UNSEEN_FILL = "#fbe3d3"
FAINT = "#e5b595"
FAINT_FILL = "#fdf3ec"
START = "#009e73"
GOAL = "#1b1f24"
STATION = "#f0e442"
SENSOR = "#56b4e9"
SWEPT = "#d0eaf9"  # opaque: its parts lie over each other
BODY = "#2f6f9f"
MOVING = "#c2410c"
MOVING_FILL = "#f6c7a8"
ZONE = "#fbeecb"
ZONE_INK = "#8a5a00"
SPEED_MAP = "viridis"

TITLE_PT = 13.0  # points
TEXT_PT = 9.0
SMALL_PT = 7.5

PATH_WIDTH_PT = 2.0

AROUND_PT = 14.5  # of a mark around a place, wider than the numbered mark of a via point
AROUND_MARKS = 11.5  # the layer of such marks, under those of via points, whose numbers stay seen

LEFT_TO_RIGHT = "\u200e"


def without_folder(name: str) -> str:
    """What a thing is called, with just the file of the map that it is on.

    Example:
        >>> without_folder("map 'sites/north/depot.yaml' at (7.50, 4.39)")
        "map 'depot.yaml' at (7.50, 4.39)"
    """
    return re.sub(r"map '[^']*[/\\\\]([^'/\\\\]+)'", r"map '\1'", name)


def short(name: str, length: int = 28) -> str:
    r"""A name that fits on a picture: one line, not too long.

    Example:
        >>> short("pump house" * 5, 12)
        'pump housep…'
    >>> short("שער")
    '\u200eשער\u200e'
    """
    line = " ".join(name.split())
    if len(line) > length:
        line = line[: length - 1] + "…"
    is_right_to_left = any(bidirectional(letter) in ("R", "AL") for letter in line)
    # marks of no width: what stands before and after such a name keeps its place
    return f"{LEFT_TO_RIGHT}{line}{LEFT_TO_RIGHT}" if is_right_to_left else line
