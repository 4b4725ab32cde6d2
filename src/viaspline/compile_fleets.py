"""The kernels of fleets called once, as `viaspline.precompile` does it.

Two robots cross, whose paths are given: nothing is laid, for a run compiles what lays paths itself
meanwhile.

Tested through ``test_precompile``.
"""

from __future__ import annotations

import numpy as np

from viaspline.curve.path import Path
from viaspline.fleet.courses import FleetPath, courses_along
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.simulate_fleet import drive_fleet
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_laws import static_laws
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.precedences import precedences_of
from viaspline.fleet.timing.rides import FleetRides
from viaspline.fleet.timing.time_paths import time_paths
from viaspline.kernels.fleet.common_parts import common_parts, connected_parts, passed_second
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.retime import retime

REACH_M = 1.0


def timed_pair() -> DrivenFleet:
    """Two robots on straight paths that cross: timed, proven apart, the one before the other."""
    limits = Limits(max_speed=2.0, max_accel=1.0)
    thirds = np.arange(4.0)[:, None]
    paths = [Path([[-15.0, 0.0] + thirds * [10.0, 0.0]], vias=[])]
    paths += [Path([[0.0, -15.0] + thirds * [0.0, 10.0]], vias=[])]
    laws = [retime(path, limits) for path in paths]
    ways = [FleetPath(one, law.distances, REACH_M) for one, law in zip(paths, laws, strict=True)]
    courses = courses_along(("a", "b"), ways)
    alone = static_laws(courses, laws)
    packed, ends = alone.packed, courses.packed.first[1:] - 1
    lasts = np.append(packed.arrive[1:] - packed.leave[:-1], 0.0)
    lasts[ends] = 0.0
    two = np.ones(2)
    rides = FleetRides(
        PackedRides(
            square=packed.speed**2, lasts=lasts, stays=np.zeros(lasts.size), accel=two,
            brake=two.copy(), depart=np.zeros(2), keeps_pace=np.zeros(2, np.bool_),
            vanishes=np.zeros(2, np.bool_),
        ),
        np.array([law.duration for law in laws]),
        alone,
    )  # fmt: skip
    timing = time_paths(courses, crossings_of(courses), rides, [0.0, 0.0])
    crossings = ordered_crossings(courses, crossings_of(courses), timing.laws)
    parts = common_parts(courses.packed, crossings.packed, np.ones(1, np.bool_))
    connected_parts(crossings.packed, *parts)
    passed_second(courses.packed, crossings.packed, timing.laws.packed, *parts)
    certify_fleet(courses, timing.laws, 0.0)
    precedences_of(courses, crossings, timing.laws, rides.laws)
    return DrivenFleet(courses, crossings, timing.laws, rides.packed, 0.0)


def drive_pair() -> bool:
    """Drive them; whether both came home, proven apart."""
    run = drive_fleet(timed_pair())
    return run.reached and run.certificate.holds
