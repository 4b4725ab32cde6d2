"""Drives to whose nearest door something unseen has come: there is a way far round.

    python benchmarks/closed_doors.py [DRIVES [FIRST]]

Two or three rooms; a door that something closes which isn't on the map, and another one, or an open
end, 30 to 60 m away, now and then behind a few walls that leave a lane on alternate sides. Robots
of every kind (``random_drives.py``), with range sensors and lidars. An oracle that shares no code
with the planner (``oracle.py``) tells whether there is a way for the disc around the body with room
to turn. A line for each drive, its steps by the processor's time, and how near its body came to
anything by shapely.
"""

from __future__ import annotations

import math
import sys
from contextlib import suppress
from dataclasses import dataclass, field

import numpy as np
import shapely
from oracle import Box, distances_to, inside_bounds, verdict
from random_drives import ROBOTS
from shapely_bodies import bodies_at, shape_of
from steps import Steps, measured

import viaspline as vs
from viaspline.precompile import compile_curves, compile_driving

SEED = 4711
KINDS = ("second door", "open end", "two walls", "lanes")
SOUTH_M = 8.0
"""The rooms begin so far below their doors, and end so far above those that stay open [m]."""

STEP_M = 0.1
"""Between samples of the oracle [m]."""

TURN_ROOM = 0.6
"""Room beside the body that a turning circle takes, of its radius."""


@dataclass
class Rooms:
    """A world that is built.

    Attributes:
        bounds: [m].
        known: Walls and lumps of the map: rings (n, 2), and discs (x, y, radius).
        unseen: What isn't on it.
    """

    bounds: Box
    known: list = field(default_factory=list)
    unseen: list = field(default_factory=list)

    @property
    def shapes(self) -> list:
        """All that there is."""
        return self.known + self.unseen


def wall(x0: float, y0: float, x1: float, y1: float, width: float) -> np.ndarray:
    """A straight wall as a ring, (4, 2) [m]."""
    along = np.array((x1 - x0, y1 - y0)) / math.hypot(x1 - x0, y1 - y0)
    aside = 0.5 * width * np.array((-along[1], along[0]))
    a, b = np.array((x0, y0)), np.array((x1, y1))
    return np.array([a - aside, b - aside, b + aside, a + aside])


def rooms(random: np.random.Generator, kind: str, door: float) -> Rooms:
    """Rooms with doors of a width [m], the nearest ones closed by something unseen."""
    far, depth = float(random.uniform(30, 60)), float(random.uniform(10, 18))
    thick, middle = float(random.uniform(0.1, 0.6)), float(random.uniform(-2, 2))
    places = (0.0, 0.9 * depth) if kind == "two walls" else (0.0,)
    top = far + 2.0 * door if kind == "open end" else far + SOUTH_M
    made = Rooms((-depth, -SOUTH_M, places[-1] + depth, top))
    for number, x in enumerate(places):
        at = middle + float(random.uniform(-1, 1))
        made.known.append(wall(x, -SOUTH_M, x, at - 0.5 * door, thick))
        if kind == "open end":
            made.known.append(wall(x, at + 0.5 * door, x, far - door, thick))
        else:
            made.known.append(wall(x, at + 0.5 * door, x, far - 1.5 * door, thick))
            made.known.append(wall(x, far - 0.5 * door, x, top, thick))
        if number == 0 or random.random() < 0.5:
            made.unseen.append(_plug(random, x, at, door))
    if kind == "lanes":
        count = int(random.integers(1, 4))
        for number in range(count):
            y = SOUTH_M + (far - SOUTH_M - 2.0 * door) * (number + 1) / (count + 1)
            left, right = (0.0, door + thick) if number % 2 == 0 else (door + thick, 0.0)
            made.known.append(wall(-depth + left, y, -right, y, thick))
    return made


def _plug(random: np.random.Generator, x: float, y: float, door: float):
    """What closes a door: a disc, or a slab across it."""
    if random.random() < 0.5:
        return x, y, 0.5 * door * float(random.uniform(0.8, 1.0))
    return wall(x, y - 0.48 * door, x, y + 0.48 * door, float(random.uniform(0.2, 1.0)))


