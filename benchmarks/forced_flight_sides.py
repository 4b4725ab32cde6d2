"""Whether a flight with a side that is asked for is sooner, or shorter, than the planner's choice.

    python benchmarks/forced_flight_sides.py [--seed 0] [--missions 180] [--optimise time]

One to three buildings, towers and turned boxes, some of them off the ground, stand in a row between
start and goal, mostly with a via point behind them. Each is to be passed left, right, over and
under in turn, and each plan is compared with the one without any such wish.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from copy import deepcopy
from typing import Any

import numpy as np

import viaspline as vs

SIDES = ("left", "right", "over", "under")
MUCH = 3e-3  # of the time, or of the length


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--missions", type=int, default=180)
    parser.add_argument("--optimise", choices=("time", "length"), default="time")
    asked = parser.parse_args()
    saved = []
    for seed in range(asked.seed, asked.seed + asked.missions):
        mission = flight(seed, asked.optimise)
        cost = cost_of(mission)
        if cost is None:
            continue
        others = [other for one in forced(mission) if (other := cost_of(one)) is not None]
        saved.append(1.0 - min([cost, *others]) / cost)
        if saved[-1] > MUCH:
            print(f"{seed}: a side that is asked for gains {saved[-1]:.2%}", flush=True)
    print(
        f"{len(saved)} flights; a side that is asked for gains more than {MUCH:.1%} in "
        f"{sum(share > MUCH for share in saved)}, {max(saved):.2%} at most, "
        f"{np.mean(saved):.3%} in the mean"
    )


def flight(seed: int, optimise: str) -> dict[str, Any]:
    """A mission."""
    random = np.random.default_rng(seed)
    known = [building(random, 15.0 + 25.0 * k) for k in range(int(random.integers(1, 4)))]
    behind = 15.0 + 25.0 * len(known)
    heights = random.uniform(3, 20, 3)
    has_via = random.random() < 0.7
    via = [[behind, float(random.uniform(-8, 8)), float(heights[1])]]
    across = random.choice([1.0, 3.0], 2)
    return {
        "world": {"ground": {"flat_m": 0}, "known": known},
        "robot": {
            "radius_m": 0.4, "max_speed_mps": float(random.choice([5.0, 10.0])),
            "max_climb_mps": 2.5, "max_descent_mps": 1.5,
            "max_accel_mps2": float(across[0]), "max_lateral_accel_mps2": float(across[1]),
        },
        "route": {
            "start": [0, 0, float(heights[0])], "via": via if has_via else [],
            "goal": [behind + 15.0, float(random.uniform(-8, 8)), float(heights[2])],
            "optimise": optimise,
        },
    }  # fmt: skip


def building(random: np.random.Generator, along: float) -> dict[str, Any]:
    """Something that stands in the way, or hangs there."""
    x, y = along + random.uniform(-5, 5), random.uniform(-6, 6)
    half = 0.5 * random.uniform(2, 14, 2)
    low = 0.0 if random.random() < 0.6 else float(random.uniform(2, 15))
    heights = [low, low + float(random.uniform(4, 30))]
    middle = np.array([x, y])
    (left, bottom), (right, top) = middle - half, middle + half
    kind = int(random.integers(3))
    if kind == 0:
        corners = [[left, bottom], [right, bottom], [right, top], [left, top]]
        return {"polygon": np.array(corners).tolist(), "height_m": heights}
    if kind == 1:
        return {"circle": {"center": [x, y], "radius": float(half[0])}, "height_m": heights}
    corners = [[left, bottom, heights[0]], [right, top, heights[1]]]
    low_corner, high_corner = np.array(corners).tolist()
    return {"box": {"min": low_corner, "max": high_corner, "yaw_deg": float(random.uniform(0, 90))}}


def forced(mission: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The mission with each side asked for of each of its obstacles."""
    for k in range(len(mission["world"]["known"])):
        for side in SIDES:
            other = deepcopy(mission)
            other["world"]["known"][k]["pass_on"] = side
            yield other


def cost_of(mission: dict[str, Any]) -> float | None:
    """What the plan of a mission takes [s or m], if there is one."""
    try:
        plan = vs.plan(vs.Mission.model_validate(mission))
    except vs.ViasplineError:
        return None
    by_length = mission["route"]["optimise"] == "length"
    return plan.path.length if by_length else plan.trajectory.duration


if __name__ == "__main__":
    main()
