"""Random missions with a turning circle: is the curvature bound kept, and what is refused, why.

    python benchmarks/turning.py [MISSIONS] [FIRST]

Squares of 20, 60 or 200 m with up to seven discs, two to seven via points, turning circles of 1,
3 or 6 m, open and closed routes, half of them with a heading at the start. Every path is sampled
each centimetre: curvature and distance to the discs, by formulas of their own. Missions whose via
points have no room, or between which there is no way even for a point, don't count.
"""

from __future__ import annotations

import math
import sys
import time
from collections import Counter
from typing import Any

import numpy as np

import viaspline as vs

RADIUS, CLEARANCE = 0.5, 0.5
SIZES, CIRCLES = (20.0, 60.0, 200.0), (1.0, 3.0, 6.0)


def mission(seed: int) -> tuple[vs.Mission, float]:
    """A random mission and its turning circle [m]."""
    rng = np.random.default_rng(seed)
    size, circle = float(rng.choice(SIZES)), float(rng.choice(CIRCLES))
    discs = [
        {"circle": {"center": rng.uniform(0, size, 2).tolist(), "radius": size * r}}
        for r in rng.uniform(0.02, 0.08, int(rng.integers(0, 8)))
    ]
    places: list[list[float]] = []
    while len(places) < 2 or (rng.random() < 0.7 and len(places) < 7):
        place = rng.uniform(0, size, 2)
        if all(gap(place, disc) > RADIUS + CLEARANCE + 0.05 for disc in discs):
            places.append(place.tolist())
    closed = bool(rng.integers(2)) and len(places) > 2
    start: dict[str, Any] = {"at": places[0]}
    route: dict[str, Any] = {"start": start, "via": places[1:], "closed": True}
    if not closed:
        route = {"start": start, "via": places[1:-1], "goal": places[-1]}
        if rng.random() < 0.5:
            start["heading_deg"] = float(rng.uniform(-180, 180))
    robot = {"radius_m": RADIUS, "clearance_m": CLEARANCE, "min_turn_radius_m": circle}
    data = {"world": {"known": discs}, "robot": robot, "route": route}
    return vs.Mission.model_validate(data), circle


def gap(place: np.ndarray, disc: Any) -> float:
    circle = disc["circle"]
    return float(np.hypot(*(place - circle["center"]))) - circle["radius"]


def sampled(path: vs.Path) -> tuple[np.ndarray, np.ndarray]:
    """Points and curvatures every centimetre or less, from the control polygons alone."""
    spans = path.spans
    longest = np.linalg.norm(np.diff(spans, axis=1), axis=2).sum(axis=1).max()
    w = np.linspace(0, 1, int(100 * longest) + 2)[:, None, None]
    a, b, c, d = np.moveaxis(spans, 1, 0)
    first = 3 * ((1 - w) ** 2 * (b - a) + 2 * w * (1 - w) * (c - b) + w**2 * (d - c))
    second = 6 * ((1 - w) * (c - 2 * b + a) + w * (d - 2 * c + b))
    place = (1 - w) ** 3 * a + 3 * w * (1 - w) ** 2 * b + 3 * w**2 * (1 - w) * c + w**3 * d
    cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    return place.reshape(-1, 2), (np.abs(cross) / np.linalg.norm(first, axis=2) ** 3).ravel()


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    told: Counter[str] = Counter()
    times, worst, jumps = [], 0.0, 0.0
    for seed in range(first, first + count):
        asked, circle = mission(seed)
        begin = time.perf_counter()
        try:
            plan = vs.plan(asked)
        except vs.PlanningError as error:
            is_circle = "turning circle" in error.reason
            told[error.reason.rsplit(": ", 1)[-1] if is_circle else "no way for a point"] += 1
            if is_circle:
                print(f"{seed}: {error}", flush=True)
            continue
        times.append(time.perf_counter() - begin)
        points, curvature = sampled(plan.path)
        worst = max(worst, float(curvature.max()) * circle)
        jumps = max(jumps, float(max(plan.path.curvature_jumps(), default=0.0)))
        kept = min(
            (
                np.hypot(*(points - o.circle.center).T).min() - o.circle.radius
                for o in asked.world.known
            ),
            default=math.inf,
        )
        exact = max(
            float(np.abs(np.asarray(plan.path.evaluate(v.u)) - v.at).max()) for v in plan.path.vias
        )
        fine = plan.certificate.holds and kept >= RADIUS + CLEARANCE - 1e-6 and exact < 1e-9
        told["served" if fine else "WRONG"] += 1
        if curvature.max() * circle > 1.0 or not fine:
            print(f"{seed}: curvature {curvature.max() * circle:.5f}, kept {kept:.4f}", flush=True)
    for reason, number in told.most_common():
        print(f"{number:6d}  {reason}")
    print(f"largest curvature times radius {worst:.6f}, largest jump of curvature {jumps:.1e} 1/m")
    quantiles = np.quantile(times, (0.5, 0.95, 0.99, 1.0)) * 1e3
    print("a plan: median {:.1f}, 95 % {:.0f}, 99 % {:.0f}, longest {:.0f} ms".format(*quantiles))


if __name__ == "__main__":
    main()
