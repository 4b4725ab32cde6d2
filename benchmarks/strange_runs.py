"""Missions that combine many keys at once, planned, driven, written, and held to what is promised.

    python benchmarks/strange_runs.py [MISSIONS] [FIRST] [--kind KIND ...] [--plans] [--limit 120]

The kinds take turns (``strange_missions.py``). What the files say is checked without the planner
(``strange_oracle.py``), and that there is no defect, that every step of the navigator is short,
that a saved plan is read again as what it was, that its exports are as clear as they say, and of
every seventh mission that it gives the same bytes again. Each fault is told with its seed.
"""

from __future__ import annotations

import json
import math
import tempfile
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from steps import Steps, measured
from strange_drives import run_faults
from strange_hunt import Found, Job, hunt, told_of
from strange_missions import KINDS, StrangeMissions
from strange_oracle import Asked, Faults, open_legs, route_places
from strange_plans import plan_faults

STEP_S = 0.2
AGAIN = 7
SLOW_PLAN_S = 10.0


def drawn(seed: int, kinds: tuple[str, ...], folder: Path) -> tuple[str, Asked]:
    """The mission of a seed, and its kind."""
    kind = kinds[seed % len(kinds)]
    rng = np.random.default_rng((seed, KINDS.index(kind)))
    return kind, Asked(StrangeMissions(rng, kind, folder).draw(), folder)


def run(job: Job) -> Found:
    """The kind of a mission, how it ended, and its faults."""
    seed, kinds, drives = job
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        kind, asked = drawn(seed, kinds, folder)
        (folder / "strange.yaml").write_text(json.dumps(asked.data), encoding="utf-8")
        looks = looked_at(asked, folder, again=seed % AGAIN == 0, drives=drives)
        return kind, *told_of(looks)


def looked_at(asked: Asked, folder: Path, *, again: bool, drives: bool) -> Any:
    """Faults of a mission that is planned and driven, and the word for how it ended."""
    import viaspline as vs
    from viaspline.report.files import results
    from viaspline.report.files.csv_tables import run_csv
    from viaspline.report.files.run_json import run_json

    file = folder / "strange.yaml"
    begin = time.process_time()
    mission = None
    try:
        mission = vs.load(file)
        plan = vs.plan(mission)
    except vs.ViasplineError as error:
        yield type(error).__name__
        if isinstance(error, vs.MissionError):
            yield "refused", str(error)
        if isinstance(error, vs.GaveUpError):
            yield "gave up", str(error)
        if isinstance(error, vs.NoPathError) and open_legs(asked, ("known",)):
            yield "wrong refusal", str(error)
        if again and mission is not None:
            yield from same_refusal(mission, error)
        return
    finally:
        if (spent := time.process_time() - begin) > SLOW_PLAN_S:
            yield "slow plan", f"{spent:.1f} s"
    contents = results.path_contents(plan, "strange")
    written = json.loads(contents["plan.json"])
    yield from plan_faults(asked, written, contents["path.csv"])
    if again and results.path_contents(vs.plan(mission), "strange") != contents:
        yield "bytes", "another plan the second time"
    yield from saved_faults(plan, contents, folder)
    yield from export_faults(asked, plan, folder)
    yield "planned"
    if not drives:
        return
    steps = Steps()
    drive = measured(plan.mission, plan, [steps])
    yield "reached" if drive.reached else "stands"
    for name, took in (("slow step", steps.under_way), ("slow step standing", steps.standing)):
        if max(took, default=0.0) > STEP_S:
            yield name, f"{max(took):.2f} s"
    told = json.loads(run_json(drive, "strange"))
    yield from run_faults(asked, told, run_csv(drive))
    if not drive.reached:
        is_open = open_legs(asked, ("known", "unseen"))
        yield "not reached" if not is_open else "stands, though open", str(drive.reason)
    if again:
        second = vs.simulate(plan.mission, plan=plan)
        if run_json(second, "strange") != run_json(drive, "strange"):
            yield "bytes", "another run the second time"


def same_refusal(mission: Any, error: Exception) -> Faults:
    """A refusal is the same the second time."""
    import viaspline as vs

    try:
        vs.plan(mission)
    except type(error) as second:
        if str(second) != str(error):
            yield "bytes", f"another refusal the second time: {second}"
    else:
        yield "bytes", "planned the second time"


def saved_faults(plan: Any, contents: dict[str, Any], folder: Path) -> Faults:
    """A plan is read again as what it was."""
    import viaspline as vs
    from viaspline.report.files import results

    for name, text in {**contents, **results.mission_contents(plan.mission, folder)}.items():
        (folder / name).write_text(text, encoding="utf-8")
    try:
        if vs.load_plan(folder) != plan:
            yield "saved", "another plan is read again"
    except vs.ViasplineError as error:
        yield "saved", f"refused: {error}"


def export_faults(asked: Asked, plan: Any, folder: Path) -> Faults:
    """The lines of an export go through all places, and are as clear as it says."""
    import viaspline as vs

    try:
        exported = vs.export(plan, folder / "strange.csv")
    except vs.ViasplineError as error:
        yield "export", f"refused: {error}"
        return
    rows = np.genfromtxt(folder / "strange.csv", delimiter=",", names=True, dtype=None,
                         encoding="utf-8")  # fmt: skip
    line = np.column_stack([rows["x_m"], rows["y_m"]])
    for place in route_places(asked):
        if np.hypot(*(line - place).T).min() > 1e-6:
            yield "export", f"not through {place}"
    if asked.body.corners is None and exported.proof.clearance is not None:
        parts = shapely.linestrings(np.stack([line[:-1], line[1:]], axis=1))
        least = float(asked.distances(parts, ("known",)).min())
        if math.isfinite(least) and least < exported.proof.clearance - 2e-5:
            yield "export", f"{least:.6f} m clear, {exported.proof.clearance:.6f} m proven"


if __name__ == "__main__":
    hunt(__doc__.splitlines()[0], KINDS, run)
