"""Whole runs of missions with odd values: only exit codes that a user may meet, never a defect.

    python benchmarks/odd_runs.py [MISSIONS] [FIRST] [--processes 2] [--limit 120]

Each mission is drawn from the JSON Schema (``odd_missions.py``) and run as ``viaspline run`` does.
Exit codes are 0 (done), 2 (the mission is wrong), 3 (no such path), 4 (not reached) and 5 (gave
up). Anything else, a traceback, and what takes longer than the limit is told with its seed.
"""

from __future__ import annotations

import argparse
import json
import math
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np
from odd_missions import OddMissions
from work_pool import done

FINE = (0, 2, 3, 4, 5)


def run(seed: int) -> tuple[int, str]:
    """The exit code of a mission, and the last that was said."""
    from click.testing import CliRunner

    from viaspline.cli import cli

    mission = OddMissions(np.random.default_rng(seed)).draw()
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "odd.yaml"
        file.write_text(json.dumps(mission), encoding="utf-8")
        result = CliRunner().invoke(
            cli, ["run", str(file), "--out", str(file.parent / "out"), "-q"]
        )
    said = result.output.strip().splitlines()
    return result.exit_code, said[-1] if said else ""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("missions", type=int, nargs="?", default=1000)
    parser.add_argument("first", type=int, nargs="?", default=0)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--limit", type=float, default=120.0, help="seconds for a mission")
    asked = parser.parse_args()
    seeds = range(asked.first, asked.first + asked.missions)
    told: Counter[str] = Counter()
    for seed, found in done(run, seeds, asked.processes, math.inf, asked.limit):
        code, said = (None, f"ended after {asked.limit:g} s, or died") if found is None else found
        told["too slow" if code is None else str(code)] += 1
        if code not in FINE:
            print(f"{seed}: exit code {code}: {said}", flush=True)
    print(", ".join(f"{count} x {code}" for code, count in sorted(told.items())))


if __name__ == "__main__":
    main()
