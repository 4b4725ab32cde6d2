"""Metamorphic relations: random missions are planned, and images of theirs that plan alike.

    python benchmarks/metamorphic.py [MISSIONS] [FIRST] [--kind KIND ...] [--only RELATION ...]
        [--limit S] [--here]

The kinds take turns (``drawn`` says what they are), the relations are those of
``metamorphic_images.py``: turned and far away, mirrored, scaled, told in another order, with what
changes nothing, the other way round. What came of an image is held against what came of the
mission: the same outcome, time, length, drivability, the same gap of a refusal; and every path is
sampled among shapely's shapes (``strange_plans.py``). Each difference is told with its seed.
"""

from __future__ import annotations

import argparse
import copy
import json
import math
import tempfile
import time
import warnings
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import shapely
from completeness import small_problem
from driven_missions import four_vias, lake, rooms, vector_world
from metamorphic_images import RELATIONS, Data, fenced
from problems import rows_of_squares
from random_drives import drives
from strange_missions import KINDS as STRANGE
from strange_missions import StrangeMissions
from strange_oracle import Asked, bezier
from strange_plans import clearance_faults, moving_faults, side_faults, via_faults
from trials import GAP
from work_pool import done

import viaspline as vs
from viaspline.report.files import results

SAME = 0.005  # of time and length
WORSE = 0.02
GAP_M = 1e-3
LONGER_BY_VIA = 0.01
FREE_IN_TIME = ("exchanged",)  # a slimmer body may bend more sharply, and be faster for it
SHUT = "nothing leads from"


@dataclass(frozen=True)
class Found:
    """What came of a mission.

    Attributes:
        outcome: ``planned``, ``refused``, ``gave up``, or the error's name.
        time: Of the drive [s].
        length: Of the path [m].
        verdict: Of its drivability.
        words: Of an error, or why it isn't driven well.
        faults: What isn't kept, by shapely.
        seconds: That the planner took [s].
    """

    outcome: str
    time: float = math.nan
    length: float = math.nan
    verdict: str = ""
    words: str = ""
    faults: tuple[tuple[str, str], ...] = ()
    seconds: float = 0.0
    plan: Any = field(default=None, compare=False)


@dataclass(frozen=True)
class AskedOfAll(Asked):
    """A mission whose maps are in memory."""

    @cached_property
    def edges(self) -> list[Any]:
        of_maps = [self._placed(shapely.box(0, 0, *(one.resolution * np.array(
            one.blocked.shape[::-1]))), one).exterior for one in self.grids]  # fmt: skip
        return [*Asked.edges.func(self), *of_maps]

    @property
    def grids(self) -> list[vs.Grid]:
        """The maps."""
        return [one["grid"] for one in self.data["world"]["known"] if "grid" in one]

    def standing(self, which: str) -> list[Data]:
        return [one for one in super().standing(which) if "grid" not in one]

    def distances(self, cores: np.ndarray, which: tuple[str, ...]) -> np.ndarray:
        least = super().distances(cores, which)
        for grid in self.grids:
            squares = self._placed(rows_of_squares(grid.blocked, grid.resolution), grid)
            if len(squares):
                tree = shapely.STRtree(squares)
                at = tree.nearest(cores)
                gaps = shapely.distance(cores, squares[at]) - self.body.radius
                least = np.minimum(least, gaps)
        return least

    @staticmethod
    def _placed(shapes: Any, grid: vs.Grid) -> Any:
        x, y, yaw = grid.origin
        cos, sin = math.cos(yaw), math.sin(yaw)
        turn = np.array([[cos, sin], [-sin, cos]])
        return shapely.transform(shapes, lambda at: at @ turn + (x, y))


def plain(node: Any) -> Any:
    """Lists for tuples, and maps as they are."""
    if isinstance(node, dict):
        return {key: plain(value) for key, value in node.items()}
    if isinstance(node, (list, tuple)):
        return [plain(one) for one in node]
    return node


def data_of(mission: vs.Mission) -> Data:
    """What a mission was made of."""
    data = mission.model_dump(exclude_none=True, exclude_defaults=True, mode="python")
    data["world"]["known"] = [
        {"grid": one.grid} if one.grid is not None else told
        for one, told in zip(mission.world.known, data["world"].get("known", ()), strict=True)
    ]
    return plain(data)


def strange(seed: int, kind: str) -> Data:
    """A strange mission without sensors, and what is seen by these."""
    random = np.random.default_rng((seed, STRANGE.index(kind)))
    with tempfile.TemporaryDirectory() as name:
        data = StrangeMissions(random, kind, Path(name)).draw()
        for one in data["world"]["known"]:
            if "map" in one:
                path, side = Path(name) / one.pop("map"), one.pop("resolution_m")
                (grid,) = (obstacle.grid for obstacle in vs.load_map(path))
                one["grid"] = vs.Grid(grid.blocked, side)
    data["world"].pop("unseen", None)
    for key in ("sensor", "moving", "max_replan_s"):
        data["robot"].pop(key, None)
    if data["spline"].get("tension") == "auto":
        del data["spline"]["tension"]
    is_list = isinstance(data["spline"].get("tension"), list)
    if len(data["route"].get("via", ())) > 1 and not is_list and random.random() < 0.2:
        data["route"]["order"] = "shortest"
    return plain(data)


