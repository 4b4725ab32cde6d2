"""The fastest law along a fixed path that lets what moves pass, or passes before it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.handed_in import check_kind
from viaspline.mission.world_spec import SpeedZone
from viaspline.planning.problem.method import Found, GaveUp, Outcome, Refusal
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.trajectory.coupled import is_coupled
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.slow_zones import Slow
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.course import Course
from viaspline.trajectory.yielding.fastest_end import with_fastest_end
from viaspline.trajectory.yielding.law_through_legs import HALVINGS, LegsSearch
from viaspline.trajectory.yielding.no_law import Unserved
from viaspline.trajectory.yielding.road import Road
from viaspline.trajectory.yielding.traffic import Traffic
from viaspline.trajectory.yielding.waiting_at_rests import waiting_at_rests
from viaspline.world.moving_obstacles import MovingObstacles

BUDGET_S = 1.0
"""What a law may cost, in seconds of the reference machine."""


def law_among(
    path: PiecewiseCubic,
    limits: Limits,
    stations: Sequence[Station] = (),
    *,
    moving: MovingObstacles,
    required: float,
    zones: Sequence[SpeedZone] = (),
    slow: Sequence[Slow] = (),
    start: float = 0.0,
    start_speed: float = 0.0,
    start_time: float = 0.0,
    hold: float = 0.0,
    speed_cap: float | None = None,
    budget: WorkBudget | None = None,
    halvings: int = HALVINGS,
    explained: Callable[[Unserved], Refusal | GaveUp] = Unserved.outcome,
) -> Outcome[Trajectory]:
    """The fastest drive along a path on which nothing that moves comes too near.

    Where nothing is in the way it is the law of ``retime``. Else the robot waits, slows down and
    passes before things where that is earlier: the earliest arrival on a lattice of times, speeds
    and places, between whose instants everything is kept as well. What it says is impossible is so
    even without inertia; what isn't found on the lattice isn't impossible.

    Args:
        path: A piecewise cubic; what moves lies in the plane of its first two coordinates.
        limits: As for ``retime``. With limits that couple speed and acceleration, and of the jerk,
            the robot only waits where it stands anyway.
        stations: Stops, each with its dwell, in which nothing may come too near either.
        moving: By the clock of the law.
        required: From the robot's centre to every shape: its radius, the clearance, and what it may
            be beside its path [m].
        zones: As for ``retime``.
        slow: As for ``retime``.
        start: Distance along the path at which the law begins [m].
        start_speed: Speed there [m/s].
        start_time: When it begins [s].
        hold: For so long the end of the path stays free after the law, which ends with the stay
            that is asked for there [s].
        speed_cap: As for ``retime``.
        budget: What may be spent.
        halvings: How often the step of the lattice is halved where nothing was found.
        explained: What is said where none is found: by proof, which may cost more than the search.

    Returns:
        The law, with its time of arrival for its cost; a refusal if there is none, with what would
        help; or that none was found.

    Raises:
        GeometryError: As ``retime``, and if ``required`` or ``hold`` isn't a number of 0 or more.

    Example:
        >>> from viaspline.curve.path import Path
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> line = Path([[[0, 0], [10, 0], [20, 0], [30, 0]]], vias=[])
        >>> cart = Obstacle(
        ...     circle={"center": (0, 0), "radius": 1},
        ...     motion={"from": (15, -8), "velocity_mps": (0, 1)},
        ... )
        >>> limits = Limits(max_speed=2, max_accel=1)
        >>> found = law_among(line, limits, moving=MovingObstacles([cart]), required=0.5)
        >>> retime(line, limits).duration, round(found.value.duration, 1)
        (17.0, 18.2)
    """
    check_kind("limits", limits, Limits, "give Limits(max_speed=2, max_accel=1)")
    check_kind("moving", moving, MovingObstacles, "give MovingObstacles([...])")
    for name, value in (("required", required), ("hold", hold)):
        if not 0.0 <= value < math.inf:
            raise GeometryError(f"{name} is {value}; give a finite number of 0 or more")
    static = retime(
        path, limits, stations, zones=zones, slow=slow, start=start, start_speed=start_speed,
        speed_cap=speed_cap, start_time=start_time,
    )  # fmt: skip
    if not len(moving):
        return Found(static, static.end_time)
    road, traffic = Road.of(path), Traffic(moving, required, hold)
    conflict = traffic.conflict(road, static)
    if conflict is None:
        return Found(static, static.end_time)
    if float(static.speeds.max()) == 0.0:
        time, index = conflict
        return Refusal(
            f"there is no law: the robot is at the end of its path, where '{moving.name(index)}' "
            f"comes nearer than {required:g} m at {time:.1f} s"
        )
    if limits.max_jerk is not None or is_coupled(limits, path.dimension):
        return waiting_at_rests(road, traffic, static)
    course = Course.of(path, limits, stations, zones, slow, speed_cap, static)
    spending = WorkBudget(BUDGET_S) if budget is None else budget
    staying = replace(traffic, hold=hold + course.dwell(course.stage.end))
    legs = LegsSearch.of(course, road, staying)
    unserved = Unserved(legs, spending)
    knots, _ = legs.law(spending, halvings, lambda: unserved.is_proven)
    if knots is not None:
        law = course.law(with_fastest_end(legs.search, knots.merged()))
        return Found(law, law.end_time)
    return explained(unserved)
