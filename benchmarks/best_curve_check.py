"""Is the optimiser any good: cases whose best curve is known, and two starts for each world.

    python benchmarks/best_curve_check.py [--worlds 5]

One disc in the open: the shortest is line, arc, line about it; so is the fastest while the limit
across the path lets it keep its speed on the arc, and if not, the arc is that on which it can.
Round the corner of a corridor: line, the arc that allows full speed, line. In worlds: begun with
the planner's path and with the taut route of its kind.
"""

from __future__ import annotations

import argparse
import math

import numpy as np
import shapely
from best_curve import fastest, least_room, shortest
from curve_nodes import Nodes, Task
from driven_missions import vector_world
from driven_plan import DrivenPlan
from driving_time import DrivingLimits, straight_time
from free_space import FreeSpace
from problems import Solids
from timing import clock

FAR = 1e6
OPEN = (-FAR, -FAR, FAR, FAR)


def row(name: str, found: Nodes, seconds: float, task: Task, known: tuple[float, float]):
    """Print a case: what was found over what is known, the length [m] and the time [s]."""
    length, time = known
    print(
        f"{name:24s} {found.length / length:9.6f} {found.time / time:9.6f} "
        f"{found.peak:8.4f} {1e3 * least_room(task, found):9.4f} {seconds:6.1f}",
        flush=True,
    )


def round_arc(
    a: np.ndarray, b: np.ndarray, centre: np.ndarray, radius: float, side: np.ndarray
) -> float:
    """Length of line, arc, line from a to b about a circle, past its place on a side [m]."""
    total = 0.0
    for end in (a, b):
        away = np.subtract(end, centre)
        far = math.hypot(*away)
        apart = math.acos(float(away @ side) / (far * math.hypot(*side)))
        total += math.sqrt(far * far - radius * radius)
        total += radius * (apart - math.acos(radius / far))
    return total


def disc(lateral: float) -> tuple[Task, float]:
    """Past a disc of 5 m with 1 m to keep, and the length of the best curve [m]."""
    space = FreeSpace(Solids(cores=np.array([shapely.Point(0, 0)]), radii=np.array([5.0]),
                             bounds=OPEN), 1.0)  # fmt: skip
    limits = DrivingLimits(speed=2.0, accel=1.0, brake=1.0, lateral=lateral)
    radius = max(6.0, limits.speed**2 / lateral)
    start, goal = np.array((-30.0, 0.0)), np.array((30.0, 0.0))
    over = np.column_stack((np.linspace(-30, 30, 200), 9 * np.cos(np.linspace(-1, 1, 200) * 1.571)))
    over[[0, -1], 1] = 0.0
    task = Task(space=space, legs=(over,), rests=(True, True), limits=limits, headings={})
    return task, round_arc(start, goal, np.array((0.0, 6.0 - radius)), radius, np.array((0, 1)))


def corner(lateral: float) -> tuple[Task, float]:
    """Round a square corner in a corridor 8 m wide, and the length of the best curve [m]."""
    walls = shapely.box(-90, -90, 0, 0), shapely.box(-90, 8, 90, 9), shapely.box(8, -90, 9, 90)
    space = FreeSpace(Solids(cores=np.array(walls), radii=np.zeros(3), bounds=OPEN), 0.5)
    limits = DrivingLimits(speed=2.0, accel=1.0, brake=1.0, lateral=lateral)
    radius = limits.speed**2 / lateral
    start, goal = np.array((-40.0, 4.0)), np.array((4.0, -40.0))
    outer = np.array((start, (4.0, 4.0), goal))
    along = shapely.LineString(outer).interpolate(np.linspace(0, 1, 300), normalized=True)
    legs = (shapely.get_coordinates(along),)
    centre = np.full(2, (0.5 - radius) / math.sqrt(2.0))
    task = Task(space=space, legs=legs, rests=(True, True), limits=limits, headings={})
    return task, round_arc(start, goal, centre, radius, np.array((1, 1)))


def known_cases() -> None:
    print(f"{'case':24s} {'length':>9s} {'time':>9s} {'peak 1/m':>8s} {'room mm':>9s} {'s':>6s}")
    for lateral in (100.0, 0.2):
        task, length = disc(lateral)
        seconds, found = clock(lambda task=task: fastest(task))
        row(f"disc, {lateral:g} m/s²", found, seconds, task,
            (length, straight_time(length, task.limits)))  # fmt: skip
    task, length = disc(100.0)
    seconds, found = clock(lambda: shortest(task))
    row("disc, shortest", found, seconds, task, (length, straight_time(length, task.limits)))
    for lateral in (2.0, 0.5):
        task, length = corner(lateral)
        seconds, found = clock(lambda task=task: fastest(task))
        row(f"corner, {lateral:g} m/s²", found, seconds, task,
            (length, straight_time(length, task.limits)))  # fmt: skip


def two_starts(worlds: int) -> None:
    print("\nworld   from the path s   from the taut route   of its own time")
    for seed in range(worlds):
        driven = DrivenPlan.of(vector_world(seed))
        one = fastest(driven.task).time
        other = fastest(driven.task_from_taut).time
        print(f"{seed:5d} {one:17.3f} {other:21.3f} {driven.driving_time:17.3f}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--worlds", type=int, default=5)
    known_cases()
    two_starts(parser.parse_args().worlds)


if __name__ == "__main__":
    main()
