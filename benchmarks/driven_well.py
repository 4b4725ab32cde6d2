"""The path that a good driver would take: how far the planner's is from it, a table a question.

    python benchmarks/driven_well.py TABLE [--seed 0] [--worlds N]

All figures come from samples of the exact curve and from shapely, none from the plan's own report.
Put another checkout's ``src`` in ``PYTHONPATH`` to measure that.
"""

from __future__ import annotations

import argparse
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

from driven_plan import DrivenPlan
from path_shape import turning_sides
from worlds import length

import viaspline as vs

EXAMPLES = Path(__file__).resolve().parent.parent / "examples"


def turns(asked: argparse.Namespace) -> None:
    """Examples: how often the path turns the other way, and the taut route of its kind."""
    print(f"{'example':18s}  turns  taut  detours  length m  / taut")
    for name, driven in examples():
        taut = driven.taut
        print(
            f"{name:18s} {driven.shape.sign_changes():6d} {turning_sides(taut):5d} "
            f"{driven.detours:8d} {driven.shape.length:9.1f} "
            f"{driven.shape.length / length(taut):7.4f}",
            flush=True,
        )


def examples() -> Iterator[tuple[str, DrivenPlan]]:
    """All examples, planned."""
    for file in sorted((*EXAMPLES.glob("*.yaml"), *EXAMPLES.glob("*.plan"))):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", vs.MissionWarning)
            mission = vs.load(file)
        yield file.stem, DrivenPlan.of(mission)


TABLES: dict[str, Callable[[argparse.Namespace], None]] = {"turns": turns}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("table", choices=TABLES)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--worlds", type=int, default=40)
    asked = parser.parse_args()
    TABLES[asked.table](asked)


if __name__ == "__main__":
    main()
