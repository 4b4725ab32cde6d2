"""Fleets that combine many keys at once, planned, driven, written, and held to what is promised.

    python benchmarks/strange_fleet_runs.py [FLEETS] [FIRST] [--kind KIND ...] [--plans]

As ``strange_runs.py`` for missions: the kinds take turns (``strange_fleets.py``). The files are
checked without the planner: each robot's as those of a mission, and the fleet's by
``strange_fleet_oracle.py``. Also: that a saved plan is read again as what it was, that of every
seventh fleet the same bytes come again, that remedies help where they are followed, that no drive
with delays, and none by ``FleetNavigator`` with lost messages, dead robots, newcomers and others
sent elsewhere, has a contact or a deadlock, and what planning takes of the processor.
"""

from __future__ import annotations

import json
import tempfile
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from odd_fleet_drives import NavigatorDrive
from strange_fleet_changes import changed
from strange_fleet_oracle import Robot, driven_faults, fleet_faults
from strange_fleets import FLEET_KINDS, FLYING, StrangeFleets, drawn_robots
from strange_flight_oracle import AskedFlight
from strange_flight_plans import flight_plan_faults
from strange_hunt import Found, Job, hunt, told_of
from strange_oracle import Asked, Faults
from strange_plans import plan_faults

AGAIN = 7
SLOW_PLAN_S = 20.0
MOST_REMEDIES = 2
"""Of a fleet that are followed."""


def run(job: Job) -> Found:
    """The kind of a fleet, how it ended, and its faults."""
    seed, kinds, drives = job
    warnings.simplefilter("ignore")
    kind = kinds[seed % len(kinds)]
    rng = np.random.default_rng((seed, 200 + FLEET_KINDS.index(kind)))
    with tempfile.TemporaryDirectory() as name:
        draws = StrangeFleets(rng, kind, Path(name))
        data = draws.draw()
        file = Path(name) / "strange.yaml"
        file.write_text(json.dumps(draws.files(data), indent=1), encoding="utf-8")
        looks = looked_at(data, file, kind, seed, drives=drives)
        return kind, *told_of(looks)


def looked_at(data: dict[str, Any], file: Path, kind: str, seed: int, *, drives: bool) -> Any:
    """Faults of a fleet that is planned and driven, and the word for how it ended."""
    import viaspline as vs

    begin = time.process_time()
    fleet = None
    try:
        fleet = vs.load(file)
        plan = vs.plan_fleet(fleet)
    except vs.ViasplineError as error:
        yield type(error).__name__
        yield "gave up" if isinstance(error, vs.GaveUpError) else "refused", str(error)
        return
    finally:
        if (spent := time.process_time() - begin) > SLOW_PLAN_S:
            yield "slow plan", f"{spent:.1f} s for {len(data['fleet'])} robots"
    told, plans, tables = written(plan)
    robots = robots_of(data, told, plans, flies=kind in FLYING)
    for one in robots:
        if one.plan is not None:
            asked = (AskedFlight if one.flies else Asked)(one.data, file.parent)
            look = flight_plan_faults if one.flies else plan_faults
            for word, what in look(asked, one.plan, tables[one.name]):
                if word != "jump":  # bent aside and led over lattices: told from 0.02 1/m on
                    yield word, f"{one.name}: {what}"
    yield from fleet_faults(data, robots, told)
    if seed % AGAIN == 0 and written(vs.plan_fleet(fleet)) != (told, plans, tables):
        yield "bytes", "another plan the second time"
    yield from saved_faults(plan, file.parent / "saved")
    for one in told["refused"]:
        yield "not served", f"{one['name']} {one['outcome']}: {one['reason']}; {one['remedy']}"
    yield from remedy_faults(data, told)
    yield "served" if told["served"] else "some served" if plans else "none served"
    if drives and plans:
        yield from simulated_faults(data, robots, plan, seed)
        if not fleet.world.moving:
            yield from navigated_faults(plan, seed, 36.0 if kind in FLYING else 22.0)


