"""Fleets that drive through delays: contacts, deadlocks, how late they are.

    python benchmarks/fleet_delays.py [robots] [runs]

Rounds of 214 m in the mean, as in ``fleet_worlds.py``, of one lap. Robots are slowed by up to 30 %,
or halt once each in the mean, for 30 s. ``own`` is how late they would be if none had to wait for
another. One delay of 20 s is told of each robot in turn; one robot more comes on another round.
"""

from __future__ import annotations

import sys
import time
from contextlib import suppress
from dataclasses import replace

import fleet_worlds
import numpy as np

import viaspline as vs
from viaspline.fleet.courses import courses_of
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.execution.delay_propagation import DelayPropagation
from viaspline.fleet.execution.driven_fleet import DrivenFleet, driven_fleet_of
from viaspline.fleet.execution.fleet_orders import FleetOrders, orders_of
from viaspline.fleet.execution.grown_fleet import grown_fleet
from viaspline.fleet.execution.joined_fleet import LetIn, joined_fleet
from viaspline.fleet.execution.simulate_fleet import drive_fleet
from viaspline.kernels.fleet.crossing_leaders import UNTIMED

TROUBLE = {
    "none": vs.Delays(),
    "slowed by up to 30 %": vs.Delays(slowed=0.3),
    "halts of 30 s": vs.Delays(halts=1.0, halts_s=30.0),
    "both, 20 % lost": vs.Delays(slowed=0.3, halts=1.0, halts_s=30.0, lost=0.2),
}
HOME_M = 3.0  # between two homes


def fleet_of(count: int, seed: int = 0, side: float = 500.0) -> vs.Fleet:
    homes: list[np.ndarray] = []
    members = []
    while len(members) < count:
        for mission in fleet_worlds.round_missions(count, seed, side).values():
            home = np.array(mission.route.start.at)
            if len(members) < count and all(np.hypot(*(home - one)) > HOME_M for one in homes):
                homes.append(home)
                route = {**mission.route.model_dump(exclude_unset=True), "laps": 1}
                members.append({"name": f"r{len(homes)}", "robot": "rover", "route": route})
        seed += 1
    margin = fleet_worlds.MARGIN_M
    return vs.Fleet.model_validate(
        {
            "world": {"bounds": [-margin, -margin, side + margin, side + margin]},
            "separation_m": fleet_worlds.SEPARATION_M,
            "robots": {"rover": fleet_worlds.ROBOT},
            "fleet": members,
        }
    )


def alone(orders: FleetOrders) -> FleetOrders:
    """No orders at all: every robot drives through every other."""
    return replace(orders, leaders=np.full_like(orders.leaders, UNTIMED))


def tell_of_delays(orders: FleetOrders) -> None:
    """How long it takes to say whom a delay of each robot reaches."""
    propagation = DelayPropagation.of(orders)
    propagation.delays(orders.names[0], 20.0)
    took, reached = [], []
    for name in orders.names:
        begin = time.process_time()
        delays = propagation.delays(name, 20.0)
        took.append(1e3 * (time.process_time() - begin))
        reached.append(len(delays))
    print(
        f"one delay propagated: {np.mean(took):.2f} ms in the mean, {np.median(took):.2f} in the "
        f"median, {max(took):.2f} at most; it reaches {np.mean(reached):.0f} robots in the mean"
    )


def one_more(plan: vs.FleetPlan) -> None:
    """How long a robot more takes whose path is given: to find its law, and the whole plan."""
    driven, names = driven_fleet_of(plan), plan.names
    members = fleet_of(10, seed=77).members
    nobody = LetIn(np.full(len(names), np.inf), np.zeros(len(names)), np.zeros(len(names), bool))
    found, joined = [], []
    for member in (replace(one, name="more") for one in members):
        path = vs.plan(member.mission)
        courses = courses_of({**plan.plans, "more": path}, plan.fleet.separation_m)
        begin = time.process_time()
        crossings_of(courses, np.array([len(names)]))
        found.append(1e3 * (time.process_time() - begin))
        begin = time.process_time()
        with suppress(vs.GaveUpError):
            joined_fleet(grown_fleet(driven, member, path), driven.laws.packed, nobody)
            joined.append(1e3 * (time.process_time() - begin))
    print(
        f"one robot more: its crossings {np.median(found):.1f} ms, with its law and put into the "
        f"fleet {np.median(joined):.1f} ms"
    )


def measure(fleet: DrivenFleet, runs: int) -> None:
    begin = time.perf_counter()
    orders = orders_of(fleet)
    print(f"orders: {time.perf_counter() - begin:.3f} s, {orders.packed.place.size} bars")
    tell_of_delays(orders)
    for words, delays in TROUBLE.items():
        late, own, contacts, stuck, least = [], [], 0, 0, np.inf
        begin = time.perf_counter()
        for seed in range(runs):
            run = drive_fleet(fleet, delays, orders=orders, seed=seed)
            late.append(run.mean_delay)
            own.append(drive_fleet(fleet, delays, orders=alone(orders), seed=seed).mean_delay)
            contacts += not run.certificate.separation > 0.0
            least = min(least, run.certificate.separation)
            stuck += bool(run.deadlock)
        took = (time.perf_counter() - begin) / runs
        print(
            f"{words:22} late {np.mean(late):6.2f} s, own {np.mean(own):6.2f} s, "
            f"waits {np.mean(late) - np.mean(own):6.2f} s; contacts {contacts}, deadlocks {stuck} "
            f"in {runs} runs; least separation proven {least:.6f} m; {took:.2f} s a run"
        )


if __name__ == "__main__":
    robots = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    plan = vs.plan_fleet(fleet_of(robots))
    print(f"{len(plan.plans)} of {robots} robots are served")
    one_more(plan)
    measure(driven_fleet_of(plan), int(sys.argv[2]) if len(sys.argv) > 2 else 10)
