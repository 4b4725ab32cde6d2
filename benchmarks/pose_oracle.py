"""Whether a refusal of a robot with a turning circle is right, told by a lattice of poses.

    python benchmarks/pose_oracle.py 0 200

Random small worlds, some of narrow lanes at odd angles, for a disc with a turning circle that
drives from a pose or a place to a place. Where ``vs.plan`` refuses (``NoPathError``), an oracle
that shares no code with it looks for a way: a search over places, headings and three curvatures,
whose every piece is a ramp, an arc or a line of a curvature that changes no faster than the
planner's widest ramp allows, clear by shapely with more room than is asked for. What it finds is a
way, so a refusal beside it is wrong. It proves nothing where it finds none.
"""

from __future__ import annotations

import argparse
import math
import time
from heapq import heappop, heappush
from typing import NamedTuple

import numpy as np
import shapely
from plan_outcome import plan_outcome

import viaspline as vs

SPARE_M = 5e-3  # more room than is asked for
WIDER = 1.02  # the oracle's turning circle, in the robot's
STEP = 0.25  # length of a piece, in turning circles
SECTORS, CELL = 96, 0.12  # headings; side of a cell, in turning circles
MAX_STATES = 60_000
MAX_GAP_RAD = 0.02  # off the goal's direction when it is aimed at


class Case(NamedTuple):
    """A mission, and what the oracle has to know of it."""

    mission: vs.Mission
    free: shapely.Geometry
    start: tuple[float, float]
    headings: tuple[float, ...]
    goal: tuple[float, float]
    radius: float


def case_of(seed: int) -> Case:
    """A random world for a disc of 0.5 m, closed by bounds."""
    random = np.random.default_rng((9, seed))
    size, radius = 24.0, float(random.choice([2.0, 3.0, 5.0]))
    rings = [_lane(random, size) for _ in range(random.integers(0, 4))]
    rings += [_box(random, size) for _ in range(random.integers(0, 6))]
    solids = shapely.union_all([shapely.Polygon(ring) for ring in rings])
    free = (
        shapely.box(0, 0, size, size)
        .buffer(-0.5, join_style="mitre")
        .difference(solids.buffer(0.5 + SPARE_M, quad_segs=32))
    )
    places: list[tuple[float, float]] = []
    while len(places) < 2:
        x, y = random.uniform(0.6, size - 0.6, 2).tolist()
        if free.buffer(-0.02).contains(shapely.Point(x, y)):
            places.append((x, y))
    start: dict[str, object] = {"at": places[0]}
    headings = tuple(np.arange(SECTORS) * math.tau / SECTORS)
    if random.random() < 0.5:
        degrees = float(random.uniform(-180, 180))
        start["heading_deg"], headings = degrees, (math.radians(degrees),)
    mission = vs.Mission.model_validate({
        "world": {"bounds": [0, 0, size, size], "known": [{"polygon": ring} for ring in rings]},
        "robot": {"radius_m": 0.5, "clearance_m": 0.0, "min_turn_radius_m": radius},
        "route": {"start": start, "goal": places[1]},
    })  # fmt: skip
    return Case(mission, free, places[0], headings, places[1], radius)


def _box(random: np.random.Generator, size: float) -> list[list[float]]:
    return _turned(random, size, *random.uniform(0.2, 3.0, 2))


def _lane(random: np.random.Generator, size: float) -> list[list[float]]:
    """A thin wall: two of them side by side make a lane."""
    return _turned(random, size, float(random.uniform(4.0, 12.0)), 0.2)


def _turned(random: np.random.Generator, size: float, a: float, b: float) -> list[list[float]]:
    angle = float(random.uniform(0.0, math.tau))
    c, s = math.cos(angle), math.sin(angle)
    x, y = random.uniform(0.0, size, 2)
    corners = np.array([(-a, -b), (a, -b), (a, b), (-a, b)]) / 2.0
    return (corners @ np.array([(c, s), (-s, c)]) + (x, y)).tolist()


def places_along(x: float, y: float, heading: float, ends: tuple[float, float], length: float):
    """Places and headings along a piece whose curvature changes evenly: (n, 2), (n,)."""
    s = np.linspace(0.0, length, 13)
    turned = heading + ends[0] * s + 0.5 * (ends[1] - ends[0]) * s * s / length
    middle = 0.5 * (s[1:] + s[:-1])
    mean = heading + ends[0] * middle + 0.5 * (ends[1] - ends[0]) * middle**2 / length
    ahead = np.diff(s)[:, None] * np.column_stack((np.cos(mean), np.sin(mean)))
    return np.cumsum(np.vstack(((x, y), ahead)), axis=0), turned


def way_found(case: Case) -> bool:
    """Whether the oracle has a way to the goal."""
    rho = WIDER * case.radius
    shapely.prepare(case.free)
    step, cell = STEP * rho, CELL * rho
    levels = (-1.0 / rho, 0.0, 1.0 / rho)
    heap, seen, count = [], set(), 0
    for heading in case.headings:
        heappush(heap, (math.dist(case.start, case.goal), count, 0.0, (*case.start, heading, 1)))
        count += 1
    while heap and len(seen) < MAX_STATES:
        _, _, cost, (x, y, heading, level) = heappop(heap)
        sector = int(heading % math.tau / math.tau * SECTORS)
        key = (int(x / cell), int(y / cell), sector, level)
        if key in seen:
            continue
        seen.add(key)
        if level == 1 and _reaches(case, x, y, heading):
            return True
        for to in {max(level - 1, 0), level, min(level + 1, 2)}:
            # from one bend to the other through no bend at all: over two pieces
            length = step if to == level else 2.0 * rho
            line, turned = places_along(x, y, heading, (levels[level], levels[to]), length)
            if case.free.covers(shapely.LineString(line)):
                end, more = line[-1].tolist(), cost + length
                rest = math.dist(end, case.goal)
                heappush(heap, (more + rest, count, more, (*end, float(turned[-1]), to)))
                count += 1
    return False


def _reaches(case: Case, x: float, y: float, heading: float) -> bool:
    """Whether the goal lies ahead, but for so little that a hair of a turn makes up for it."""
    dx, dy = case.goal[0] - x, case.goal[1] - y
    gap = math.remainder(math.atan2(dy, dx) - heading, math.tau)
    far = math.hypot(dx, dy)
    if abs(gap) > min(MAX_GAP_RAD, 0.1 * far / case.radius):
        return False
    return bool(case.free.covers(shapely.LineString([(x, y), case.goal])))


def main() -> None:
    """Print every refusal that the oracle has a way for, and how many there were of what."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("first", type=int)
    parser.add_argument("after", type=int)
    span = parser.parse_args()
    counts: dict[str, int] = {}
    for seed in range(span.first, span.after):
        case = case_of(seed)
        result, began = plan_outcome(case.mission), time.process_time()
        if result != "planned" and way_found(case):
            result = f"{result}, though there is a way"
            print(f"seed {seed}: {result} ({time.process_time() - began:.1f} s)", flush=True)
        counts[result] = counts.get(result, 0) + 1
    for result, number in sorted(counts.items()):
        print(f"{result}: {number}")


if __name__ == "__main__":
    main()
