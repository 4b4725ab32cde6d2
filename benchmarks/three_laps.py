"""Drives of three laps by a boxy robot with wheels and a short sight, past things it doesn't know.

    python benchmarks/three_laps.py [DRIVES [FIRST]]

Of what stands in its way every lap again, a robot has to lay only so much anew as that changes. A
line for each drive: its outcome and, if it stands, why; the steps by the processor's time.
"""

from __future__ import annotations

import sys
import time
from contextlib import suppress

import numpy as np
from random_drives import FIELD_M, ROBOTS, places_apart, random_thing

import viaspline as vs
from viaspline.precompile import compile_curves, compile_driving

SEED = 77
SIGHT_M, LEAST_APART_M, ROOM_M = 2.0, 7.0, 1.5
"""How far the robot sees, between via points at least, and about them from all that stands [m]."""

UNSEEN = 3
"""Things on the legs that aren't on the map,"""

LEAST_RADIUS_M, MOST_RADIUS_M = 0.3, 1.2
"""and their radii [m]."""


def mission(number: int) -> vs.Mission:
    """The mission of a drive, by its number."""
    random = np.random.default_rng((SEED, number))
    robot = {"max_speed_mps": float(random.uniform(0.8, 2.0)), "max_accel_mps2": 1.0}
    robot |= ROBOTS["footprint, differential"] | {"sensor": {"range_m": SIGHT_M}}
    points = places_apart(random, int(random.integers(4, 7)), LEAST_APART_M)
    things = [random_thing(random) for _ in range(int(random.integers(5, 25)))]
    known = [
        shape for reach, at, shape in things if np.hypot(*(points - at).T).min() > reach + ROOM_M
    ]
    return vs.Mission.model_validate({
        "world": {
            "bounds": [-3, -3, FIELD_M + 3, FIELD_M + 3],
            "known": known,
            "unseen": _on_legs(random, points),
        },
        "robot": robot,
        "route": {
            "start": points[0].tolist(), "via": points[1:].tolist(), "closed": True, "laps": 3,
        },
    })  # fmt: skip


def _on_legs(random: np.random.Generator, points: np.ndarray) -> list[dict]:
    """Discs on legs between via points."""
    found: list[dict] = []
    while len(found) < UNSEEN:
        leg = int(random.integers(len(points)))
        begin, end = points[leg], points[(leg + 1) % len(points)]
        at = begin + (end - begin) * random.uniform(0.3, 0.7)
        radius = float(random.uniform(LEAST_RADIUS_M, MOST_RADIUS_M))
        if np.hypot(*(points - at).T).min() > radius + ROOM_M:
            found.append({"circle": {"center": at.tolist(), "radius": radius}})
    return found


def timed_drive(mission: vs.Mission, into: list[float]) -> vs.Run:
    """A drive, and how long each of its steps took [s]."""
    step = vs.Navigator.step

    def timed(nav, state, sensed, now):
        begin = time.thread_time()
        found = step(nav, state, sensed, now)
        into.append(time.thread_time() - begin)
        return found

    vs.Navigator.step = timed
    try:
        return vs.simulate(mission)
    finally:
        vs.Navigator.step = step


def main(count: int = 40, first: int = 0) -> None:
    """Drive them, and tell how many came to their end."""
    compile_curves()
    compile_driving()
    reached = driven = 0
    everything: list[float] = []
    for number in range(first, first + count):
        steps: list[float] = []
        try:
            run = timed_drive(mission(number), steps)
        except vs.PlanningError as error:
            print(f"{number}: no plan: {error}", flush=True)
            continue
        driven, reached = driven + 1, reached + run.reached
        everything += steps
        outcome = "reached" if run.reached else f"stands: {run.reason}"
        took = f"{len(run.replans)} re-plans, {run.duration:.0f} s, {1e3 * max(steps):.0f} ms"
        print(f"{number}: {outcome}; {took}", flush=True)
    worst = 1e3 * np.array(everything or [0.0])
    print(
        f"{reached} of {driven} reached; steps {np.median(worst):.2f} ms in the median, "
        f"{np.percentile(worst, 99):.1f} at 99 %, {worst.max():.0f} at most, "
        f"{(worst > 200).sum()} over 200 ms"
    )


if __name__ == "__main__":
    with suppress(KeyboardInterrupt):
        main(*map(int, sys.argv[1:]))
