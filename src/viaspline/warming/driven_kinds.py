"""Missions of a kind planned and driven, for what that compiles, loads and imports."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from functools import partial
from importlib import import_module
from typing import Final

from viaspline.errors import ViasplineError
from viaspline.precompile import Job, compile_all
from viaspline.warming.mission_kind import PARTS, MissionKind

IMPORTED_LATE: Final = (
    "scipy.interpolate",
    "scipy.ndimage",
    "scipy.sparse",
    "scipy.sparse.csgraph",
    "scipy.sparse.linalg",
    "scipy.spatial",
    "shapely",
    "shapely.affinity",
    "viaspline.kernels.clearance.footprint_pose",
    "viaspline.kernels.clearance.footprint_walk",
    "viaspline.mission.footprint_check",
    "viaspline.planning.corridor.corridor_planner",
)
"""What planning and driving import only where they need it."""

TURNING: Final = (*PARTS[1:5], "localization", "footprint", "turning")
"""With these a mission needs the search among poses."""


LONGEST_S: Final[Mapping[str, float]] = {"crossing": 7.0}
"""The missions by name that are broken off sooner than others: when all was met [s]."""

USUALLY_S: Final = 40.0
"""The others are broken off after so long: what they haven't met by then, they won't [s]."""


class _EnoughError(Exception):
    """A drive has lasted long enough."""


def jobs_of_kind(kind: MissionKind) -> tuple[Job, ...]:
    """What of a kind of mission is compiled by itself, and so by another process if there is one.

    >>> jobs_of_kind(MissionKind(("turning",)))
    ('curves', 'driving')
    """
    fleets: tuple[Job, ...] = ("fleets", "fleet_drives") if kind.is_fleet else ()
    return ("curves", *fleets, *(("driving",) if set(kind.parts) & set(TURNING) else ()))


def drive_kind(kind: MissionKind) -> None:
    """Plan and drive the small missions of a kind.

    What came of them doesn't count: a way that is closed is one of them.
    """
    if kind.is_fleet:
        from viaspline.warming.small_fleets import drive_fleets

        drive_fleets(kind)
    elif "space" in kind.parts:
        from viaspline.warming.small_flights import fly_small

        fly_small()
    else:
        _drive_missions(kind)
    compile_all(jobs_of_kind(kind))


def _drive_missions(kind: MissionKind) -> None:
    from viaspline.planner import plan
    from viaspline.robot.simulator import simulate
    from viaspline.warming.small_missions import missions_of

    for module in IMPORTED_LATE:
        import_module(module)
    _meet_seldom()
    for name, mission in missions_of(kind):
        with suppress(ViasplineError, _EnoughError):
            simulate(mission, plan=plan(mission), progress=partial(_enough, name))


def _meet_seldom() -> None:
    """What a step may need that not every kind comes to in its small missions."""
    import numpy as np

    from viaspline.curve.path import Path
    from viaspline.kernels.routing.narrow_gaps import narrow_places
    from viaspline.kernels.world.segment import segment_distance
    from viaspline.mission.shapes.obstacle import Obstacle
    from viaspline.planning.problem.requirements import Requirements
    from viaspline.planning.routing.bottleneck import bottleneck_between
    from viaspline.planning.turning.bend_row import Bends
    from viaspline.planning.turning.headings import HeadingLeg, costs_between
    from viaspline.planning.turning.posed_legs import posed
    from viaspline.trajectory.limits import Limits
    from viaspline.trajectory.yielding.law_among import law_among
    from viaspline.world.moving_obstacles import MovingObstacles
    from viaspline.world.world import World

    rock = Obstacle(circle={"center": (5, 1), "radius": 0.5})
    narrow_places(World([rock]).packed, np.array([[0.0, 0.0], [9.0, 0.0]]), 0.3)
    segment_distance(World([rock]).packed, 0.0, 0.0, 9.0, 0.0, np.inf)
    walled = World([rock], bounds=(0.0, -1.0, 10.0, 2.0))
    bottleneck_between(walled, np.array([1.0, 0.0]), np.array([9.0, 0.0]), 2.0)
    ends = np.array([[0.0, 0.0, 0.0, 0.0, np.nan, 0.5], [3.0, 1.0, 0.0, 0.0, np.nan, 0.5]])
    bends = Bends.free(ends, np.array([0, 1]))
    legs = (HeadingLeg(bends, np.array([1.0]), np.array([0.0, 2.0])),)
    costs = costs_between(legs, Requirements(radius=0.3, clearance=0.1))
    posed(legs, costs, closed=False, lay=lambda bends: None, max_rows=2, max_pairs=2)
    line = Path([[[0, 0], [10, 0], [20, 0], [30, 0]]], vias=[])
    motion = {"from": (15, -8), "velocity_mps": (0, 1)}
    cart = Obstacle(circle={"center": (0, 0), "radius": 1}, motion=motion)
    limits = Limits(max_speed=2, max_accel=1)
    law_among(line, limits, moving=MovingObstacles([cart]), required=0.5)


def _enough(name: str, time: float, distance: float, length: float) -> None:
    del distance, length
    if time > LONGEST_S.get(name, USUALLY_S):
        raise _EnoughError
