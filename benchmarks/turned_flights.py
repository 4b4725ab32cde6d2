"""Flights among buildings beside the same turned, mirrored, scaled, reversed, and easier ones.

    python benchmarks/turned_flights.py [MISSIONS] [FIRST] [--kind ...] [--image ...] [--length]
                                        [--to FILE] [--beside FILE]

Each mission (500 x 500 x 100 m, ends 300 m apart; kinds see ``KINDS``) is planned beside images of
itself that take exactly as long (``image_of_flight.py``; scaled, so that all lengths, speeds and
accelerations grow by a factor), and beside easier ones that take no longer: a thinner robot, higher
limits, one thing less. Of each image its time (or length) over the mission's own is told. What a
plan takes over the best of all plans that the mission could have (its own, and those of its images
and of the harder ones), is its regret: it tells of plans that are worse than need be, whichever of
two that is. ``--to`` keeps a row for each mission, and ``--beside`` compares with rows kept before.
"""

from __future__ import annotations

import argparse
import copy
import math
import sys
import time
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np
from image_of_flight import Data, Placed, in_other_order, reversed_route, with_far_thing
from kept_rows import keep, kept
from space_routes import CLEARANCE, key_of, world

KINDS: Final = {"buildings": (50, 0), "mixed": (200, 0), "vias": (50, 2), "slow climb": (50, 0)}
"""How many solids there are, and via points between the ends."""

EXACT: Final = ("turned", "mirrored", "shifted", "scaled", "order", "far thing", "reversed")
EASIER: Final = ("thinner", "less clearance", "faster", "one less")
ALIKE: Final = 0.01
SCALE: Final = 1.7


def mission_of(seed: int, kind: str, optimise: str) -> Data:
    """A mission that can be turned: what bounds it is a fence."""
    count, between = KINDS[kind]
    made, solids, start, goal = world(count, seed)
    rng = np.random.default_rng((seed, 4711))
    via: list[Data] = []
    while len(via) < between:
        at = rng.uniform((30, 30, 5), (470, 470, 60))
        if made.distance(at[None])[0] > CLEARANCE + 0.5:
            via.append({"at": at.tolist()})
    up, down = (1.0, 0.8) if kind == "slow climb" else (2.5, 1.5)
    robot = {
        "radius_m": 0.5, "half_height_m": 0.3, "clearance_m": CLEARANCE, "max_speed_mps": 10.0,
        "max_accel_mps2": 2.0, "max_climb_mps": up, "max_descent_mps": down,
    }  # fmt: skip
    return {
        "world": {
            "fences": [[[0, 0], [500, 0], [500, 500], [0, 500]]],
            "ground": {"flat_m": 0.0},
            "altitude": {"min_m": 2, "max_m": 100, "above": "ground"},
            "known": [{"name": f"o{k}", **key_of(one)} for k, one in enumerate(solids)],
        },
        "robot": robot,
        "route": {"start": {"at": start.tolist()}, "via": via, "goal": {"at": goal.tolist()},
                  "optimise": optimise},
    }  # fmt: skip


def scaled(data: Data, by: float) -> Data:
    """All lengths, speeds and accelerations times a factor: it takes as long."""
    timeless = ("altitude", "fences", "ground", "known", "at")

    def grown(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: grown(one) for key, one in value.items()}
        if isinstance(value, list):
            return [grown(one) for one in value]
        return value * by if isinstance(value, int | float) else value

    new = copy.deepcopy(data)
    for key in timeless:
        if key in new["world"]:
            new["world"][key] = grown(new["world"][key])
    for one in (new["route"]["start"], *new["route"]["via"], new["route"]["goal"]):
        one["at"] = grown(one["at"])
    new["robot"] = grown(new["robot"])
    return new


def the_other_way(data: Data) -> Data:
    """Reversed, with what climbs on the way sinking on the way back."""
    new = reversed_route(data)
    assert new is not None  # nothing of these missions has a direction
    robot = new["robot"]
    robot["max_climb_mps"], robot["max_descent_mps"] = (
        robot["max_descent_mps"],
        robot["max_climb_mps"],
    )
    return new


def images(data: Data, seed: int) -> Iterator[tuple[str, Data]]:
    """Images of a mission, and easier ones, by name."""
    rng = np.random.default_rng((seed, 77))
    turn = float(rng.uniform(0.1, 6.2))
    here = Path()
    yield "turned", Placed(turn).mission(data, here)
    yield "mirrored", Placed(mirror=True).mission(data, here)
    yield "shifted", Placed(shift=(1234.5, -777.7, 31.3)).mission(data, here)
    yield "scaled", scaled(data, SCALE)
    yield "order", in_other_order(data, rng)
    yield "far thing", with_far_thing(data)
    yield "reversed", the_other_way(data)
    for name, changes in (
        ("thinner", {"radius_m": 0.4, "half_height_m": 0.25}),
        ("less clearance", {"clearance_m": 0.9 * CLEARANCE}),
        ("faster", {"max_speed_mps": 10.5, "max_accel_mps2": 2.2}),
    ):
        new = copy.deepcopy(data)
        new["robot"].update(changes)
        yield name, new
    new = copy.deepcopy(data)
    del new["world"]["known"][int(rng.integers(len(new["world"]["known"])))]
    yield "one less", new


