"""A closed path driven lap after lap, from rest to rest at its start."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.fleet.courses import AnyPlan, FleetCourses
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.patrols.repeated_laws import (
    ends_at,
    laws_in_a_row,
    repeated_law,
    set_out,
)
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.planning.plan_drive import repeated
from viaspline.space.route_law import headings_of, stops_of
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.spatial_request import spatial_problem_of
from viaspline.space.timing.retime_in_space import retime_in_space
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.space.timing.yaw_profile import YawProfile
from viaspline.space.timing.yaw_speeds import with_yaw_turns
from viaspline.trajectory.law_at_nodes import law_at_nodes
from viaspline.trajectory.limits import Station
from viaspline.trajectory.trajectory import Trajectory
from viaspline.whole_plan import fastest_law, stations

SAME_M = 1e-6
"""Places on a path that are no farther apart are one."""
SAME_PLACE_SHARE = 1e-9
"""Of the way to a place, which is rounding."""


def driven_laps(lap: AnyPlan, laps: int) -> AnyPlan:
    """A plan of several laps, with a halt at the start after each.

    Args:
        lap: A closed path, driven once from rest to rest.
        laps: How often it is driven.

    Example:
        >>> from viaspline.mission.model import Mission
        >>> from viaspline.planner import plan
        >>> lap = plan(Mission.model_validate(
        ...     {"route": {"start": [0, 0], "via": [[9, 0], [9, 9]], "closed": True}}))
        >>> three = driven_laps(lap, 3)
        >>> round(three.path.length / lap.path.length, 9)
        3.0
        >>> round(three.trajectory.duration / lap.trajectory.duration, 6)
        3.0
    """
    asked = lap.mission
    route = asked.route.model_copy(update={"laps": laps})
    mission = asked.model_copy(update={"route": route})
    path = repeated(lap.path, laps)
    if isinstance(lap, SpatialPlan):
        problem = replace(spatial_problem_of(asked), laps=laps)
        yaw = headings_of(problem, path)
        law = law_of_flown_laps(path, problem, lap.limits, yaw)
        airborne = (0.0, path.length)
        return replace(lap, mission=mission, path=path, airborne=airborne, yaw=yaw, trajectory=law)
    law = fastest_law(path, mission, stops_on_laps(path, mission))
    return replace(lap, mission=mission, path=path, trajectory=law)


def stops_on_laps(path: Path, mission: Mission) -> list[Station]:
    """Where a patrol in the plane stops: at its stations, and at its start after each lap.

    Args:
        path: All of its laps.
        mission: With so many laps.
    """
    return _halting(stations(path, mission.robot), path, mission.route.laps)


def law_of_laps(path: Path, mission: Mission, stops: Sequence[Station]) -> Trajectory:
    """The fastest law of a patrol in the plane, which stops after each lap: the same in all laps.

    Laps that are timed all at once are timed otherwise where the jerk is limited, for there a law
    is a local optimum.

    Args:
        path: All of its laps, each like the first one.
        mission: With so many laps.
        stops: Where it stops, at the end of each lap among others.
    """
    seams = seams_of(path, mission.route.laps)
    a_lap = Path(path.spans[: len(path.spans) // mission.route.laps], vias=[])
    own = [stop for stop in stops if stop.distance < seams[1] - SAME_M]
    law = fastest_law(a_lap, mission, own)
    return repeated_law(law, seams, law.duration)


def law_of_flown_laps(
    path: Path, problem: SpatialProblem, limits: SpatialLimits, yaw: YawProfile
) -> Trajectory:
    """The fastest law of a patrol in space, which stops after each lap: the same in all laps.

    A lap is timed by itself: where limits couple speed and acceleration, a law depends on how its
    path is cut, and laps behind each other are each cut otherwise.

    Args:
        path: All of its laps, each like the first one.
        problem: With so many laps.
        limits: Of the robot.
        yaw: The headings along the path.
    """
    seams, zones = seams_of(path, problem.laps), problem.zones
    stops = with_yaw_turns(tuple(flown_stops_on_laps(problem, path)), yaw, limits.yaw_rate)
    ends = int(yaw.distances.searchsorted(seams[1] - SAME_M)) + 1
    looks = YawProfile(np.append(yaw.distances[: ends - 1], seams[1]), yaw.headings[:ends])
    a_lap = Path(path.spans[: len(path.spans) // problem.laps], vias=[])
    own = tuple(stop for stop in stops if stop.distance < seams[1] - SAME_M)
    at_last = tuple(
        replace(stop, distance=float(seams[1]))
        for stop in stops
        if stop.distance > seams[-1] - SAME_M
    )
    law, last = (
        retime_in_space(a_lap, limits, one, looks, zones=zones) for one in (own, own + at_last)
    )
    between = max(
        (stop.dwell for stop in stops if abs(stop.distance - seams[1]) <= SAME_M), default=0.0
    )
    parts = [law if problem.laps > 1 else last]
    for k in range(1, problem.laps):
        part = set_out(law if k < problem.laps - 1 else last).moved(float(seams[k]))
        parts.append(part.delayed(parts[-1].end_time + between - part.start_time))
    return laws_in_a_row(
        [ends_at(part, end) for part, end in zip(parts, seams[1:].tolist(), strict=True)]
    )


def flown_stops_on_laps(problem: SpatialProblem, path: Path) -> list[Station]:
    """Where a patrol in space hovers: at its stations, and at its start after each lap.

    Args:
        problem: With so many laps.
        path: All of them.
    """
    before = int(problem.takeoff is not None)
    return _halting(stops_of(problem, path), path, problem.laps, before)


def _halting(stops: Iterable[Station], path: Path, laps: int, before: int = 0) -> list[Station]:
    """The stations of several laps, and a halt at the start after each where there is none."""
    found = list(stops)
    found += [
        Station(seam)
        for seam in seams_of(path, laps, before)[1:-1].tolist()
        if all(abs(stop.distance - seam) > SAME_M for stop in found)
    ]
    return sorted(found, key=lambda stop: stop.distance)


def seams_of(path: Path, laps: int, before: int = 0) -> Floats:
    """Where the laps of a path begin and end [m], (laps + 1,).

    Args:
        path: All of them.
        laps: How many there are.
        before: So many spans come before the first one.
    """
    joints = before + np.arange(laps + 1) * ((len(path.spans) - before) // laps)
    return np.asarray(path.distance(joints.astype(float)), dtype=np.float64)


def on_nodes(law: Trajectory, nodes: Floats) -> Trajectory:
    """A time law whose points lie on the nodes of a course that they are as good as on.

    Args:
        law: Along the course.
        nodes: Increasing distances [m], (m,).
    """
    after = np.clip(np.searchsorted(nodes, law.distances), 1, len(nodes) - 1)
    low, high = nodes[after - 1], nodes[after]
    nearest = np.where(law.distances - low < high - law.distances, low, high)
    is_same = np.abs(nearest - law.distances) <= SAME_M
    return replace(law, distances=np.where(is_same, nearest, law.distances))


def write_law(law: Trajectory, courses: FleetCourses, robot: int, laws: FleetLaws) -> None:
    """Write a time law into the laws of a fleet, at the nodes of a robot's course.

    Args:
        law: Along the course.
        courses: Of the fleet.
        robot: Whose law it is.
        laws: They are written to.
    """
    packed, whole = courses.packed, laws.packed
    part = slice(int(packed.first[robot]), int(packed.first[robot + 1]))
    nodes = packed.distance[part]
    arrive, leave, speed = law_at_nodes(on_nodes(law, nodes), nodes)
    whole.arrive[part], whole.leave[part], whole.speed[part] = arrive, leave, speed
    whole.is_timed[robot] = True


def stay_between(lap: AnyPlan) -> float:
    """How long a robot has to stand between two laps, beyond its stay at the end of one [s].

    Told by the stays themselves: how long laps take differs by how finely they are timed.
    """
    twice = driven_laps(lap, 2)
    between = _stay_at(twice.trajectory, float(seams_of(twice.path, 2)[1]))
    return max(between - _stay_at(lap.trajectory, lap.path.length), 0.0)


def _stay_at(law: Trajectory, place: float) -> float:
    """How long a law stands at a place of its path [m]: [s]."""
    times = law.times[np.abs(law.distances - place) <= SAME_PLACE_SHARE * (1.0 + place)]
    return float(np.ptp(times)) if times.size else 0.0