DRAWN: dict[str, Callable[[int], Data]] = {
    **{kind: (lambda seed, kind=kind: strange(seed, kind))
       for kind in STRANGE if kind not in ("unseen", "lidar", "hidden")},
    "vector": lambda seed: data_of(vector_world(seed)),
    "vias": lambda seed: data_of(four_vias(seed)),
    "lake": lambda seed: data_of(lake(seed)),
    "rooms": lambda seed: data_of(rooms(seed)),
    "small": lambda seed: _of_problem(seed),
    "drive": lambda seed: _of_drive(seed),
}  # fmt: skip
"""Missions by kind and seed."""


def _of_problem(seed: int) -> Data:
    asked = small_problem(seed).asked()
    known = [
        one if isinstance(one, dict) else {"grid": one.grid} for one in asked["world"]["known"]
    ]
    return plain(asked | {"world": asked["world"] | {"known": known}, "spline": {}})


def _of_drive(seed: int) -> Data:
    *_, (_, mission) = drives(1 + seed % 9, seed // 9)
    data = data_of(mission)
    data["world"].pop("unseen", None)
    data["robot"].pop("sensor", None)
    return data


def found_of(data: Data, scale: float = 1.0) -> Found:
    """What comes of a mission; its clearance is looked at as it is, whatever its scale."""
    begin = time.process_time()
    try:
        plan = vs.plan(vs.Mission.model_validate(data))
    except vs.NoPathError as error:
        return Found("refused", words=str(error), seconds=time.process_time() - begin)
    except vs.GaveUpError as error:
        return Found("gave up", words=str(error), seconds=time.process_time() - begin)
    except Exception as error:  # whatever it is, it is told
        return Found(type(error).__name__, words=str(error))
    seconds = time.process_time() - begin
    written = json.loads(results.path_contents(plan, "image")["plan.json"])
    told = written["drivability"]
    words = f"{told['verdict']} {told['reasons']}, radius {told['sharpest_radius_m']}"
    return Found(
        "planned", plan.trajectory.duration, plan.path.length, told["verdict"], words,
        tuple(_faults(data, written, scale)), seconds, plan,
    )  # fmt: skip


def _faults(data: Data, written: Data, scale: float) -> Iterator[tuple[str, str]]:
    asked = AskedOfAll({"spline": {}, **data}, Path())
    asked.data["route"].setdefault("via", [])
    asked.data["robot"].setdefault("clearance_m", 0.5)
    spans = np.array(written["path"]["spans"])
    sampled = _sampled(spans, scale)
    if "order" not in data["route"]:
        yield from via_faults(asked, written, spans)
        yield from side_faults(asked, written, sampled)
    for word, what in clearance_faults(asked, written, sampled):
        if word != "loose" and not what.startswith("holds with"):  # to a proof's slack
            yield word, what
    if scale == 1.0:
        yield from moving_faults(asked, written, spans)


def _sampled(spans: np.ndarray, scale: float) -> tuple:
    """Samples every centimetre or two of the mission, whatever the scale of its image."""
    places, headings, bends, of = bezier(spans / scale)
    return places * scale, headings, bends / scale, of


def differences(name: str, one: Found, other: Found, scale: float) -> Iterator[tuple[str, str]]:
    """What tells an image from its mission, but for its scale."""
    for word, what in other.faults:
        yield f"oracle: {word}", what
    if one.outcome != other.outcome:
        yield f"{one.outcome}, {other.outcome}", f"{one.words} | {other.words}"[:500]
        return
    if one.outcome == "refused":
        gaps = [GAP.search(f.words) for f in (one, other)]
        if None in gaps:
            if gaps != [None, None] or (SHUT in one.words) != (SHUT in other.words):
                yield "reason", f"{one.words} | {other.words}"[:600]
        elif abs(float(gaps[0][1]) - float(gaps[1][1]) / scale) > GAP_M * max(1, 1 / scale):
            yield "gap", f"{gaps[0][1]} and {float(gaps[1][1]) / scale:.4f} m of room"
    if one.outcome != "planned" or name in FREE_IN_TIME:
        return
    takes = other.time / one.time - 1.0
    far = other.length / scale / one.length - 1.0
    if name == "via on it":
        if takes > LONGER_BY_VIA:
            yield "slower by a via", f"{one.time:.3f} s, then {other.time:.3f} s ({takes:+.1%})"
        return
    words = f"{one.time:.3f} s, {one.length:.3f} m; {takes:+.2%} s, {far:+.2%} m"
    if abs(takes) > WORSE:
        yield "time > 2 %", words
    elif abs(takes) > SAME:
        yield "time > 0.5 %", words
    elif abs(far) > SAME:
        yield "length", words
    if one.verdict != other.verdict:
        yield "verdict", f"{one.words} | {other.words}"[:400]


def with_a_via_on_it(data: Data, found: Found) -> Data | None:
    """The mission with one via point more, in the middle of its path's longest straight."""
    route, plan = data["route"], found.plan
    if route.keys() & {"laps", "order", "corridor"} or isinstance(
        data.get("spline", {}).get("tension"), list
    ):
        return None
    u = np.linspace(0, len(plan.path.spans), 40 * len(plan.path.spans) + 1)[:-1]
    places, bends = plan.path.evaluate(u)[:, :2], np.abs(plan.path.curvature(u))
    is_straight = bends * found.length < 1e-6
    best, begin = (0.0, 0, 0), None
    for k, straight in enumerate([*is_straight.tolist(), False]):
        if straight and begin is None:
            begin = k
        if not straight and begin is not None:
            best = max(best, (math.dist(places[begin], places[k - 1]), begin, k - 1))
            begin = None
    long, first, last = best
    if long < 0.02 * found.length:
        return None
    middle = int(np.argmin(np.abs(np.hypot(*(places - places[first]).T) - 0.5 * long)[first:last]))
    middle += first
    at = u[middle]
    passed = [via.u for via in plan.path.vias if via.kind == "user"]
    image = copy.deepcopy(data)
    image["route"].setdefault("via", [])
    before = sum(v <= at for v in passed) - 1
    image["route"]["via"].insert(before, {"at": places[middle].tolist()})
    return image


def run(job: tuple[int, str, tuple[str, ...]]) -> list[tuple[str, str, str]]:
    """What is told of a seed: relation, word, sentence; an empty word counts an image."""
    seed, kind, only = job
    warnings.simplefilter("ignore")
    data = DRAWN[kind](seed)
    bases = {"as drawn": (data, found_of(data))}
    bounded = fenced(data, np.random.default_rng(0))
    one = bases["as drawn"][1]
    told = [("as drawn", f"oracle: {word}", what) for word, what in one.faults]
    told.append(("as drawn", "", one.outcome))
    for number, (name, relation) in enumerate(RELATIONS.items()):
        if name not in only:
            continue
        random = np.random.default_rng((seed, number))
        base, image = "as drawn", relation(data, random)
        if image is None and bounded is not None and name in ("turned", "turned map"):
            if (image := relation(bounded[0], random)) is None:
                continue
            if "fenced" not in bases:
                bases["fenced"] = (bounded[0], found_of(bounded[0]))
            base = "fenced"
        if image is None:
            continue
        told += _told(name, bases[base][1], found_of(*image), image[1])
    if "via on it" in only and one.outcome == "planned":
        image = with_a_via_on_it(data, one)
        if image is not None:
            told += _told("via on it", one, found_of(image), 1.0)
    if data.get("spline", {}).get("tangents") == "cardinal":
        told = [(name, word and f"cardinal: {word}", what) for name, word, what in told]
    return told


def _told(name: str, one: Found, other: Found, scale: float) -> list[tuple[str, str, str]]:
    found = [(name, word, what) for word, what in differences(name, one, other, scale)]
    if other.seconds > 3.0 * one.seconds + 1.0 or one.seconds > 3.0 * other.seconds + 1.0:
        found.append((name, "processor time", f"{one.seconds:.2f} and {other.seconds:.2f} s"))
    return [*found, (name, "", other.outcome)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("missions", type=int, nargs="?", default=60)
    parser.add_argument("first", type=int, nargs="?", default=0)
    names = (*RELATIONS, "via on it")
    parser.add_argument("--kind", choices=DRAWN, nargs="*", default=tuple(DRAWN))
    parser.add_argument("--only", choices=names, nargs="*", default=names)
    parser.add_argument("--limit", type=float, default=120.0, help="seconds for a mission")
    parser.add_argument("--here", action="store_true", help="in this process, without a limit")
    asked = parser.parse_args()
    kinds = tuple(asked.kind)
    jobs = [(seed, kinds[seed % len(kinds)], tuple(asked.only))
            for seed in range(asked.first, asked.first + asked.missions)]  # fmt: skip
    pool = (((job, run(job)) for job in jobs) if asked.here
            else done(run, jobs, 1, math.inf, asked.limit))  # fmt: skip
    images: Counter[str] = Counter()
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for (seed, kind, _), told in pool:
        for name, word, what in told or [("all", "too slow", "")]:
            if not word:
                images[name] += 1
                continue
            counts[name][word] += 1
            print(f"{seed} {kind}, {name}: {word}: {what}", flush=True)
    words = sorted({word for found in counts.values() for word in found})
    print("\n| relation | images | " + " | ".join(words) + " |\n" + "|---" * (len(words) + 2) + "|")
    for name in ("as drawn", *names):
        if images[name]:
            row = [str(counts[name][word] or "") for word in words]
            print(f"| {name} | {images[name]} | " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