def written(plan: Any) -> tuple[dict[str, Any], dict[str, Any], dict[str, str]]:
    """What is written of a plan: of the fleet, and each robot's plan and table, by name."""
    from viaspline.report.files.fleet_json import fleet_json
    from viaspline.report.files.fleet_results import folder_names, robot_contents

    names = folder_names(one.name for one in plan.fleet.members)
    files = {name: robot_contents(one, name) for name, one in plan.plans.items()}
    plans = {name: json.loads(one["plan.json"]) for name, one in files.items()}
    told = json.loads(fleet_json(plan, "strange", names))
    return told, plans, {name: str(one["path.csv"]) for name, one in files.items()}


def robots_of(
    data: dict[str, Any], told: dict[str, Any], plans: dict[str, Any], *, flies: bool
) -> list[Robot]:
    """The robots by their files; patrols with as many laps as are planned."""
    laps = {one["name"]: one["laps_planned"] for one in told.get("patrols", {}).get("robots", ())}
    drawn, found = drawn_robots(data), []
    for one in data["fleet"]:
        name, mission = one["name"], drawn[one["name"]]
        route = mission["route"]
        is_patrol = bool(route.get("closed")) and "laps" not in route
        if name in laps:
            mission = {**mission, "route": {**route, "laps": laps[name]}}
        stands = np.zeros(3)
        if flies:
            stands[:] = standing_in_space(mission)
        else:
            stands[:2] = route["start"]["at"]
        leaves = one["rest"] == "leave" and not is_patrol
        found.append(Robot(name, mission, plans.get(name), leaves, flies, stands))
    return found


def standing_in_space(mission: dict[str, Any]) -> list[float]:
    """Where a drone stands before it sets out."""
    asked = AskedFlight(mission, Path())
    if "takeoff" not in mission["route"]:
        return asked.of_point(mission["route"]["start"])
    if "terrain" in mission["world"].get("ground", {}):
        return [1e6, 1e6, 0.0]  # its file is gone by now; nobody is near
    return asked.places()[0]


def saved_faults(plan: Any, folder: Path) -> Faults:
    """A plan is read again as what it was."""
    import odd_fleets

    import viaspline as vs

    folder.mkdir()
    try:
        odd_fleets.save_without_picture(plan, folder)
        if vs.load_fleet_plan(folder) != plan:
            yield "saved", "another plan is read again"
    except vs.ViasplineError as error:
        yield "saved", f"refused: {error}"


def remedy_faults(data: dict[str, Any], told: dict[str, Any]) -> Faults:
    """Changes that were said to help, and don't."""
    import viaspline as vs

    served = {one["name"] for one in told["robots"] if one["plan"] is not None}
    for one in told["refused"][:MOST_REMEDIES]:
        other = changed(data, one["remedy"])
        if other is None or not other["fleet"]:
            continue
        try:
            plan = vs.plan_fleet(vs.Fleet.model_validate(other))
        except vs.ViasplineError as error:
            yield "remedy", f"{one['remedy']}: {error}"
            continue
        left = {name["name"] for name in other["fleet"]}
        missing = ((served | {one["name"]}) & left) - set(plan.plans)
        if missing:
            yield "remedy", f"{one['remedy']}, for {one['name']}: {sorted(missing)} not served"


def simulated_faults(data: dict[str, Any], robots: list[Robot], plan: Any, seed: int) -> Faults:
    """Contacts, deadlocks and limits of drives with delays."""
    import viaspline as vs
    from viaspline.report.files.fleet_run_json import fleet_run_json

    moves = bool(plan.fleet.world.moving)
    for k in range(1 if moves else 2):
        delays = vs.Delays() if moves else vs.Delays(
            slowed=0.3 * k, halts=1.0, halts_s=10.0, lost=0.3 * (seed % 2 == 0))  # fmt: skip
        drive = vs.simulate_fleet(plan.fleet, delays, plan, seed=seed + k)
        told = json.loads(fleet_run_json(drive, "strange"))
        yield from driven_faults(data, robots, told, drive.distance_at)


def navigated_faults(plan: Any, seed: int, field: float) -> Faults:
    """Contacts and robots that stand for ever, driven by the navigator."""
    import viaspline as vs

    try:
        drive = NavigatorDrive(plan, np.random.default_rng((seed, 1)), field)
    except vs.GeometryError as error:  # robots stop shorter than the plan has room for: it says so
        yield "navigator refused", str(error)
        return
    for fault in drive.faults():
        yield "navigator", fault


if __name__ == "__main__":
    hunt(__doc__.splitlines()[0], FLEET_KINDS, run)
