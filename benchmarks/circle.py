"""Vector worlds for a robot of radius 2 m with a turning circle of 4 m, beside the one without.

    python benchmarks/circle.py [SEEDS]

Both plan the same worlds in turn; the length is compared with that of the shortest way round the
corners (taut lines and arcs), curvature is bounded by proof.
"""

from __future__ import annotations

import sys

import numpy as np
from timing import in_turn
from worlds import GOAL, RADIUS, SIZE, START, dense, obstacles

import viaspline as vs
from viaspline.curve.bending import curvature_bound
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.planning.routing.route_problem import on_the_line

CIRCLE, ROUNDS = 4.0, 7


def mission(found: list[vs.Obstacle], circle: float | None) -> vs.Mission:
    world = {"known": found, "bounds": [0, 0, SIZE, SIZE]}
    robot = {"radius_m": RADIUS, "clearance_m": 0, "min_turn_radius_m": circle}
    route = {"start": list(START), "goal": list(GOAL)}
    return vs.Mission.model_validate({"world": world, "robot": robot, "route": route})


def corner_length(asked: vs.Mission) -> float:
    """Length of the taut path [m]."""
    world, requirements = vs.World.known(asked), Requirements.of(asked)
    asked_for = PathProblem.of(via_sequence_of(asked), world, requirements)
    leg = LegSearch(asked_for.sequence, 0, world, requirements, asked_for.router)
    return leg.shortest_allowed(on_the_line(world, *leg.ends, requirements.required))[0].length


def main() -> None:
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    print(
        "obstacles  certified  longest/corner  curvature*4m  jump [1/m]  with/without [ms]  ratio"
    )
    for count in (20, 100, 300):
        ratios, lengths, bends, jumps, times, held = [], [], [], [], [], 0
        for seed in range(seeds):
            found = obstacles(seed) if count == 20 else dense(seed, count, RADIUS)
            free, bound = mission(found, None), mission(found, CIRCLE)
            plan = vs.plan(bound)
            held += plan.certificate.holds
            lengths.append(plan.path.length / corner_length(bound))
            bends.append(curvature_bound(plan.path)[0] * CIRCLE)
            jumps.append(max(plan.path.curvature_jumps(), default=0.0))
            calls = {"with": lambda m=bound: vs.plan(m), "without": lambda m=free: vs.plan(m)}
            spent, _ = in_turn(calls, ROUNDS)
            times.append((spent["with"], spent["without"]))
            ratios.append(spent["with"] / spent["without"])
        slow, quick = 1e3 * np.median(times, axis=0)
        print(
            f"{count:9d}  {held:4d} of {seeds:<2d}  {max(lengths):14.5f}  {max(bends):12.5f}  "
            f"{max(jumps):10.1e}  {slow:8.2f} / {quick:.2f}   {np.median(ratios):.2f}"
        )


if __name__ == "__main__":
    main()
