"""How often random robots get farther beside their paths than is kept for that.

Wheelbases of 0.3 to 2.5 m, turning circles of 0.5 to 8 m, steering with and without a limit of its
rate, delay, lag and noise at random; open ground with via points, discs, and yards of walls with
gates. Each mission that has a plan is driven so many times by seeds that no trial drive has.

    python benchmarks/kept_allowances.py [--missions N] [--drives N] [--seed N] [--kind KIND]
        [--record FILE] [--beside FILE]

``--record`` keeps what came of each mission, and ``--beside`` a table of that of another version
beside this one, of the missions that both plan.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

import viaspline as vs
from viaspline.errors import ViasplineError
from viaspline.machine.trial_drive import follow

KINDS = ("ackermann", "differential", "skid_steer")
PLACES = ("open", "discs", "yard")
OTHER_SEEDS = 1_000_000
"""Of the first drive; trial drives have smaller ones."""


def robot_of(kind: str, random: np.random.Generator) -> dict[str, Any]:
    """A random robot."""
    wheelbase, circle, rate = np.exp(
        random.uniform(np.log([0.3, 0.5, 15.0]), np.log([2.5, 8.0, 180.0]))
    ).tolist()
    circle = max(circle, 0.6 * wheelbase)  # its wheels turn by 59 deg at most
    drive: dict[str, Any] = {
        "ackermann": {
            "wheelbase_m": wheelbase,
            "max_steer_deg": math.degrees(math.atan(wheelbase / circle)),
            **({"max_steer_rate_degps": rate} if random.random() < 0.7 else {}),
        },
        "differential": {"track_m": 0.5 * wheelbase, "max_wheel_speed_mps": 2.5},
        "skid_steer": {"track_m": 0.5 * wheelbase, "slip": 0.3, "max_wheel_speed_mps": 2.5},
    }[kind]
    faults = dict(
        zip(
            ("delay_s", "lag_s", "speed_noise_mps", "yaw_rate_noise_degps"),
            random.uniform(0.0, (0.2, 0.3, 0.1, 6.0)).tolist(),
            strict=True,
        )
    )
    place = dict(
        zip(
            ("position_noise_m", "heading_noise_deg"),
            random.uniform(0.0, (0.04, 1.2)).tolist(),
            strict=True,
        )
    )
    speed, accel, lateral = random.uniform((0.5, 0.5, 0.4), (2.5, 1.5, 1.5)).tolist()
    half = 0.3 * wheelbase
    front, rear = 1.2 * wheelbase, -0.2 * wheelbase
    box = [[rear, -half], [front, -half], [front, half], [rear, half]]
    body = {"footprint": box} if random.random() < 0.5 else {"radius_m": 0.5 * wheelbase}
    return {
        **body,
        "clearance_m": float(random.uniform(0.05, 0.3)),
        "max_speed_mps": speed, "max_accel_mps2": accel, "max_lateral_accel_mps2": lateral,
        "drive": {kind: drive, **faults}, "localization": place,
    }  # fmt: skip


def mission_of(kind: str, place: str, seed: int) -> vs.Mission:
    """A random mission whose size is that of its robot's turning circle."""
    random = np.random.default_rng((23, KINDS.index(kind), PLACES.index(place), seed))
    robot = robot_of(kind, random)
    reach = max((math.hypot(*at) for at in robot.get("footprint", ())), default=0.0)
    reach = max(reach, robot.get("radius_m", 0.0)) + robot["clearance_m"]
    circle = reach
    if kind == "ackermann":
        steered = robot["drive"][kind]
        circle = steered["wheelbase_m"] / math.tan(math.radians(steered["max_steer_deg"]))
    step = 2.5 * circle + 1.5 * reach
    turns = np.cumsum(random.uniform(-1.6, 1.6, int(random.integers(2, 5))))
    legs = step * random.uniform(0.8, 1.8, (turns.size, 1))
    places = np.concatenate(
        ([[0.0, 0.0]], np.cumsum(legs * np.column_stack((np.cos(turns), np.sin(turns))), axis=0))
    )
    known = things_of(place, places, reach, random)
    start, *vias, goal = ({"at": at} for at in places.tolist())
    if random.random() < 0.5:
        start["heading_deg"] = float(random.uniform(-180, 180))
    if random.random() < 0.5:
        goal["heading_deg"] = float(random.uniform(-180, 180))
    route = {"start": start, "via": vias, "goal": goal}
    return vs.Mission.model_validate({"world": {"known": known}, "robot": robot, "route": route})


def things_of(
    place: str, vias: np.ndarray, reach: float, random: np.random.Generator
) -> list[dict[str, Any]]:
    """What stands there: nothing, discs beside the way, or walls across it with gates."""
    if place == "open":
        return []
    if place == "discs":
        return list(discs_of(vias, reach, random))
    known = []
    for a, b in pairwise(vias):
        along = (b - a) / math.dist(a, b)
        across = np.array((-along[1], along[0]))
        middle = a + random.uniform(0.4, 0.6) * (b - a)
        middle = middle + random.uniform(-0.5, 0.5) * reach * across
        half = random.uniform(1.2, 2.0) * reach
        for side in (-1.0, 1.0):
            near = middle + side * half * across
            far = near + side * random.uniform(0.5, 2.0) * reach * across
            wall = {"from": near.tolist(), "to": far.tolist(), "radius": 0.1}
            known.append({"capsule": wall})
    return [one for one in known if gap_of(one["capsule"], vias) > reach + 0.5]


