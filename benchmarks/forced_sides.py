"""Whether a side that is asked for is driven sooner than those that the planner chose.

    python benchmarks/forced_sides.py [--seed 70000] [--missions 250] [--robot disc] [--off 0.7]

Two legs that meet at an angle, a disc in the way of each, the second in the middle of its leg: both
ways round it are equally long unless both discs are moved, up to --off metres along x and y. Either
side of what the ledger names is asked for in turn, and the whole drive is timed beside the one with
the sides that were chosen.
"""

from __future__ import annotations

import argparse

import numpy as np

import viaspline as vs

BODY = [[-0.4, -0.5], [1.6, -0.5], [1.6, 0.5], [-0.4, 0.5]]
ROBOTS = {"body": {"footprint": BODY, "min_turn_radius_m": 2.5}, "disc": {"radius_m": 0.5}}
MUCH = 2e-3  # of the time
LEAST_LEG_M = 15.0


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seed", type=int, default=70_000)
    parser.add_argument("--missions", type=int, default=250)
    parser.add_argument("--robot", choices=ROBOTS, default="disc")
    parser.add_argument("--off", type=float, default=0.0)
    asked = parser.parse_args()
    saved = []
    for seed in range(asked.seed, asked.seed + asked.missions):
        mission = two_legs(seed, asked.robot, asked.off)
        plan = None if mission is None else planned(mission)
        if mission is not None and plan is not None:
            saved.append(1.0 - least_forced(mission, plan) / plan.trajectory.duration)
    print(
        f"{len(saved)} missions; a side that is asked for is sooner by more than {MUCH:.1%} in "
        f"{sum(share > MUCH for share in saved)}, by {max(saved):.2%} at most"
    )


def two_legs(seed: int, robot: str, off: float) -> vs.Mission | None:
    """A mission; None where its second leg is short or ends in a disc."""
    random = np.random.default_rng(seed)
    vias = np.array([[0.0, 0.0], [30.0, 0.0], [30.0, 0.0]])
    vias[2] += random.uniform(-30, 30, 2)
    if np.linalg.norm(vias[2] - vias[1]) < LEAST_LEG_M:
        return None
    centers = np.array([[12.0, random.uniform(-1, 1)], 0.5 * (vias[1] + vias[2])])
    if off > 0.0:
        random = np.random.default_rng(seed + 10**6)
        centers += [random.uniform(-off, off, 2) for _ in centers]
    start, via, goal = vias.tolist()
    data = {
        "world": {
            "known": [
                {"circle": {"center": center, "radius": radius}}
                for center, radius in zip(centers.tolist(), (2.0, 1.5), strict=True)
            ]
        },
        "robot": {"clearance_m": 0.3, "tracking_error_m": 0.1} | ROBOTS[robot],
        "route": {"start": start, "via": [via], "goal": goal},
    }
    try:
        return vs.Mission.model_validate(data)
    except vs.MissionError:
        return None


def least_forced(mission: vs.Mission, plan: vs.Plan) -> float:
    """The least time of plans with a side that is asked for [s]."""
    times = [plan.trajectory.duration]
    for entry in plan.ledger:
        for side in ("left", "right"):
            forced = planned(on_side(mission, entry.members, side))
            if forced is not None:
                times.append(forced.trajectory.duration)
    return min(times)


def on_side(mission: vs.Mission, members: tuple[str, ...], side: str) -> vs.Mission:
    """A mission that passes some obstacles on a side."""
    data = mission.model_dump(mode="json", exclude_none=True)
    for k, obstacle in enumerate(data["world"]["known"]):
        if f"obstacle {k + 1}" in members:
            obstacle["pass_on"] = side
    return vs.Mission.model_validate(data)


def planned(mission: vs.Mission) -> vs.Plan | None:
    """Its plan, if there is one."""
    try:
        return vs.plan(mission)
    except vs.PlanningError:
        return None


if __name__ == "__main__":
    main()
