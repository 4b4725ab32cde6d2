"""How paths of strange flights are shaped: what is sharper than the body, how often they swing.

    python benchmarks/flight_shapes.py [MISSIONS] [FIRST] [--kind ...] [--to FILE] [--beside FILE]

Plans the missions of ``strange_flights.py``, one process for all. ``--to`` keeps a row for each
mission, and ``--beside`` compares with rows that were kept: of missions that have a plan in both.
"""

from __future__ import annotations

import argparse
import json
import math
import tempfile
import time
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from kept_rows import keep, kept
from strange_flight_curve import Sampled
from strange_flight_runs import drawn
from strange_flights import FLIGHT_KINDS

BENT_1PM = 0.02
ROUND = 0.999


def row_of(seed: int, kinds: tuple[str, ...]) -> dict[str, Any]:
    """What there is to tell of a mission's plan."""
    import viaspline as vs

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        kind, asked = drawn(seed, kinds, folder)
        (folder / "strange.yaml").write_text(json.dumps(asked.data), encoding="utf-8")
        begin = time.process_time()
        try:
            plan = vs.plan(vs.load(folder / "strange.yaml"))
        except vs.ViasplineError as error:
            spent = time.process_time() - begin
            return {"seed": seed, "kind": kind, "error": type(error).__name__, "cpu_s": spent}
        spent = time.process_time() - begin
    drives = plan.drivability
    sharp = drives.sharpest
    return {
        "seed": seed, "kind": kind, "cpu_s": spent,
        "duration_s": plan.trajectory.duration, "length_m": plan.path.length,
        "radius_m": min(drives.sharpest_radius, 1e9), "least_m": drives.least_radius,
        "at": None if sharp is None else [round(x, 2) for x in sharp.at],
        "near": "" if sharp is None else sharp.near,
        "swings": swings(np.asarray(plan.path.spans)), "jumps": drives.curvature_jumps,
        "detours": sum(via.kind == "detour" for via in plan.path.vias),
        "verdict": drives.verdict, "why": [one.text for one in drives.reasons],
    }  # fmt: skip


def swings(spans: np.ndarray) -> int:
    """How often a path bends one way, and then against it."""
    bends = Sampled.of_spans(spans).bends
    bends = bends[np.isfinite(bends).all(axis=1)]
    bends = bends[np.linalg.norm(bends, axis=1) > BENT_1PM]
    count, last = 0, None
    for bend in bends:
        if last is not None and bend @ last < 0.0:
            count += 1
        last = bend
    return count


def told(rows: list[dict[str, Any]]) -> Iterator[str]:
    """What rows come to."""
    planned = [row for row in rows if "error" not in row]
    sharp = [row for row in planned if row["radius_m"] < ROUND * row["least_m"]]
    rough = [row for row in planned if row["verdict"] != "good"]
    spent = sorted(row["cpu_s"] for row in rows)
    yield f"planned {len(planned)} of {len(rows)}; rough {len(rough)}"
    yield f"sharper than the body {len(sharp)}"
    for word in ("swings", "detours", "duration_s", "length_m"):
        yield f"{word} {sum(row[word] for row in planned):.6g}"
    yield f"processor, median {spent[len(spent) // 2]:.2f} s, worst {spent[-1]:.1f} s"
    yield f"all {sum(spent):.0f} s"


def compared(rows: list[dict[str, Any]], before: list[dict[str, Any]]) -> Iterator[str]:
    """Missions that have plans now and had them before, side by side."""
    old = {row["seed"]: row for row in before}
    both = [row for row in rows if row["seed"] in old]
    for row in both:
        if ("error" in row) != ("error" in old[row["seed"]]):
            was, now = (one.get("error", "a plan") for one in (old[row["seed"]], row))
            yield f"{row['seed']}: {was} -> {now}"
    both = [row for row in both if "error" not in row and "error" not in old[row["seed"]]]
    yield "before: " + "; ".join(told([old[row["seed"]] for row in both]))
    yield "now:    " + "; ".join(told(both))
    ratios = [row["duration_s"] / old[row["seed"]]["duration_s"] for row in both]
    yield (f"time now over before: mean {np.mean(ratios):.5f}, "
           f"least {min(ratios):.4f}, most {max(ratios):.4f}")  # fmt: skip
    for row in both:
        was = old[row["seed"]]
        share = row["duration_s"] / was["duration_s"]
        radii = was["radius_m"] / was["least_m"], row["radius_m"] / row["least_m"]
        if abs(math.log(share)) > 0.003 or (min(radii) < 1.0 and radii[0] != radii[1]):
            yield (f"{row['seed']} {row['kind']}: {was['duration_s']:.2f} -> "
                   f"{row['duration_s']:.2f} s, body's radii {radii[0]:.3f} -> {radii[1]:.3f},"
                   f" swings {was['swings']} -> {row['swings']}")  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("missions", type=int, nargs="?", default=100)
    parser.add_argument("first", type=int, nargs="?", default=0)
    parser.add_argument("--kind", choices=FLIGHT_KINDS, nargs="*", default=FLIGHT_KINDS)
    parser.add_argument("--to", type=Path)
    parser.add_argument("--beside", type=Path)
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    rows = []
    for seed in range(asked.first, asked.first + asked.missions):
        row = row_of(seed, tuple(asked.kind))
        rows.append(row)
        if row.get("verdict", "good") != "good" or row["cpu_s"] > 5.0:
            print(row, flush=True)
    keep(rows, asked.to)
    for line in told(rows):
        print(line)
    if asked.beside is not None:
        for line in compared(rows, kept(asked.beside)):
            print(line)


if __name__ == "__main__":
    main()