def discs_of(vias: np.ndarray, reach: float, random: np.random.Generator) -> Iterator[dict]:
    """Discs at random, none of them at a via point."""
    low, high = vias.min(axis=0) - reach, vias.max(axis=0) + reach
    for _ in range(6 * len(vias)):
        at, radius = random.uniform(low, high), float(random.uniform(0.2, 1.0) * reach)
        if np.hypot(*(vias - at).T).min() > radius + 1.5 * reach:
            yield {"circle": {"center": at.tolist(), "radius": radius}}


def gap_of(wall: dict[str, Any], vias: np.ndarray) -> float:
    """The distance of a wall from the nearest via point [m]."""
    a, b = np.array(wall["from"]), np.array(wall["to"])
    w = np.clip((vias - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
    return float(np.hypot(*(a + w[:, None] * (b - a) - vias).T).min()) - wall["radius"]


def driven(kind: str, place: str, seed: int, drives: int) -> dict[str, Any]:
    """One mission: its plan, and how many of its drives left what it keeps."""
    row: dict[str, Any] = {"kind": kind, "place": place, "seed": seed}
    mission = mission_of(kind, place, seed)
    begin = time.process_time()
    try:
        plan = vs.plan(mission)
    except ViasplineError as refusal:
        return {**row, "refused": str(refusal)[:300], "planned_in": time.process_time() - begin}
    planned_in = time.process_time() - begin
    robot = plan.mission.robot
    reach = 0.0 if robot.footprint is None else robot.outer_radius
    off, took = [], []
    for k in range(drives):
        track = follow(plan.path, plan.trajectory, robot, seed=OTHER_SEEDS + k)
        off.append(track.tracking.body_deviation(reach) if track.finished else math.inf)
        took.append(float(track.times[-1]))
    return {
        **row,
        "kept": plan.tracking_error,
        "beyond": int(np.sum(np.array(off) > plan.tracking_error)),
        "drives": drives,
        "median": float(np.median(off)),
        "largest": max(off),
        "took": float(np.mean(took)),
        "length": plan.path.length,
        "circle": robot.turn_radius,
        "own_circle": mission.robot.turn_radius,
        "planned_in": planned_in,
    }  # fmt: skip


def told(rows: list[dict[str, Any]], before: dict[tuple, dict[str, Any]]) -> None:
    """The table, with what another version made of the same missions beside it."""
    print("| robot | place | missions | planned | drives | beyond what is kept | "
          "missions with such drives | kept, median | largest over kept |"
          " driven time, mean and most | path | kept |")  # fmt: skip
    print("|" + "---|" * 12)
    for kind in KINDS:
        for place in (*PLACES, None):
            some = [r for r in rows if r["kind"] == kind and place in (r["place"], None)]
            if some:
                print(line_of(kind, place or "all", some, before))


def line_of(kind: str, place: str, some: list[dict], before: dict[tuple, dict]) -> str:
    """A row of the table; ratios to another version are of what both plan."""
    planned = [row for row in some if "kept" in row]
    drives = sum(row["drives"] for row in planned)
    beyond = sum(row["beyond"] for row in planned)
    cells = [kind, place, f"{len(some)}", f"{len(planned)}", f"{drives}"]
    if not planned:
        return "| " + " | ".join(cells) + " |"
    worst = max(row["largest"] / row["kept"] for row in planned)
    cells += [
        f"{beyond} ({100 * beyond / drives:.2f} %)",
        f"{sum(row['beyond'] > 0 for row in planned)}",
        f"{np.median([row['kept'] for row in planned]):.3f} m", f"{worst:.2f}",
    ]  # fmt: skip
    pairs = [(before.get(key_of(row), {}), row) for row in planned]
    pairs = [(old, new) for old, new in pairs if "kept" in old]
    for name in ("took", "length", "kept") if pairs else ():
        ratios = np.array([new[name] / old[name] for old, new in pairs])
        cells.append(f"{100 * (ratios.mean() - 1):+.1f} %, {100 * (ratios.max() - 1):+.0f} %")
    return "| " + " | ".join(cells) + " |"


def key_of(row: dict[str, Any]) -> tuple:
    return row["kind"], row["place"], row["seed"]


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--missions", type=int, default=40, help="of each kind and place")
    parser.add_argument("--drives", type=int, default=300)
    parser.add_argument("--seed", type=int, default=0, help="of the first mission")
    parser.add_argument("--kind", choices=KINDS)
    parser.add_argument("--record", type=Path)
    parser.add_argument("--beside", type=Path)
    given = parser.parse_args()
    rows = []
    for kind in KINDS if given.kind is None else (given.kind,):
        for place in PLACES:
            for seed in range(given.seed, given.seed + given.missions):
                rows.append(driven(kind, place, seed, given.drives))
                if given.record is not None:
                    given.record.write_text(json.dumps(rows))
    before = [] if given.beside is None else json.loads(given.beside.read_text())
    told(rows, {key_of(row): row for row in before})


if __name__ == "__main__":
    main()