def mission(number: int) -> tuple[str, vs.Mission, str]:
    """A drive by its number: what it is, in words; its mission; and what the oracle says."""
    random = np.random.default_rng((SEED, number))
    family = list(ROBOTS)[number % len(ROBOTS)]
    robot = {"max_speed_mps": float(random.uniform(0.8, 2.0)), "max_accel_mps2": 1.0}
    robot |= ROBOTS[family]
    sight = float(random.uniform(2, 8))
    if random.random() < 0.5:
        fov = float(random.choice([120.0, 270.0, 360.0]))
        robot["sensor"] = {"lidar": {"range_m": max(3.0, sight), "fov_deg": fov}}
    else:
        robot["sensor"] = {"range_m": sight}
    if random.random() < 0.2:
        robot["max_jerk_mps3"] = float(random.uniform(0.5, 3))
    spec = vs.Mission.model_validate(
        {"robot": robot, "route": {"start": [0, 0], "goal": [1, 0]}}
    ).robot
    body = max((math.hypot(*corner) for corner in spec.footprint or ()), default=spec.radius_m)
    required = body + spec.clearance_m + TURN_ROOM * (spec.turn_radius or 0.0)
    kind = str(random.choice(KINDS))
    made = rooms(random, kind, 2.0 * required + float(random.uniform(0.8, 2.6)))
    west, _, east, _ = made.bounds
    start = (0.7 * west, float(random.uniform(-3, 3)))
    goal = (east + 0.3 * west, float(random.uniform(-3, 3)))
    _add_lumps(random, made, (start, goal), required + 1.0)
    what = f"{family}, {kind}, {'lidar' if spec.sensor.lidar else 'range sensor'}"
    data = {
        "world": {
            "bounds": made.bounds,
            "known": [_shape(thing) for thing in made.known],
            "unseen": [_shape(thing) for thing in made.unseen],
        },
        "robot": robot,
        "route": {"start": start, "goal": goal},
    }
    distances = distances_to(made.shapes, required + 1.0, made.bounds, STEP_M)
    distances = inside_bounds(distances, made.bounds, STEP_M)
    truth = verdict(distances, made.bounds, STEP_M, start, goal, required)
    return what, vs.Mission.model_validate(data), truth


def _add_lumps(random: np.random.Generator, made: Rooms, ends, room: float) -> None:
    """Add discs that leave so much room about both ends [m]; of some the map doesn't tell."""
    for _ in range(int(random.integers(0, 25))):
        x, y = random.uniform(made.bounds[:2], made.bounds[2:]).tolist()
        radius = float(random.uniform(0.1, 1.2))
        into = made.unseen if random.random() < 0.4 else made.known
        if min(math.dist((x, y), end) for end in ends) > radius + room:
            into.append((x, y, radius))


def _shape(thing) -> dict:
    if isinstance(thing, tuple):
        return {"circle": {"center": thing[:2], "radius": thing[2]}}
    return {"polygon": thing.tolist()}


def least_gap(run: vs.Run) -> float:
    """From the body as it was driven to the nearest thing [m]."""
    world, robot = run.plan.mission.world, run.plan.mission.robot
    things = shapely.union_all([shape_of(thing) for thing in (*world.known, *world.unseen)])
    places = np.asarray(run.positions)
    if robot.footprint is None:
        return float(shapely.distance(shapely.points(places), things).min()) - robot.radius_m
    bodies = bodies_at(robot.footprint, places, run.headings)
    return float(shapely.distance(bodies, things).min())


def main(count: int = 60, first: int = 0) -> None:
    """Drive them, and tell how many came to their end."""
    compile_curves()
    compile_driving()
    driven = reached = 0
    for number in range(first, first + count):
        what, asked, truth = mission(number)
        if truth != "open":
            continue
        steps = Steps()
        try:
            run = measured(asked, vs.plan(asked), [steps])
        except vs.PlanningError as error:
            print(f"{number}: {what}: no plan: {error}", flush=True)
            continue
        driven, reached = driven + 1, reached + run.reached
        outcome = "reached" if run.reached else f"stands: {run.reason}"
        moving, still = (1e3 * max(some, default=0.0) for some in (steps.under_way, steps.standing))
        print(
            f"{number}: {what}: {outcome}; {len(run.replans)} re-plans, {run.duration:.0f} s, "
            f"steps of {moving:.0f} ms under way and {still:.0f} ms standing at most, "
            f"{least_gap(run):.3f} m from what is nearest ({asked.robot.clearance_m:g} asked)",
            flush=True,
        )
    print(f"{reached} of {driven} reached")


if __name__ == "__main__":
    with suppress(KeyboardInterrupt):
        main(*map(int, sys.argv[1:]))
