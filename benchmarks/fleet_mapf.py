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
from viaspline.fleet.courses import courses_of
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.lattice_order.lattice_paths import SHAPES, lattice_order
from viaspline.fleet.lattice_order.no_lattice_order import NoLatticeOrder
from viaspline.fleet.lattice_order.time_in_order import time_in_order
from viaspline.fleet.timing.rides import rides_of
from viaspline.kernels.fleet.lattice_distances import lattice_distances
from viaspline.maps.movingai import read_movingai, read_problems
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.planner import plan_in

CASES = ("Berlin_1_256:100", "warehouse-10-20-10-2-1:100", "den312d:100", "random-32-32-20:50",
         "crowd:100", "crowd:729")  # fmt: skip
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


def led(members, alone):
    """Robots led over a lattice: their paths, and their laws."""
    order = lattice_order(alone, 0.0)
    if isinstance(order, NoLatticeOrder):
        return None
    best = None
    for shape in SHAPES:
        paths = order.paths(shape)
        courses = courses_of(paths.plans, 0.0)
        crossings = crossings_of(courses)
        rides = rides_of(members, list(paths.plans.values()), courses)
        timing = time_in_order(courses, crossings, rides, list(paths.steps.values()))
        arrive = timing.laws.packed.arrive[courses.packed.first[1:] - 1]
        rank = len(timing.blocked), arrive.sum()
        if best is None or rank < best[0]:
            best = rank, courses, timing
        if shape is SHAPES[0] and not timing.blocked:
            break
    return best[1:]


def main(folder: Path, cases) -> None:
    print(f"{'case':28s} {'served':>8s} {'alone s':>9s} {'sum s':>9s} of shortest  "
          f"{'plan s':>7s} {'lead s':>7s} apart m")  # fmt: skip
    for case in cases:
        name, count = case.split(":")
        asked = crowd(int(count)) if name == "crowd" else on_map(folder, name, int(count))
        members = members_of(*asked)
        world = vs.World.known(members[0].mission)
        plan_s, alone = clock(lambda: {m.name: plan_in(m.mission, world) for m in members})  # noqa: B023
        lead_s, found = clock(lambda: led(members, alone))  # noqa: B023
        if found is None:
            print(f"{case:28s} no lattice")
            continue
        courses, timing = found
        ends = timing.laws.packed.arrive[courses.packed.first[1:] - 1]
        proof = certify_fleet(courses, timing.laws, 0.0)
        least = shortest(asked[0], asked[2])
        by = f"{ends.sum() / least:11.3f}" if least else " " * 11
        total = sum(one.trajectory.duration for one in alone.values())
        served = f"{len(members) - len(timing.blocked)}/{len(members)}"
        print(f"{case:28s} {served:>8s} {total:9.0f} {ends.sum():9.0f} {by}  "
              f"{plan_s:7.2f} {lead_s:7.2f} {proof.separation:.3f}", flush=True)  # fmt: skip


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:] or CASES)
