"""Gates: the sides on which a leg may pass solids. See ``kernels/space/routing/side_gates``.

On a leg from start to goal a path passes a solid *on the left* (right) if wherever it crosses the
upright plane through the solid's middle, across the line from start to goal in plan, it does so
left (right) of all that the solid covers of this plane; it passes *over* (under) if it does so
above (below) the middle of what it covers.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Final, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.routing.side_gates import LEFT, OVER, RIGHT, UNDER
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Box6, Prism, RoundedSegment, Solid

PassSide: TypeAlias = Literal["left", "right", "over", "under"]

SIDE_BITS: Final[dict[PassSide, int]] = {
    "left": LEFT,
    "right": RIGHT,
    "over": OVER,
    "under": UNDER,
}

NO_GATES: Final[Floats] = np.empty((0, 8))


def gate(solid: Solid, start: ArrayLike, goal: ArrayLike, allowed: Iterable[PassSide]) -> Floats:
    """The gate of a solid on the leg between two places.

    Args:
        solid: That is to be passed.
        start: [m], (3,).
        goal: [m], (3,).
        allowed: The sides on which it may be passed.

    Returns:
        One row, (1, 8); several are stacked. No row where start and goal lie over each other, for
        then no side is left or right.

    >>> from viaspline.mission.shapes.rounded_ring import RoundedRing
    >>> mast = Prism(RoundedRing([[(50.0, 0.0)]], 2.0), 0.0, 20.0)
    >>> gate(mast, (0, 0, 5), (100, 0, 5), ["left"]).tolist()
    [[50.0, 0.0, 1.0, 0.0, -2.0, 2.0, 10.0, 1.0]]
    >>> gate(mast, (0, 0, 5), (100, 0, 5), ["over"])[0, 6:].tolist()  # over all of it
    [20.0, 4.0]
    """
    ends = np.array([start, goal], np.float64)
    dx, dy = (ends[1, :2] - ends[0, :2]).tolist()
    length = math.hypot(dx, dy)
    if length == 0.0:
        return NO_GATES
    ahead = dx / length, dy / length
    x0, y0, low, x1, y1, high = _box(solid)
    x, y = 0.5 * (x0 + x1), 0.5 * (y0 + y1)
    least, most, low, high = _covered(solid, (x, y), ahead, (low, high))
    middle = low if low == -math.inf else high if high == math.inf else 0.5 * (low + high)
    bits = sum(SIDE_BITS[side] for side in set(allowed))
    if bits in (OVER, UNDER) and isinstance(solid, Prism) and fills_gate(solid, (x, y), ahead):
        middle = high if bits == OVER else low  # nothing passes in between, and a search knows it
    return np.array([[x, y, *ahead, least, most, middle, float(bits)]])


def without(sides: Iterable[PassSide]) -> tuple[PassSide, ...]:
    """All the other sides.

    >>> without(["over"])
    ('left', 'right', 'under')
    """
    left_out = set(sides)
    return tuple(side for side in SIDE_BITS if side not in left_out)


def _box(solid: Solid) -> Box6:
    return solid.extent if isinstance(solid, Voxels) else solid.box


def _covered(
    solid: Solid,
    middle: tuple[float, float],
    ahead: tuple[float, float],
    heights: tuple[float, float],
) -> tuple[float, float, float, float]:
    """What a solid covers of its gate: from where to where to the left, and in height [m]."""
    if isinstance(solid, RoundedSegment):
        return _covered_by_line(solid, middle, ahead)
    if isinstance(solid, Prism):
        if solid.ring.is_disc:
            return -solid.ring.radius, solid.ring.radius, *heights
        section = section_of(solid.ring, middle, ahead)
        if not len(section):  # a hole in the middle of a bent shape
            import shapely

            section = shapely.get_coordinates(solid.ring.outline()) - middle
        along = section @ np.array([-ahead[1], ahead[0]])
        return float(along.min()), float(along.max()), *heights
    box = _box(solid)
    corners = np.array([(x, y) for x in box[::3] for y in box[1::3]])
    along = (corners - middle) @ np.array([-ahead[1], ahead[0]])
    return float(along.min()), float(along.max()), *heights


def section_of(
    ring: RoundedRing, middle: tuple[float, float], ahead: tuple[float, float]
) -> Floats:
    """Where the outline of a ring crosses a line in plan.

    Args:
        ring: It.
        middle: A place of the line [m].
        ahead: The direction across the line, a unit vector.

    Returns:
        Ends of the parts of the line that the ring covers, from the middle [m], shape (k, 2).
    """
    import shapely

    left = np.array([-ahead[1], ahead[0]])
    x0, y0, x1, y1 = ring.box
    reach = math.hypot(x1 - x0, y1 - y0)
    line = shapely.LineString([middle - reach * left, middle + reach * left])
    crossed = shapely.get_coordinates(ring.outline().intersection(line))
    return np.asarray(crossed - middle)


def fills_gate(solid: Prism, middle: tuple[float, float], ahead: tuple[float, float]) -> bool:
    """Whether a prism covers its gate without a gap, from its one side to its other.

    Args:
        solid: The prism.
        middle: Of its gate, in plan [m].
        ahead: The direction across the gate, a unit vector.
    """
    return solid.ring.is_disc or len(section_of(solid.ring, middle, ahead)) == 2


def _covered_by_line(
    solid: RoundedSegment, middle: tuple[float, float], ahead: tuple[float, float]
) -> tuple[float, float, float, float]:
    """What a cable or a ball covers: the part of its line that is no farther than its radius."""
    ends = np.array([solid.first, solid.last])
    off = (ends[:, :2] - middle) @ np.array(ahead)
    t = np.array([0.0, 1.0])
    if off[0] != off[1]:
        t = np.clip((np.array([-solid.radius, solid.radius]) - off[0]) / (off[1] - off[0]), 0, 1)
    part = ends[0] + t[:, None] * (ends[1] - ends[0])
    along = (part[:, :2] - middle) @ np.array([-ahead[1], ahead[0]])
    r = solid.radius
    return (
        float(along.min()) - r, float(along.max()) + r,
        float(part[:, 2].min()) - r, float(part[:, 2].max()) + r,
    )  # fmt: skip
