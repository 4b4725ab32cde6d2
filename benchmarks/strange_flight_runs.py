"""Missions in space that combine many keys at once, planned, flown, written and held to promises.

    python benchmarks/strange_flight_runs.py [MISSIONS] [FIRST] [--kind KIND ...] [--plans]

Seeds from 1,000,000 on are missions that are made harder (``strange_hard_flights.py``).

As ``strange_runs.py`` for the plane: the kinds take turns (``strange_flights.py``), and what the
files say is checked without the planner (``strange_flight_oracle.py`` and its neighbours). Of every
seventh mission it is seen that it gives the same bytes again. Each fault is told with its seed.
"""

from __future__ import annotations

import json
import tempfile
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np
from strange_flight_drives import flight_faults
from strange_flight_oracle import AskedFlight, Faults
from strange_flight_plans import flight_plan_faults
from strange_flights import FLIGHT_KINDS, StrangeFlights
from strange_hard_flights import HardFlights
from strange_hunt import Found, Job, hunt, told_of
from strange_runs import same_refusal

AGAIN = 7
SLOW_PLAN_S = 10.0
HARD = 1_000_000


def drawn(seed: int, kinds: tuple[str, ...], folder: Path) -> tuple[str, AskedFlight]:
    """The mission of a seed, and its kind."""
    kind = kinds[seed % len(kinds)]
    rng = np.random.default_rng((seed, 100 + FLIGHT_KINDS.index(kind)))
    draws = HardFlights if seed >= HARD else StrangeFlights
    return kind, AskedFlight(draws(rng, kind, folder).draw(), folder)


def run(job: Job) -> Found:
    """The kind of a mission, how it ended, and its faults."""
    seed, kinds, flies = job
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        kind, asked = drawn(seed, kinds, folder)
        (folder / "strange.yaml").write_text(json.dumps(asked.data), encoding="utf-8")
        looks = looked_at(asked, folder, again=seed % AGAIN == 0, flies=flies)
        return kind, *told_of(looks)


def looked_at(asked: AskedFlight, folder: Path, *, again: bool, flies: bool) -> Any:
    """Faults of a mission that is planned and flown, and the word for how it ended."""
    import viaspline as vs
    from viaspline.report.space.spatial_json import flight_csv, flight_json
    from viaspline.report.space.spatial_results import spatial_path_contents

    begin = time.process_time()
    mission = None
    try:
        mission = vs.load(folder / "strange.yaml")
        plan = vs.plan(mission)
    except vs.ViasplineError as error:
        yield type(error).__name__
        yield "refused" if not isinstance(error, vs.GaveUpError) else "gave up", str(error)
        if again and mission is not None:
            yield from same_refusal(mission, error)
        return
    finally:
        if (spent := time.process_time() - begin) > SLOW_PLAN_S:
            yield "slow plan", f"{spent:.1f} s"
    contents = spatial_path_contents(plan, "strange")
    yield from flight_plan_faults(asked, json.loads(contents["plan.json"]), contents["path.csv"])
    if again and spatial_path_contents(vs.plan(mission), "strange") != contents:
        yield "bytes", "another plan the second time"
    yield from saved_faults(plan, folder)
    yield "planned"
    if not flies:
        return
    begin = time.process_time()
    flight = vs.fly(plan)
    if (spent := time.process_time() - begin) > SLOW_PLAN_S:
        yield "slow flight", f"{spent:.1f} s"
    yield "reached" if flight.reached else "hovers"
    told = flight_json(flight, "strange")
    yield from flight_faults(asked, json.loads(told), flight_csv(flight))
    if not flight.reached:
        yield "not reached", flight.reason
    if again and flight_json(vs.fly(plan), "strange") != told:
        yield "bytes", "another flight the second time"


def saved_faults(plan: Any, folder: Path) -> Faults:
    """A plan is read again as what it was."""
    import viaspline as vs

    try:
        plan.save(folder / "saved")
        if vs.load_plan(folder / "saved") != plan:
            yield "saved", "another plan is read again"
    except vs.ViasplineError as error:
        yield "saved", f"refused: {error}"


if __name__ == "__main__":
    hunt(__doc__.splitlines()[0], FLIGHT_KINDS, run)
