"""Whether paths are led past what stands in the way where speed zones let them be driven sooner.

    python benchmarks/slow_zones.py [MISSIONS] [FIRST_SEED]

Each mission goes past fourteen discs of 2 to 9 m on 100 m x 100 m by two via points, at 3 m/s with
1 m/s² both ways, and has three zones of 8 to 40 m with 0.3 to 1.2 m/s. Beside it stands the path of
the same mission without zones, timed in them: that is what choosing without them costs. Then the
same past one post with one zone, beside the better of the two sides when either is asked for.
"""

from __future__ import annotations

import statistics
import sys
from typing import Any

import numpy as np
from timing import clock

import viaspline as vs

ROBOT = {"radius_m": 0.5, "max_speed_mps": 3.0, "max_accel_mps2": 1.0}
LIMITS = vs.Limits(max_speed=3.0, max_accel=1.0, max_lateral_accel=1.0)
Part = dict[str, Any]


def zone(rng: np.random.Generator, least: float, most: float) -> Part:
    (x, y), (w, h) = rng.uniform(0, 80, 2), rng.uniform(least, most, 2)
    corners = [[x, y], [x + w, y], [x + w, y + h], [x, y + h]]
    return {"polygon": corners, "max_speed_mps": float(rng.uniform(0.3, 1.2))}


def mission(known: list[Part], zones: list[Part], places: list[list[float]]) -> vs.Mission:
    route = {"start": places[0], "via": places[1:-1], "goal": places[-1]}
    world = {"known": known, "speed_zones": zones}
    return vs.Mission.model_validate({"world": world, "robot": ROBOT, "route": route})


def among_discs(rng: np.random.Generator) -> tuple[float, float, float] | None:
    """The time planned, that of the path without zones, and the planning's own [s]."""
    places = [{"center": rng.uniform(5, 95, 2).tolist(), "radius": float(rng.uniform(2, 9))}
              for _ in range(14)]  # fmt: skip
    known, zones = [{"circle": one} for one in places], [zone(rng, 8, 40) for _ in range(3)]
    try:
        asked = mission(known, zones, rng.uniform(3, 97, (4, 2)).tolist())
        vs.plan(asked)
    except vs.ViasplineError:  # a via point in a disc, mostly
        return None
    took, planned = clock(lambda: vs.plan(asked))
    world = asked.world.model_copy(update={"speed_zones": ()})
    without = vs.plan(asked.model_copy(update={"world": world}))
    slowed = vs.retime(without.path, LIMITS, zones=asked.world.speed_zones)
    return planned.trajectory.duration, slowed.duration, took


def past_a_post(rng: np.random.Generator) -> float:
    """The time planned over the better one of both sides when they are asked for."""
    at = [50 + float(rng.uniform(-15, 15)), 50 + float(rng.uniform(-6, 6))]
    post, zones = {"circle": {"center": at, "radius": 7.0}}, [zone(rng, 10, 50)]
    places = [[5, 50], [95, 50]]
    sides = ({}, {"pass_on": "left"}, {"pass_on": "right"})
    times = [
        vs.plan(mission([post | side], zones, places)).trajectory.duration for side in sides
    ]  # fmt: skip
    return times[0] / min(times[1:])


def main(count: int, first: int) -> None:
    seeds = [np.random.default_rng(first + k) for k in range(count)]
    found = [one for one in map(among_discs, seeds) if one is not None]
    ratios = sorted(planned / without for planned, without, _ in found)
    took = statistics.median(1e3 * each for *_, each in found)
    print(f"{len(found)} of {count} missions planned, {took:.0f} ms in the median")
    later = sum(ratio > 1.003 for ratio in ratios)
    print("time over that of paths that are chosen without zones:", end=" ")
    print(
        f"{statistics.mean(ratios):.3f} in the mean, {ratios[0]:.2f} to {ratios[-1]:.3f}", end=", "
    )
    print(f"later by 0.3 % in {later}")
    posts = sorted(past_a_post(rng) for rng in seeds)
    mean = statistics.mean(posts)
    print(f"past a post, over the better side: {mean:.4f} in the mean, {posts[-1]:.4f} at most")


if __name__ == "__main__":
    words = sys.argv[1:] + ["150", "0"][len(sys.argv) - 1 :]
    main(int(words[0]), int(words[1]))
