"""How well robots with a footprint are driven, beside a disc as wide on the same missions.

    python benchmarks/driven_bodies.py [--seed 40] [--missions 16] [--rooms] [--closed]

Four via points among twelve discs, or --rooms with doors; --closed: back to the start, on and on.
Put another checkout's ``src`` in ``PYTHONPATH`` to measure that.
"""

from __future__ import annotations

import argparse

import numpy as np
from driven_missions import four_vias, rooms
from driven_plan import DrivenPlan

import viaspline as vs

LONG = [[-0.4, -0.4], [1.2, -0.4], [1.2, 0.4], [-0.4, 0.4]]
ROBOTS = {
    "disc": {"radius_m": 0.4},
    "cart": {"footprint": [[-0.6, -0.4], [0.6, -0.4], [0.6, 0.4], [-0.6, 0.4]]},
    "truck": {"footprint": LONG},
    "car": {"footprint": LONG, "min_turn_radius_m": 1.5},
}
CLEARANCE_M = 0.3


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seed", type=int, default=40)
    parser.add_argument("--missions", type=int, default=16)
    parser.add_argument("--rooms", action="store_true")
    parser.add_argument("--closed", action="store_true")
    asked = parser.parse_args()
    found = {name: {} for name in ROBOTS}
    for seed in range(asked.seed, asked.seed + asked.missions):
        mission = rooms(seed) if asked.rooms else four_vias(seed)
        for name in ROBOTS:
            driven = planned(mission, name, asked.closed)
            if driven is not None:
                found[name][seed] = figures(driven)
    print("robot  missions   ms  over the disc, median / worst: time     peak        bending")
    for name, rows in found.items():
        print(line(name, rows, found["disc"]))


def planned(mission: vs.Mission, robot: str, closed: bool) -> DrivenPlan | None:
    """A mission with another robot, planned; None where there is no path."""
    route = mission.route.model_dump(exclude_defaults=True)
    if closed:
        route |= {"via": [*route["via"], route.pop("goal")], "closed": True}
    limits = mission.robot.model_dump(exclude_defaults=True, exclude={"radius_m"})
    try:
        return DrivenPlan.of(vs.Mission.model_validate({
            "world": mission.world,
            "robot": limits | ROBOTS[robot] | {"clearance_m": CLEARANCE_M},
            "route": route,
        }))  # fmt: skip
    except vs.PlanningError:
        return None


def figures(driven: DrivenPlan) -> tuple[float, ...]:
    """Driven time [s], peak curvature [1/m], bending [1/m], time to plan [ms]."""
    shape = driven.shape
    return driven.driving_time, shape.peak, shape.bending, 1e3 * driven.seconds


def line(name: str, rows: dict[int, tuple], discs: dict[int, tuple]) -> str:
    """A row of the table: of those missions that the disc has a path for as well."""
    both = [seed for seed in rows if seed in discs]
    mine, its = (np.array([one[seed] for seed in both]) for one in (rows, discs))
    over = mine[:, :3] / its[:, :3]
    parts = [f"{np.median(part):.4f} / {part.max():.3f}" for part in over.T]
    return f"{name:6s} {len(both):8d} {np.median(mine[:, 3]):5.0f}   {'   '.join(parts)}"


if __name__ == "__main__":
    main()
