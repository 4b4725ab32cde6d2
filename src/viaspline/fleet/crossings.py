"""Where the paths of a fleet come nearer each other than two robots may be."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.errors import GaveUpError
from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.patched_crossings import PatchedCrossings, boxes_of_robots
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet import packed_pieces as columns
from viaspline.kernels.fleet.joined_boxes import joined_boxes
from viaspline.kernels.fleet.near_boxes import near_boxes
from viaspline.kernels.fleet.near_pieces import grid_of, near_pieces
from viaspline.kernels.fleet.neighbouring import mark_neighbours
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_pieces import PackedPieces, pieces_of
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.space.meeting.spatial_crossings import spatial_crossings

MAX_BOXES = 50_000_000
"""How many boxes the crossings of a fleet may have: 1.4 GB."""

BOXES_A_PAIR = 4
"""How many boxes a pair of pieces that are near each other has at least, in the mean."""


@told_in_lines
@dataclass(frozen=True, eq=False)
class FleetCrossings(ComparedByValue):
    """Pairs of places on two paths at which two robots would be too near each other.

    Attributes:
        parts: As kernels see them, or those from before and those that are found anew.
    """

    parts: PackedCrossings | PatchedCrossings

    @cached_property
    def packed(self) -> PackedCrossings:
        """As kernels see them."""
        if isinstance(self.parts, PackedCrossings):
            return self.parts
        return self.parts.merged()

    @property
    def robots(self) -> Ints:
        """The two robots of each crossing, (c, 2); what doesn't ask for boxes takes these."""
        return self.parts.robots

    @property
    def span(self) -> Floats:
        """Where each crossing is along both paths [m], (c, 4); see ``PackedCrossings``."""
        return self.parts.span

    def patched(self, fresh: PackedCrossings, is_changed: Flags, moved: Ints) -> FleetCrossings:
        """With those of some robots found anew; see ``PatchedCrossings``.

        Args:
            fresh: The crossings of these robots.
            is_changed: Which robots these are, (n,).
            moved: By how much the numbers of each robot's cells have changed since before, (n,).
        """
        if isinstance(self.parts, PatchedCrossings) and "packed" not in self.__dict__:
            found = self.parts.patched(fresh, is_changed, moved)
        else:
            found = PatchedCrossings.of(self.packed, fresh, is_changed, moved)
        return FleetCrossings(found.merged() if found.has_many else found)

    def boxes_of(self, chosen: Flags) -> PackedCrossings:
        """All crossings, without the boxes of any but some robots, (n,)."""
        if isinstance(self.parts, PackedCrossings):
            return boxes_of_robots(self.parts, chosen)
        return self.parts.boxes_of(chosen)

    def _said(self) -> tuple[object, ...]:
        return (self.packed,)


def crossings_of(
    courses: FleetCourses, only: Ints | None = None, *, max_boxes: int = MAX_BOXES
) -> FleetCrossings:
    """Every pair of places on two courses at which their robots would be too near each other.

    All of them are found: curves are bounded, not sampled. Beyond what is too near, boxes hold what
    is nearer than the reaches and the bounds of both curves, some centimetres.

    Args:
        courses: The courses of the fleet.
        only: The robots of which one has to be in each pair, (k,); None: any.
        max_boxes: So many boxes may be found.

    Raises:
        GaveUpError: There are more boxes than that: too many robots pass one place.

    Example:
        >>> from viaspline.curve.path import Path
        >>> from viaspline.fleet.courses import FleetPath, courses_along
        >>> def line(*ends):
        ...     a, b = np.array(ends, float)
        ...     path = Path([[a, a + (b - a) / 3, b - (b - a) / 3, b]], vias=[])
        ...     return FleetPath(path, np.array([0.0, path.length]), reach=1.0)
        >>> courses = courses_along(["a", "b"], [line((0, 0), (20, 0)), line((12, 9), (12, -9))])
        >>> found = crossings_of(courses).packed
        >>> found.robots.tolist(), found.span.round(3).tolist()
        ([[0, 1]], [[10.0, 14.0, 7.0, 11.0]])
    """
    if courses.bodies is not None:
        return FleetCrossings(spatial_crossings(courses.in_space(), only, max_boxes))
    packed = courses.packed
    robots = len(courses.names)
    is_asked, takes_part = np.ones(robots, dtype=np.bool_), np.ones(robots, dtype=np.bool_)
    if only is not None:
        is_asked = _flags(robots, only)
        mark_neighbours(packed, np.ascontiguousarray(only, dtype=np.int64), takes_part)
    pieces = pieces_of(packed, takes_part)
    grid = grid_of(pieces)
    max_pairs = max_boxes // BOXES_A_PAIR
    first, near = near_pieces(pieces, grid, is_asked, max_pairs)
    if len(near) > 2 * max_pairs:
        raise _too_many(courses, pieces, first[1:], max_boxes)
    boxes = near_boxes(packed, pieces, first, near, max_boxes)
    if len(boxes.cell) > max_boxes:
        raise _too_many(courses, pieces, np.diff(first), max_boxes)
    del pieces, grid, first, near  # boxes take much more yet until they are joined
    pairs, span, box_first, crossing, count = joined_boxes(packed, boxes)
    return FleetCrossings(
        PackedCrossings(
            pairs, span, box_first, boxes.cell[:count], crossing[:count], boxes.other[:count],
            boxes.low[:count], boxes.high[:count],
        )
    )  # fmt: skip


def box_owners(crossings: PackedCrossings) -> Ints:
    """The robot of every box, (boxes,)."""
    return np.repeat(np.arange(len(crossings.box_first) - 1), np.diff(crossings.box_first))


def with_boxes_of(crossings: PackedCrossings, chosen: Flags) -> PackedCrossings:
    """Crossings without the boxes of any but some of them, (c,)."""
    boxes = np.flatnonzero(chosen[crossings.crossing])
    return crossings._replace(
        box_first=np.searchsorted(boxes, crossings.box_first).astype(np.int64),
        cell=crossings.cell[boxes], crossing=crossings.crossing[boxes],
        other=crossings.other[boxes], low=crossings.low[boxes], high=crossings.high[boxes],
    )  # fmt: skip


def _flags(count: int, chosen: Ints) -> Flags:
    flags = np.zeros(count, dtype=np.bool_)
    flags[chosen] = True
    return flags


def _too_many(
    courses: FleetCourses, pieces: PackedPieces, counts: Ints, max_boxes: int
) -> GaveUpError:
    """What is said where too many robots pass one place: the busiest of those that were met."""
    busiest = int(np.argmax(counts))
    where: Floats = pieces.real[busiest, columns.X : columns.Y + 1]
    x, y = where.tolist()
    name = courses.names[int(pieces.whole[busiest, columns.ROBOT])]
    return GaveUpError(
        f"the {len(courses.names)} paths of the fleet come near each other in more than "
        f"{max_boxes} places, most of them about ({x:.6g}, {y:.6g}), where '{name}' passes",
        where=where,
        remedy="send fewer robots through one place",
        tried=("crossings",),
    )