def planned(data: Data) -> tuple[float, float]:
    """What a mission's plan takes [s or m], NaN where there is none; processor time [s]."""
    import viaspline as vs

    mission = vs.Mission.model_validate(data)
    begun = time.process_time()
    try:
        plan = vs.plan(mission)
    except vs.ViasplineError as error:
        print(type(error).__name__, error, file=sys.stderr)
        return math.nan, time.process_time() - begun
    spent = time.process_time() - begun
    assert plan.certificate.holds
    by_length = data["route"]["optimise"] == "length"
    return float(plan.path.length if by_length else plan.trajectory.duration), spent


def row_of(seed: int, kind: str, optimise: str, asked: list[str] | None) -> dict[str, Any]:
    """What the plans of a mission and its images take."""
    data = mission_of(seed, kind, optimise)
    own, spent = planned(data)
    row: dict[str, Any] = {"seed": seed, "kind": kind, "cpu_s": [spent], "own": own}
    row["images"] = {}
    for name, image in images(data, seed):
        if asked is None or name in asked:
            cost, spent = planned(image)
            is_longer = name == "scaled" and optimise == "length"
            row["images"][name] = cost / SCALE if is_longer else cost
            row["cpu_s"].append(spent)
    return row


def best_known(row: dict[str, Any]) -> float:
    """The best of all plans of a mission that there are: its own, and those of exact images."""
    return float(np.nanmin([row["own"], *(row["images"].get(one, math.nan) for one in EXACT)]))


def told(rows: list[dict[str, Any]]) -> Iterator[str]:
    """What rows come to."""
    names = [name for name in (*EXACT, *EASIER) if any(name in row["images"] for row in rows)]
    for name in names:
        its = np.array([row["images"].get(name, math.nan) / row["own"] for row in rows])
        its = its[np.isfinite(its)]
        worse = np.abs(its - 1.0) if name in EXACT else its - 1.0
        yield (f"| {name} | {len(its)} | {its.mean():.4f} | {its.min():.3f}, {its.max():.3f} | "
               f"{(worse > 0.001).sum()} | {(worse > ALIKE).sum()} |")  # fmt: skip
    regrets = []
    for row in rows:
        same = [row["own"], *(row["images"].get(one, math.nan) for one in EXACT)]
        regrets += (np.array(same) / best_known(row) - 1.0).tolist()
    found = np.array(regrets)
    lost = np.isnan(found).sum()
    found = found[~np.isnan(found)]
    spent = np.array([one for row in rows for one in row["cpu_s"]])
    yield (f"regret of {len(found)} plans: mean {100 * found.mean():.3f} %, 95 % "
           f"{100 * np.percentile(found, 95):.2f} %, most {100 * found.max():.2f} %; over 1 %: "
           f"{(found > ALIKE).sum()}; without a plan: {lost}")  # fmt: skip
    yield (f"processor: median {1e3 * np.median(spent):.0f} ms, mean {1e3 * spent.mean():.0f}, "
           f"worst {1e3 * spent.max():.0f}")  # fmt: skip


def compared(rows: list[dict[str, Any]], before: list[dict[str, Any]]) -> Iterator[str]:
    """Plans now beside those of other sources."""
    old = {(row["seed"], row["kind"]): row for row in before}
    ratios, spent = [], []
    for row in rows:
        if (was := old.get((row["seed"], row["kind"]))) is None:
            continue
        ratios.append(row["own"] / was["own"])
        both = row["images"].keys() & was["images"].keys()
        ratios += [row["images"][name] / was["images"][name] for name in both]
        spent.append(np.median(row["cpu_s"]) / np.median(was["cpu_s"]))
    its = np.array(ratios)
    its = its[np.isfinite(its)]
    yield (f"now over before, {len(its)} plans: mean {its.mean():.5f}, {its.min():.4f} to "
           f"{its.max():.4f}; sooner by 0.1 %: {(its < 0.999).sum()}, later: "
           f"{(its > 1.001).sum()}; processor, median {np.median(spent):.3f}")  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("missions", type=int, nargs="?", default=40)
    parser.add_argument("first", type=int, nargs="?", default=0)
    parser.add_argument("--kind", choices=KINDS, nargs="*", default=list(KINDS))
    parser.add_argument("--image", nargs="*")
    parser.add_argument("--length", action="store_true")
    parser.add_argument("--to", type=Path)
    parser.add_argument("--beside", type=Path)
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    optimise = "length" if asked.length else "time"
    rows = []
    for seed in range(asked.first, asked.first + asked.missions):
        kind = asked.kind[seed % len(asked.kind)]
        row = row_of(seed, kind, optimise, asked.image)
        rows.append(row)
        most = max([row["own"], *(row["images"].get(one, 0.0) for one in EXACT)])
        if most > (1.0 + ALIKE) * best_known(row):
            told_ = ", ".join(f"{k} {v / row['own']:.4f}" for k, v in row["images"].items())
            print(f"{seed} {kind}: {row['own']:.2f}; {told_}", flush=True)
    keep(rows, asked.to)
    for line in told(rows):
        print(line)
    if asked.beside is not None:
        for line in compared(rows, kept(asked.beside)):
            print(line)


if __name__ == "__main__":
    main()
