"""Fleets on maps of games and streets, and permuted crowds: who is served, and how soon.

    pip install ".[bench]" && python benchmarks/fleet_mapf.py FOLDER [MAP:ROBOTS ...]

FOLDER has `maps/NAME.map` and `scen/NAME-random-1.scen`, as https://movingai.com/benchmarks/mapf
publishes them. Squares are 1 m; robots are discs of radius 0.35 m, the largest of which two that
go round a corner one behind the other, a square apart, don't touch (1 / sqrt(2) m). They drive
1 m/s at most, with 1 m/s² along the path and across, so that seconds compare with the steps of
solvers whose robots start and stop at once. `crowd:ROBOTS` is a square grid of robots 4 m apart
whose goals are their starts, permuted; these are discs of 0.5 m that drive 2 m/s.

`of shortest` is the sum of all times over the sum of the shortest ways on the squares, which no
solver on squares can beat. That of EECBS (w = 1.2) is 1.001 on Berlin, 1.005 on the warehouse, 1.04
on den312d, 1.11 on random-32-32-20, with 100 robots each.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import numpy as np
from timing import clock

import viaspline as vs
from viaspline.kernels.fleet.lattice_distances import lattice_distances
from viaspline.maps.movingai import read_movingai, read_problems
from viaspline.mission.fleet.fleet import FleetMember

CASES = ("Berlin_1_256:100", "warehouse-10-20-10-2-1:100", "den312d:100", "random-32-32-20:50",
         "crowd:100", "crowd:729", "Berlin_1_256:500")  # fmt: skip
DISC = {"radius_m": 0.35, "clearance_m": 0.0, "max_speed_mps": 1.0, "max_accel_mps2": 1.0}
CROWD = {"radius_m": 0.5, "clearance_m": 0.0, "max_speed_mps": 2.0, "max_accel_mps2": 1.0}


def crowd(count: int):
    """Starts and goals of a permuted crowd."""
    side = math.ceil(count**0.5)
    starts = 4.0 * np.array([(i % side, i // side) for i in range(count)], float)
    random = np.random.default_rng(0)
    starts += random.normal(0, 0.01, starts.shape)
    goals = starts[random.permutation(count)]
    return {}, CROWD, list(zip(starts.tolist(), goals.tolist(), strict=True))


def on_map(folder: Path, name: str, count: int):
    """The world of a map, and starts and goals on it."""
    grid = read_movingai(folder / "maps" / f"{name}.map")
    problems = read_problems(folder / "scen" / f"{name}-random-1.scen")[:count]
    world = {"bounds": grid.extent, "known": [vs.Obstacle(grid=grid)]}
    return world, DISC, [(one.start, one.goal) for one in problems]


def shortest(world, ends) -> int:
    """Sum of the shortest ways on the squares of a map; 0 without a map."""
    if not world:
        return 0
    free = ~world["known"][0].grid.blocked
    numbers = np.full(np.add(free.shape, 2), -1, np.int32)
    numbers[1:-1, 1:-1][free] = np.arange(free.sum())
    beside = numbers[1:-1, 2:], numbers[2:, 1:-1], numbers[1:-1, :-2], numbers[:-2, 1:-1]
    neighbours = np.ascontiguousarray(np.stack([part[free] for part in beside], axis=-1))
    starts, goals = (
        np.array([numbers[int(pair[k][1]) + 1, int(pair[k][0]) + 1] for pair in ends], np.int32)
        for k in (0, 1)
    )
    return int(lattice_distances(neighbours, goals)[np.arange(len(ends)), starts].sum())


def members_of(world, robot, ends) -> list[FleetMember]:
    """Robots that share one world."""
    members = []
    for start, goal in ends:
        route = {"start": start, "goal": goal}
        data = {"robot": robot, "route": route} | ({} if members else {"world": world})
        mission = vs.Mission.model_validate(data)
        if members:
            mission = mission.model_copy(update={"world": members[0].mission.world})
        members.append(FleetMember(f"r{len(members)}", mission))
    return members


def main(folder: Path, cases) -> None:
    print(f"{'case':28s} {'served':>8s} {'alone s':>9s} {'sum s':>9s} of shortest  {'took s':>7s} "
          "apart m")  # fmt: skip
    for case in cases:
        name, count = case.split(":")
        asked = crowd(int(count)) if name == "crowd" else on_map(folder, name, int(count))
        fleet = vs.Fleet.of(members_of(*asked), 0.0)
        took, plan = clock(lambda: vs.plan_fleet(fleet))  # noqa: B023
        ends = sum(one.trajectory.end_time for one in plan.plans.values())
        least = shortest(asked[0], asked[2])
        by = f"{ends / least:11.3f}" if least else " " * 11
        served = f"{len(plan.plans)}/{len(fleet.members)}"
        print(f"{case:28s} {served:>8s} {sum(plan.alone.values()):9.0f} {ends:9.0f} {by}  "
              f"{took:7.2f} {plan.certificate.separation:.3f}", flush=True)  # fmt: skip


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:] or CASES)
