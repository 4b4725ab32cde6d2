"""A closed path driven lap after lap, from rest to rest at its start."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.fleet.courses import AnyPlan, FleetCourses
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.planning.plan_drive import repeated
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.spatial_request import spatial_problem_of
from viaspline.space.static_plan import headings_of, stops_of
from viaspline.space.timing.retime_in_space import retime_in_space
from viaspline.trajectory.law_at_nodes import law_at_nodes
from viaspline.trajectory.limits import Station
from viaspline.trajectory.trajectory import Trajectory
from viaspline.whole_plan import fastest_law, stations

SAME_M = 1e-6
"""Places on a path that are no farther apart are one."""
SAME_S = 1e-9
"""Times that are no farther apart are one."""


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
    path, zones = repeated(lap.path, laps), asked.world.speed_zones
    if isinstance(lap, SpatialPlan):
        problem = replace(spatial_problem_of(asked), laps=laps)
        yaw = headings_of(problem, path)
        stops = tuple(flown_stops_on_laps(problem, path))
        law = retime_in_space(path, lap.limits, stops, yaw, zones=zones)
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


def set_out(law: Trajectory) -> Trajectory:
    """A time law without what it waits at its start."""
    waits = int(law.distances.searchsorted(law.distances[0], side="right")) - 1
    pieces = slice(waits, None)
    return replace(
        law,
        distances=law.distances[waits:],
        speeds=law.speeds[waits:],
        times=law.times[waits:],
        accelerations=law.accelerations[pieces],
        changes=None if law.changes is None else law.changes[pieces],
        jerks=None if law.jerks is None else law.jerks[pieces],
    )


def repeated_law(law: Trajectory, seams: Floats, period: float) -> Trajectory:
    """A time law from rest to rest, driven again every period.

    Args:
        law: It begins at 0 m when its robot sets out, and takes no longer than the period.
        seams: Where the rounds begin and end [m], (n + 1,).
        period: [s].

    Raises:
        GeometryError: The law takes longer.

    Example:
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.curve.path import Path
        >>> from viaspline.trajectory.retime import retime
        >>> line = Path([[[0, 0], [3, 0], [6, 0], [9, 0]]], vias=[])
        >>> law = retime(line, Limits(max_speed=1, max_accel=1))
        >>> twice = repeated_law(law, np.array([0.0, 9.0, 18.0]), 15.0)
        >>> twice.time_at([4.5, 13.5]).tolist()
        [5.0, 20.0]
    """
    if law.duration > period + SAME_S:
        raise GeometryError(
            f"a lap of {law.duration:g} s doesn't fit a period of {period:g} s; give a longer one"
        )
    return laws_in_a_row([_moved(law, k, seams, period) for k in range(len(seams) - 1)])


def laws_in_a_row(parts: Sequence[Trajectory]) -> Trajectory:
    """Time laws from rest to rest behind each other, with a halt where one begins later.

    Args:
        parts: Each begins where the one before ends, and no sooner.

    Example:
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.curve.path import Path
        >>> from viaspline.trajectory.retime import retime
        >>> line = Path([[[0, 0], [3, 0], [6, 0], [9, 0]]], vias=[])
        >>> law = retime(line, Limits(max_speed=1, max_accel=1))
        >>> both = laws_in_a_row([law, law.moved(9.0).delayed(15.0)])
        >>> both.time_at([4.5, 13.5]).tolist()
        [5.0, 20.0]
    """
    waits = [later.start_time > before.end_time + SAME_S for before, later in pairwise(parts)]
    firsts = [0, *(0 if wait else 1 for wait in waits)]

    def points(key: str) -> Floats:
        return np.concatenate(
            [getattr(part, key)[first:] for part, first in zip(parts, firsts, strict=True)]
        )

    def pieces(key: str) -> Floats | None:
        if all(getattr(part, key) is None for part in parts):
            return None
        rows = []
        for k, (part, first) in enumerate(zip(parts, firsts, strict=True)):
            values = getattr(part, key)
            values = np.zeros(len(part.times) - 1) if values is None else values
            rows.append(np.concatenate(([0.0] if k > 0 and first == 0 else [], values)))
        return np.concatenate(rows)

    accelerations = pieces("accelerations")
    assert accelerations is not None
    return replace(
        parts[0],
        distances=points("distances"),
        speeds=points("speeds"),
        times=points("times"),
        accelerations=accelerations,
        changes=pieces("changes"),
        jerks=pieces("jerks"),
        stations=tuple(stop for part in parts for stop in part.stations),
    )


def _moved(law: Trajectory, k: int, seams: Floats, period: float) -> Trajectory:
    """A law by k rounds later; it ends where the next round begins, to the bit."""
    moved = law.moved(float(seams[k])).delayed(k * period)
    distances = moved.distances.copy()
    distances[distances >= seams[k + 1] - SAME_M] = seams[k + 1]
    return replace(moved, distances=distances)


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
