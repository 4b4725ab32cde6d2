"""The paths of a fleet as the courses that its robots drive, cut into cells."""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.kernels.fleet.packed_courses import PackedCourses


@dataclass(frozen=True, eq=False)
class FleetCourses:
    """Paths of robots, cut into cells.

    Attributes:
        names: The robots, in the order of the courses.
        packed: The courses as kernels see them.
    """

    names: tuple[str, ...]
    packed: PackedCourses
