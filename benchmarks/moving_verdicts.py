"""Drivability of plans past known movers, told without the planner: by samples of curve and law.

    python benchmarks/moving_verdicts.py [MISSIONS] [FIRST]

Missions are the ``moving`` ones of ``strange_missions.py`` with up to three things more that cross
the legs about when the robot is there: discs, boxes and capsules on lines, there and back, round
and round, turning or not. Every span is sampled four hundred times. What is told of the sharpest
bend, of the largest acceleration across the path, of jumps of the curvature and of near-cusps is
compared with what is sampled, and only ``tangents: cardinal`` may have a jump at all.
"""

from __future__ import annotations

import argparse
import math
import warnings
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from strange_missions import StrangeMissions

import viaspline as vs

SAMPLES = 401  # of a span, both ends among them
FELT_1PM = 0.02
TURN_M = 2e-3  # about a turn on the spot nothing is a bend
GAUSS_AT, GAUSS_WEIGHT = np.polynomial.legendre.leggauss(8)


def mission_of(seed: int) -> dict[str, Any]:
    """A mission as its file has it."""
    rng = np.random.default_rng((seed, 7171))
    mission = StrangeMissions(rng, "moving", Path()).draw()
    if mission["spline"].get("tension") == "auto":
        del mission["spline"]["tension"]
    route = mission["route"]
    ends = [route["goal"]] if "goal" in route else []
    points = np.array([one["at"] for one in (route["start"], *route["via"], *ends)])
    speed = mission["robot"]["max_speed_mps"]
    legs = np.hypot(*np.diff(points, axis=0).T)
    for number in range(int(rng.integers(0, 4))):
        k, share = int(rng.integers(0, len(legs))), rng.uniform(0.15, 0.85)
        at = points[k] + share * (points[k + 1] - points[k])
        when = (legs[:k].sum() + share * legs[k]) / speed + rng.uniform(-1.5, 1.5)
        mission["world"]["known"].append(crossing(rng, f"crossing {number}", at, when))
    return mission


def crossing(rng: np.random.Generator, name: str, at: np.ndarray, when: float) -> dict[str, Any]:
    """Something that is at a place at about a time [m], [s]."""
    angle = rng.uniform(0, math.tau)
    velocity = rng.uniform(0.2, 1.8) * np.array([math.cos(angle), math.sin(angle)])
    long, wide = np.round(rng.uniform(0.2, 1.2, 2), 3).tolist()
    box = [[-long, -wide], [long, -wide], [long, wide], [-long, wide]]
    shape = [
        {"circle": {"center": [0, 0], "radius": round(0.7 * long, 3)}},
        {"polygon": box},
        {"capsule": {"from": [-long, 0], "to": [0.5, 0.2], "radius": round(0.3 * wide, 3)}},
    ][int(rng.integers(3))]
    if rng.random() < 0.45:
        start = np.round(at - when * velocity, 3).tolist()
        return {"name": name, **shape, "motion": {"from": start, "velocity_mps": velocity.tolist()}}
    half = rng.uniform(1.5, 7.0)
    places = [at - half * velocity, at + rng.uniform(-2, 2, 2), at + half * velocity]
    after = str(rng.choice(["loop", "bounce", "vanish"]))
    places += places[:1] if after == "loop" else []
    times = [0.0, half, 2 * half, 4 * half][: len(places)]
    frames = [[t, *np.round(p, 3).tolist()] for t, p in zip(times, places, strict=True)]
    if rng.random() < 0.5:
        first, last = rng.uniform(-180, 180), rng.uniform(-120, 120)
        turned = [first, first + last, first + 0.5 * last, first][: len(frames)]
        frames = [[*frame, heading] for frame, heading in zip(frames, turned, strict=True)]
    return {"name": name, **shape, "motion": {"keyframes": frames, "after": after}}


class Sampled(NamedTuple):
    """A curve by samples, (spans, SAMPLES): distance [m], curvature [1/m], heading [rad]."""

    distance: np.ndarray
    curvature: np.ndarray
    heading: np.ndarray


