"""Strange flights beside images of themselves, which have to be planned alike.

    python benchmarks/strange_flight_images.py [MISSIONS] [FIRST] [--kind ...] [--image ...]

Of each mission (``strange_flights.py``, without what isn't on the map) several images are planned:
turned by an odd angle and shifted far, mirrored, raised with its ground, the other way round; and
written in other words: obstacles in another order, one more far outside, boxes as polygons,
capsules as two that overlap. All that could be told apart is the planner's own: where the outcome
is another kind, what counts (time, or length) differs by more than 0.5 %, or one drives well and
the other doesn't, that is told with the seed.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
import warnings
from collections import Counter
from pathlib import Path
from typing import Final

import numpy as np
from image_of_flight import Data, images
from strange_flights import FLIGHT_KINDS, StrangeFlights
from strange_hard_flights import HardFlights

HARD: Final = 1_000_000
ALIKE: Final = 0.005
KINDS: Final = tuple(kind for kind in FLIGHT_KINDS if kind not in ("unseen", "hidden"))


def base_of(seed: int, kinds: tuple[str, ...], folder: Path) -> Data:
    """The mission of a seed, of which images can be made."""
    kind = kinds[seed % len(kinds)]
    rng = np.random.default_rng((seed, 100 + FLIGHT_KINDS.index(kind)))
    draws = HardFlights if seed >= HARD else StrangeFlights
    data = draws(rng, kind, folder).draw()
    bounds = data["world"].pop("bounds", None)
    if bounds is not None and "fences" not in data["world"]:  # bounds can't be turned
        a, b, c, d = bounds
        data["world"]["fences"] = [[[a, b], [c, b], [c, d], [a, d]]]
    robot = data["robot"]
    for key in ("max_descent_mps", "max_brake_mps2"):
        robot.pop(key, None)
    if "max_climb_mps" in robot:
        robot["max_descent_mps"] = robot["max_climb_mps"]
    return data


def outcome(data: Data, folder: Path, name: str) -> tuple[str, float, str, str, float]:
    """How a mission ends: in which class, what counts of it, its verdict, words, processor time."""
    import viaspline as vs

    path = folder / f"{name.replace(' ', '_')}.yaml"
    path.write_text(json.dumps(data), encoding="utf-8")
    begun = time.process_time()
    try:
        plan = vs.plan(vs.load(path))
    except vs.ViasplineError as error:
        return type(error).__name__, 0.0, "", str(error), time.process_time() - begun
    spent = time.process_time() - begun
    cost = plan.path.length if data["route"]["optimise"] == "length" else plan.trajectory.duration
    found = plan.drivability
    return "planned", float(cost), found.verdict, "; ".join(map(str, found.reasons)), spent


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("missions", type=int, nargs="?", default=50)
    parser.add_argument("first", type=int, nargs="?", default=0)
    parser.add_argument("--kind", choices=KINDS, nargs="*", default=KINDS)
    parser.add_argument("--image", nargs="*")
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    ratios: dict[str, list[float]] = {}
    told: Counter[str] = Counter()
    for seed in range(asked.first, asked.first + asked.missions):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            data = base_of(seed, tuple(asked.kind), folder)
            first = outcome(data, folder, "base")
            print(
                f"{seed} {first[0]} {first[1]:.2f} {first[2]} {first[4]:.2f} s",
                file=sys.stderr,
                flush=True,
            )
            for word, image in images(data, folder, seed):
                if asked.image and word not in asked.image:
                    continue
                other = outcome(image, folder, word)
                if other[0] != first[0]:
                    told[f"{word}: outcome"] += 1
                    print(
                        f"{seed} {word}: {first[0]} but {other[0]}: {first[3] or other[3]}",
                        flush=True,
                    )
                elif first[0] == "planned":
                    ratio = other[1] / first[1]
                    ratios.setdefault(word, []).append(ratio)
                    if abs(ratio - 1.0) > ALIKE:
                        told[f"{word}: cost"] += 1
                        print(
                            f"{seed} {word}: {first[1]:.3f} but {other[1]:.3f} ({ratio:.4f})",
                            flush=True,
                        )
                    if other[2] != first[2]:
                        told[f"{word}: verdict"] += 1
                        print(
                            f"{seed} {word}: {first[2]} but {other[2]}: {first[3]} | {other[3]}",
                            flush=True,
                        )
    for word, its in ratios.items():
        print(f"{word}: {len(its)}, mean {np.mean(its):.5f}, {min(its):.4f} to {max(its):.4f}, "
              f"{sum(abs(r - 1) > ALIKE for r in its)} differ")  # fmt: skip
    print(dict(told) or "no differences")


if __name__ == "__main__":
    main()
