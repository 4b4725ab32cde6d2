"""Whether a side that is asked for is kept, and driven sooner than those that the planner chose.

    python benchmarks/forced_sides.py [--seed 70000] [--missions 250] [--robot disc] [--off 0.7]
                                      [--drive]

Two legs that meet at an angle, a disc in the way of each, the second in the middle of its leg: both
ways round it are equally long unless both discs are moved, up to --off metres along x and y. Either
side of what the ledger names is asked for in turn, and the whole drive is timed beside the one with
the sides that were chosen. An oracle that shares no code with the planner (``passed_sides.py``)
looks on which side every path passes what asks for one. With --drive one forced mission of each is
driven past one or two discs that aren't on the map, by a range sensor or a lidar, with and without
a limit of the jerk, and all new paths are looked at as well. Robots are of the kinds below, or of
those of ``random_drives``.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from passed_sides import wrong_sides
from random_drives import ROBOTS as KINDS

import viaspline as vs
from viaspline.planning.problem.requirements import Requirements

BODY = [[-0.4, -0.5], [1.6, -0.5], [1.6, 0.5], [-0.4, 0.5]]
KEPT = {"clearance_m": 0.3, "tracking_error_m": 0.1}
ROBOTS = {
    "body": KEPT | {"footprint": BODY, "min_turn_radius_m": 2.5}, "disc": KEPT | {"radius_m": 0.5}
} | KINDS  # fmt: skip
MUCH = 2e-3  # of the time
LEAST_LEG_M = 15.0


@dataclass
class Table:
    """What came of all missions.

    Attributes:
        saved: By which part of the time a side that is asked for is sooner, of each mission.
        forced: How many plans with a side that is asked for there were.
        driven: How many of them were driven,
        reached: to their goal,
        replans: and how many new paths these drives took.
        wrong: What was passed on the wrong side, in words.
    """

    saved: list[float] = field(default_factory=list)
    forced: int = 0
    driven: int = 0
    reached: int = 0
    replans: int = 0
    wrong: list[str] = field(default_factory=list)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seed", type=int, default=70_000)
    parser.add_argument("--missions", type=int, default=250)
    parser.add_argument("--robot", choices=ROBOTS, default="disc")
    parser.add_argument("--off", type=float, default=0.0)
    parser.add_argument("--drive", action="store_true")
    asked = parser.parse_args()
    table = Table()
    for seed in range(asked.seed, asked.seed + asked.missions):
        mission = two_legs(seed, asked.robot, asked.off)
        plan = None if mission is None else planned(mission)
        if mission is None or plan is None:
            continue
        forced = list(forced_plans(mission, plan))
        for other in forced:
            note_sides(table, f"{seed}, planned", other.path, other.mission)
        table.forced += len(forced)
        times = [each.trajectory.duration for each in (plan, *forced)]
        table.saved.append(1.0 - min(times) / times[0])
        if asked.drive and forced:
            drive(table, seed, forced[seed % len(forced)].mission)
    print(
        f"{len(table.saved)} missions; a side that is asked for is sooner by more than {MUCH:.1%} "
        f"in {sum(share > MUCH for share in table.saved)}, by {max(table.saved):.2%} at most; "
        f"{table.forced} plans with one, {table.driven} driven, {table.reached} to their goal with "
        f"{table.replans} new paths: {len(table.wrong)} on the wrong side"
    )


def note_sides(table: Table, what: str, path: vs.Path, mission: vs.Mission) -> None:
    """Look on which side a path passes what there is; say so where it is the wrong one."""
    wrong = wrong_sides(path, mission.world.known, Requirements.of(mission).required)
    table.wrong += wrong
    if wrong:
        print(f"{what}: {', '.join(wrong)}", flush=True)


def drive(table: Table, seed: int, mission: vs.Mission) -> None:
    """Drive a mission past something that isn't on its map."""
    random = np.random.default_rng((seed, 5))
    data = mission.model_dump(mode="json", exclude_none=True, exclude_defaults=True)
    vias = np.array([[0.0, 0.0], data["route"]["via"][0]["at"], data["route"]["goal"]["at"]])
    places = [vias[k] + random.uniform(0.2, 0.8) * (vias[k + 1] - vias[k]) for k in range(2)]
    data["world"]["unseen"] = [
        {"circle": {"center": (place + random.normal(0, 1.5, 2)).tolist(),
                    "radius": float(random.uniform(0.3, 1.2))}}
        for place in places[int(random.integers(2)) :]
    ]  # fmt: skip
    lidar = {"range_m": 9.0, "fov_deg": float(random.choice([270.0, 360.0]))}
    data["robot"]["sensor"] = {"range_m": 9.0} if random.random() < 0.5 else {"lidar": lidar}
    if random.random() < 0.3:
        data["robot"]["max_jerk_mps3"] = 1.5
    try:
        mission = vs.Mission.model_validate(data)
        run = vs.simulate(mission)
    except vs.ViasplineError:
        return
    table.driven, table.reached = table.driven + 1, table.reached + run.reached
    table.replans += len(run.replans)
    for number, new in enumerate(run.replans):
        note_sides(table, f"{seed}, new path {number} ({new.mode})", new.path, mission)


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
        "robot": ROBOTS[robot],
        "route": {"start": start, "via": [via], "goal": goal},
    }
    try:
        return vs.Mission.model_validate(data)
    except vs.MissionError:
        return None


def forced_plans(mission: vs.Mission, plan: vs.Plan) -> Iterator[vs.Plan]:
    """The plans with either side of what the ledger names, where there is one."""
    for entry in plan.ledger:
        for side in ("left", "right"):
            forced = planned(on_side(mission, entry.members, side))
            if forced is not None:
                yield forced


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