def sampled(spans: np.ndarray) -> Sampled:
    """Of Bézier polygons, by their derivatives and Gauss's rule; closer at the ends of spans."""
    w = (1 - np.cos(np.linspace(0, math.pi, SAMPLES))) / 2
    first = 3 * np.diff(spans, axis=1)
    second = 2 * np.diff(first, axis=1)

    def derivative(u: np.ndarray) -> np.ndarray:
        v = 1 - u
        a, b, c = (first[:, k].reshape(-1, *[1] * u.ndim, 2) for k in range(3))
        u, v = u[..., None], v[..., None]
        found: np.ndarray = v * v * a + 2 * u * v * b + u * u * c
        return found

    d1 = derivative(w)
    d2 = second[:, None, 0] * (1 - w)[:, None] + second[:, None, 1] * w[:, None]
    with np.errstate(all="ignore"):
        across = d1[..., 0] * d2[..., 1] - d1[..., 1] * d2[..., 0]
        bend = across / np.hypot(d1[..., 0], d1[..., 1]) ** 3
    middle, half = 0.5 * (w[1:] + w[:-1]), 0.5 * np.diff(w)
    inside = derivative(middle[:, None] + half[:, None] * GAUSS_AT)
    parts = (np.hypot(inside[..., 0], inside[..., 1]) * GAUSS_WEIGHT).sum(axis=2) * half
    along = np.concatenate([np.zeros((len(spans), 1)), np.cumsum(parts, axis=1)], axis=1)
    along += np.concatenate([[0.0], np.cumsum(along[:-1, -1])])[:, None]
    return Sampled(along, bend, np.arctan2(d1[..., 1], d1[..., 0]))


def faults_of(mission: dict[str, Any], plan: vs.Plan) -> Iterator[tuple[str, str]]:
    """What is told otherwise than it is sampled: a word and a sentence each."""
    told, law = plan.drivability, plan.trajectory
    curve = sampled(np.array(plan.path.spans))
    spots = [turn.place.distance for turn in told.turns_on_spot]
    bends = np.isfinite(curve.curvature)
    for at in spots:
        bends &= np.abs(curve.distance - at) > TURN_M
    bend = np.where(bends, np.abs(curve.curvature), 0.0)
    sharpest = 1 / max(float(bend.max()), 1e-12)
    if sharpest < told.sharpest_radius * (1 - 1e-6) and sharpest < 1e9:
        yield "sharper", f"{sharpest:.6g} m sampled, {told.sharpest_radius:.6g} m told"
    speeds = np.asarray(law.speed_at(np.minimum(curve.distance, law.distances[-1])))
    across = float((speeds**2 * bend).max())
    if across > told.max_lateral_accel * (1 + 1e-3) + 1e-4:
        yield "across", f"{across:.6g} m/s² sampled, {told.max_lateral_accel:.6g} m/s² told"
    if across < 0.95 * told.max_lateral_accel - 1e-3:
        yield "less across", f"{across:.6g} m/s² sampled, {told.max_lateral_accel:.6g} m/s² told"
    turns = np.abs(np.angle(np.exp(1j * (curve.heading[1:, 0] - curve.heading[:-1, -1]))))
    jumps = np.abs(curve.curvature[1:, 0] - curve.curvature[:-1, -1])
    felt = (turns < 1e-6) & np.isfinite(jumps) & (speeds[1:, 0] > 1e-6) & (jumps > FELT_1PM)
    if felt.sum() != told.curvature_jumps:
        yield "jumps", f"{felt.sum()} sampled, {told.curvature_jumps} told"
    if felt.any() and mission["spline"].get("tangents") != "cardinal":
        yield "a jump", f"of {jumps[felt].max():.3g} 1/m"
    if told.least_radius > 0 and not told.near_cusps:
        yield from hidden_cusps(curve, bends & (bend * told.least_radius > 1.0))


def hidden_cusps(curve: Sampled, sharp: np.ndarray) -> Iterator[tuple[str, str]]:
    """Sharp stretches that turn by more than 121° one way, though no near-cusp is told of."""
    flat, sides = sharp.ravel(), np.sign(curve.curvature).ravel()
    steps = np.abs(np.angle(np.exp(1j * np.diff(curve.heading.ravel()))))
    turned = 0.0
    for k, step in enumerate(steps):
        turned = turned + step if flat[k] and flat[k + 1] and sides[k] == sides[k + 1] else 0.0
        if turned > math.radians(121):
            yield "near-cusp", f"at {curve.distance.ravel()[k]:.3f} m, none is told"
            return


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("missions", type=int, nargs="?", default=100)
    parser.add_argument("first", type=int, nargs="?", default=0)
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    ended: Counter[str] = Counter()
    faults: Counter[str] = Counter()
    for seed in range(asked.first, asked.first + asked.missions):
        mission = mission_of(seed)
        try:
            plan = vs.plan(vs.Mission.model_validate(mission))
        except vs.ViasplineError as error:
            ended[type(error).__name__] += 1
            continue
        ended[plan.drivability.verdict] += 1
        for word, sentence in faults_of(mission, plan):
            faults[word] += 1
            print(f"{seed}: {word}: {sentence}", flush=True)
    print(", ".join(f"{count} {word}" for word, count in ended.items()))
    print("faults: " + (", ".join(f"{n} x {word}" for word, n in faults.items()) or "none"))


if __name__ == "__main__":
    main()
