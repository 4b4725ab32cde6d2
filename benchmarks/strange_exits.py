"""What is exported of strange plans, read back by readers of its own and held to what it says.

    python benchmarks/strange_exits.py [MISSIONS] [FIRST] [--kind KIND ...] [--examples]

Plans of ``strange_missions.py``, ``strange_flights.py`` and ``examples/`` are written in every
format, read by the standard library, PyYAML and mcap, brought back to metres on the ellipsoid by
formulas of their own, and compared: the lines are as near to the exact curve as is said, either
way, as clear as is said, and go through every via point; dwells stand in the file or are told as
lost. Each fault is told with its seed.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import tempfile
import warnings
from collections import Counter
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from strange_flight_runs import drawn as drawn_flight
from strange_flights import FLIGHT_KINDS
from strange_missions import KINDS
from strange_oracle import Faults
from strange_readers import ORIGIN, read
from strange_runs import drawn as drawn_mission
from work_pool import done

FORMATS = ("plan", "waypoints", "path.yaml", "mcap", "geojson", "kml", "gpx", "csv", "json")
HAIR_M = 2e-5
DEGREES_M = 0.012
"""What rounding to 1e-7 degree may move a point by, and a hair [m]."""


def exit_faults(plan: Any, free: Callable[..., np.ndarray] | None, folder: Path) -> Faults:
    """Faults of all exports of a plan.

    Args:
        plan: It.
        free: How clear places (n, 3) are of what stands; None where that isn't asked.
        folder: Where they are written.
    """
    import viaspline as vs

    spans = np.asarray(plan.path.spans)
    longest = np.linalg.norm(np.diff(spans, axis=1), axis=2).sum(axis=1).max()
    count = 1 + math.ceil(longest / 0.01)
    u = np.linspace(0, 1, min(max(count, 8), 8000))[None, :, None]
    a, b, c, d = (spans[:, k, None] for k in range(4))
    curve = (1 - u) ** 3 * a + 3 * (1 - u) ** 2 * u * b + 3 * (1 - u) * u**2 * c + u**3 * d
    curve = curve.reshape(-1, spans.shape[2])
    dwells = sum(station.dwell for station in plan.trajectory.stations)
    home, takes_off = _home(plan), plan.mission.route.takeoff is not None
    for ending in FORMATS:
        file = folder / f"strange.{ending}"
        try:
            exported = vs.export(plan, file, origin=ORIGIN)
        except vs.ViasplineError as error:
            yield "refused", f"{ending}: {error}"
            continue
        points, held = read(file, home)
        if ending in ("plan", "waypoints") and takes_off:
            points = np.concatenate([spans[0, :1], points])  # it stands there, and takes off
            points = points[np.r_[True, np.abs(np.diff(points, axis=0)).max(axis=1) > 1e-6]]
        if ending in ("plan", "waypoints") and plan_lands(plan):
            points[-1, 2] = spans[-1, 3, 2]  # it comes down to the ground, below its middle
        if len(points) != exported.points:
            yield "points", f"{ending}: {len(points)} read, {exported.points} told"
        is_flight = spans.shape[2] == 3 and np.isfinite(points[:, 2]).all()
        axes = 3 if is_flight else 2
        off = DEGREES_M if ending in ("plan", "waypoints") else HAIR_M + 1e-6
        lines = points[:, :axes]
        there = from_lines(curve[:, :axes], lines)
        if there.max() > exported.proof.chord_error + off + 0.003:
            yield "chord", f"{ending}: {there.max():.5f} m, {exported.proof.chord_error:.5f} told"
        dense = sampled(lines)
        back = nearest(dense, curve[:, :axes])
        apart = max(0.01, 0.5 * longest / u.size)  # of the samples of the curve, half
        if back.max() > exported.proof.chord_error + off + apart:
            yield "chord back", f"{ending}: {back.max():.5f}, {exported.proof.chord_error:.5f} told"
        for via in plan.path.vias:
            if via.kind == "user":
                miss = np.linalg.norm(lines - np.array(via.at[:axes]), axis=1).min()
                if miss > off:
                    yield "via", f"{ending}: {via.name} is {miss:.5f} m off"
        told = exported.proof.clearance
        if free is not None and told is not None and math.isfinite(told) and is_flight | (
            spans.shape[2] == 2):  # fmt: skip
            least = free(dense)
            if least < told - off - 1e-5:
                yield "clear", f"{ending}: {least:.5f} m sampled, {told:.5f} m proven"
        lost = any("dwell" in one for one in exported.lost)
        if dwells and not lost and held is not None and abs(held - dwells) > 0.51:
            yield "dwells", f"{ending}: {held} s of {dwells} s, and nothing is told"
        if held is None and dwells and not lost and ending in ("path.yaml", "mcap"):
            yield "dwells", f"{ending}: {dwells} s aren't told"


def plan_lands(plan: Any) -> bool:
    """Whether a flight ends on the ground."""
    return plan.mission.route.land is not None


def _home(plan: Any) -> float:
    if np.asarray(plan.path.spans).shape[2] == 2:
        return 0.0
    ground = plan.mission.world.ground
    if ground is None:
        return 0.0
    return float(ground.heights_at(np.array(plan.mission.route.start.at[:2])))


def sampled(lines: np.ndarray) -> np.ndarray:
    """Places on straight lines every centimetre."""
    found = [lines[:1]]
    for a, b in pairwise(lines):
        count = max(1, math.ceil(float(np.linalg.norm(b - a)) / 0.01))
        found.append(a + np.arange(1, count + 1)[:, None] / count * (b - a))
    return np.concatenate(found)


def nearest(places: np.ndarray, others: np.ndarray) -> np.ndarray:
    from scipy.spatial import cKDTree

    return np.asarray(cKDTree(others).query(places)[0])


def from_lines(places: np.ndarray, lines: np.ndarray) -> np.ndarray:
    """How far places are from straight lines [m]: those of samples every centimetre, about."""
    if places.shape[1] == 2:
        return np.asarray(shapely.distance(shapely.LineString(lines), shapely.points(places)))
    return np.maximum(nearest(places, sampled(lines)) - 0.0025, 0.0)


def run(job: tuple[str, int, tuple[str, ...]]) -> tuple[str, list[tuple[str, str]]]:
    """How a mission ended, and its faults."""
    import viaspline as vs

    which, seed, kinds = job
    warnings.simplefilter("ignore")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        free = None
        try:
            if which == "examples":
                plan = vs.plan(vs.load(kinds[seed]))
            else:
                draws = drawn_mission if which == "plane" else drawn_flight
                _, asked = draws(seed, kinds, folder)
                (folder / "strange.yaml").write_text(json.dumps(asked.data), encoding="utf-8")
                plan = vs.plan(vs.load(folder / "strange.yaml"))
                free = _free(which, asked, plan)
        except vs.ViasplineError as error:
            return type(error).__name__, []
        found = list(exit_faults(plan, free, folder))
        plan.save(folder / "saved")
        if vs.load_plan(folder / "saved") != plan:
            found.append(("saved", "another plan is read again"))
        return "exported", found


def _free(which: str, asked: Any, plan: Any) -> Callable[[np.ndarray], float] | None:
    """The least free space at places of lines [m]."""
    if which == "plane":
        if asked.body.corners is not None:
            return None
        return lambda at: float(asked.distances(shapely.points(at), ("known",)).min())
    starts = [one for one, key in ((plan.path.spans[0, 0], "takeoff"),
                                   (plan.path.spans[-1, 3], "land"))
              if asked.data["route"].get(key)]  # fmt: skip

    def free(at: np.ndarray) -> float:
        upright = np.zeros(len(at), bool)
        for one in starts:
            upright |= np.hypot(*(at[:, :2] - one[:2]).T) < 0.02
        least = np.inf
        for part, ground in ((~upright, True), (upright, False)):
            if part.any():
                least = min(least, float(asked.free(at[part], ("known",), ground=ground).min()))
        return least

    return free


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("missions", type=int, nargs="?", default=60)
    parser.add_argument("first", type=int, nargs="?", default=0)
    parser.add_argument("--which", choices=("plane", "space", "examples"), default="plane")
    parser.add_argument("--kind", nargs="*")
    parser.add_argument("--limit", type=float, default=180.0, help="seconds for a mission")
    asked = parser.parse_args()
    kinds = tuple(asked.kind or (KINDS if asked.which == "plane" else FLIGHT_KINDS))
    seeds = range(asked.first, asked.first + asked.missions)
    if asked.which == "examples":
        folder = Path(__file__).parents[1] / "examples"
        files = (one for one in sorted(folder.iterdir()) if one.suffix in (".yaml", ".plan"))
        kinds = tuple(str(one) for one in files if "fleet:" not in one.read_text())
        seeds = range(len(kinds))
    jobs = [(asked.which, seed, kinds) for seed in seeds]
    ended: Counter[str] = Counter()
    faults: Counter[str] = Counter()
    for (_, seed, _), found in done(run, jobs, 1, math.inf, asked.limit):
        outcome, told = found or ("too slow", [("too slow", "")])
        ended[outcome] += 1
        name = Path(kinds[seed]).name if asked.which == "examples" else seed
        print(f"{name}: {outcome}", file=sys.stderr, flush=True)
        for word, what in told:
            faults[word] += 1
            print(f"{name}: {word}: {what}", flush=True)
    print(", ".join(f"{count} {word}" for word, count in ended.items()))
    print("faults: " + (", ".join(f"{n} x {word}" for word, n in faults.items()) or "none"))


if __name__ == "__main__":
    main()
