"""What it takes to add a robot to a fleet that is planned: under way, and in its plan.

    python benchmarks/one_robot_more.py [--robots 1000] [--seed 1] [--runs 3]

Rounds of one lap as in ``fleet_worlds.py``, in 500 m x 500 m. Times of the processor, the least of
some runs: with the newcomer's path, its crossings and law, and the orders of all; of a plan also
its proof and who waits for whom.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from functools import partial

from fleet_worlds import SEPARATION_M, round_missions

import viaspline as vs
from viaspline.errors import PlanningError
from viaspline.mission.fleet.fleet import FleetMember

NEWCOMERS = 16  # that are tried: others pass the homes of most, of which they know nothing


def one_lap(mission: vs.Mission) -> vs.Mission:
    """A round that ends where it began, in place of a patrol."""
    return mission.model_copy(update={"route": mission.route.model_copy(update={"laps": 1})})


def least(job: Callable[[], object], runs: int) -> str:
    """The least time that a job takes after a first run; nothing where it is refused."""
    took = []
    for _ in range(runs + 1):
        before = time.process_time()
        try:
            job()
        except PlanningError:
            return ""
        took.append(1e3 * (time.process_time() - before))
    return f"{min(took[1:]):.1f} ms"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--robots", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--runs", type=int, default=3)
    asked = parser.parse_args()
    missions = round_missions(asked.robots + NEWCOMERS, asked.seed)
    members = [FleetMember(name, one_lap(one)) for name, one in missions.items()]
    plan = vs.plan_fleet(vs.Fleet.of(members[: asked.robots], SEPARATION_M))
    _, navigator = vs.FleetNavigator(plan).step([], 0.0)
    print(f"{len(plan.plans)} of {asked.robots} robots are served")
    for name, add in (
        ("under way", navigator.with_robot),
        ("in the plan", partial(vs.add_robot, plan)),
    ):
        found = [least(partial(add, one), asked.runs) for one in members[asked.robots :]]
        print(f"{name}: {', '.join(one for one in found if one) or 'all are refused'}")


if __name__ == "__main__":
    main()
