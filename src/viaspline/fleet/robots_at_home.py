"""Robots without a path as what they are to the others: they stand at their starts for ever.

Their courses are two nodes at one place. They are there for the proof; nobody drives them.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.fleet.courses import END_CELL_M, FleetCourses
from viaspline.fleet.fleet_certificate import FleetCertificate, certify_fleet
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.space.flight_places import flight_places
from viaspline.mission.space.flying_body import FlyingBody


def certify_all(fleet: Fleet, courses: FleetCourses, laws: FleetLaws) -> FleetCertificate:
    """Prove how far apart all robots of a fleet stay, those that have no path among them.

    Args:
        fleet: What is asked for.
        courses: The paths of its robots, of those that have one.
        laws: When each of these is where.
    """
    known = set(courses.names)
    if not known or all(one.name in known for one in fleet.fleet):
        return certify_fleet(courses, laws, fleet.separation_m)
    home = [one for one in fleet.members if one.name not in known]
    return certify_fleet(
        _with_courses(courses, home, fleet.separation_m), _with_laws(laws, len(home)),
        fleet.separation_m,
    )  # fmt: skip


def _with_courses(
    courses: FleetCourses, home: Sequence[FleetMember], separation: float
) -> FleetCourses:
    """Courses with those of robots that stand at their starts."""
    packed, half = courses.packed, 0.5 * separation
    count, bodies = len(home), courses.bodies
    if bodies is None:
        places: Floats = np.array([one.mission.route.start.at[:2] for one in home], np.float64)
        robots = [one.mission.robot for one in home]
        reach = [one.outer_radius + (one.tracking_error_m or 0.0) + half for one in robots]
    else:
        places = np.array([flight_places(one.mission).start for one in home], np.float64)
        flying = [FlyingBody.of(one.mission.robot) for one in home]
        rows = [(one.radius, one.half_height, one.margin + half) for one in flying]
        reach = [one.radius + one.margin + half for one in flying]
        bodies = np.concatenate((bodies, np.array(rows)))
    return FleetCourses(
        (*courses.names, *(one.name for one in home)),
        PackedCourses(
            first=np.concatenate((packed.first, packed.first[-1] + 2 * np.arange(1, count + 1))),
            distance=np.concatenate((packed.distance, np.tile([0.0, END_CELL_M], count))),
            place=np.concatenate((packed.place, np.repeat(places, 2, axis=0))),
            bow=np.concatenate((packed.bow, np.zeros(2 * count))),
            reach=np.concatenate((packed.reach, reach)),
        ),
        bodies,
    )


def _with_laws(laws: FleetLaws, count: int) -> FleetLaws:
    """Laws with those of robots that stand where they are since ever."""
    packed = laws.packed
    since = np.tile([-np.inf, np.inf], count)
    return FleetLaws(
        PackedLaws(
            arrive=np.concatenate((packed.arrive, since)),
            leave=np.concatenate((packed.leave, np.full(2 * count, np.inf))),
            speed=np.concatenate((packed.speed, np.zeros(2 * count))),
            is_timed=np.concatenate((packed.is_timed, np.ones(count, np.bool_))),
        )
    )
