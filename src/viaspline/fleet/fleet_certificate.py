"""The proof that the robots of a fleet stay apart, over continuous time."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.curve.certificate import PROOF_SLACK_M, PROOF_TOLERANCE_M
from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.handed_in import number_from
from viaspline.kernels.fleet.fleet_proof import fleet_tightest
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.space.meeting.spatial_separation import nearest_in_space


@told_in_lines
@dataclass(frozen=True)
class FleetCertificate:
    """What is proven of the distance between the robots of a fleet.

    Attributes:
        separation: Proven lower bound of the free space between any two bodies at any time [m];
            infinite for a single robot.
        required: The separation that was asked for [m].
        pair: The two robots that are nearest; None where there are no two.
        at_s: When that is [s].
        at: Where the two are then [m], x, y and in space z; None where there are no two.
        repeats: From when on [s] and after how long [s] all comes again; None where nothing does.
            What is proven of the time until then and of a period after it holds for ever.
    """

    separation: float
    required: float
    pair: tuple[str, str] | None
    at_s: float
    at: tuple[tuple[float, ...], tuple[float, ...]] | None
    repeats: tuple[float, float] | None = None

    @property
    def holds(self) -> bool:
        """Whether the proven separation is the one that was asked for, to a micrometre."""
        return self.separation >= self.required - PROOF_SLACK_M


def certify_fleet(courses: FleetCourses, laws: FleetLaws, required: float) -> FleetCertificate:
    """Prove how far apart the robots of a fleet stay, over continuous time.

    All pairs of robots are looked at; the crossings of their courses are not asked. A robot stands
    at its start before it departs, and at its goal after it has arrived, unless it leaves then.

    Args:
        courses: The paths; their reaches hold the half of ``required`` each.
        laws: When each robot is where. Those that have none play no part.
        required: The separation that was asked for [m].

    Returns:
        A certificate, whether it holds or not. Its separation is never above the true one. It is
        within 1 mm of that of the courses' chords, and less than those are from the curves by the
        bows of the two cells at most; around what is required it is exact to half a micrometre.

    Example:
        >>> from viaspline.curve.path import Path
        >>> from viaspline.fleet.courses import FleetPath, courses_along
        >>> from viaspline.fleet.fleet_laws import static_laws
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.trajectory.retime import retime
        >>> paths = [Path([[[0, y], [4, y], [8, y], [12, y]]], vias=[]) for y in (0, 3)]
        >>> drives = [retime(path, Limits(max_speed=2, max_accel=1)) for path in paths]
        >>> courses = courses_along(
        ...     ["a", "b"],
        ...     [FleetPath(p, d.distances, reach=1.0) for p, d in zip(paths, drives)],
        ... )
        >>> proven = certify_fleet(courses, static_laws(courses, drives), required=1.0)
        >>> round(proven.separation, 3), proven.pair, proven.holds
        (2.0, ('a', 'b'), True)
    """
    required = number_from("required", required)
    if courses.bodies is not None:
        return _certified_in_space(courses, laws, required)
    bound, when, x0, y0, x1, y1, first, second = fleet_tightest(
        courses.packed, laws.packed, PROOF_TOLERANCE_M
    )
    if first < 0:
        return FleetCertificate(math.inf, required, None, 0.0, None)
    return FleetCertificate(
        separation=bound + required,
        required=required,
        pair=(courses.names[first], courses.names[second]),
        at_s=when,
        at=((x0, y0), (x1, y1)),
    )


def _certified_in_space(
    courses: FleetCourses, laws: FleetLaws, required: float
) -> FleetCertificate:
    """The certificate of robots in space."""
    found = nearest_in_space(courses.in_space(), laws.packed)
    if found.pair[0] < 0:
        return FleetCertificate(math.inf, required, None, 0.0, None)
    first, second = (courses.names[k] for k in found.pair)
    one, other = (tuple(place) for place in found.places.tolist())
    return FleetCertificate(
        found.bound + required, required, (first, second), found.when, (one, other)
    )
