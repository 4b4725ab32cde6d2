"""Whether robots with turning circles are refused beside walls though there is a way.

    python benchmarks/tight_turns.py tight 0 60

Random missions (``tight``: boxes and discs, ``lanes``: thin walls, ``rooms``: rooms with doors,
all at odd angles) for a disc with a turning circle whose start, via points and goal mostly lie
beside walls, with and without given headings. Where ``vs.plan`` refuses or gives up, an oracle that
shares no code with it looks for a way: leg by leg, by arcs and lines of a circle 2 % wider, clear
by a table of shapely's distances with 7 mm more room. What it finds is a way, but for ramps between
lines and arcs; where it finds none it proves nothing.
"""

from __future__ import annotations

import argparse
import math
import time
from typing import NamedTuple

import numba
import numpy as np
import shapely
from plan_outcome import plan_outcome

import viaspline as vs

KINDS = ("tight", "rooms", "lanes")
SPARE_M = 7e-3  # more room than is asked for
WIDER = 1.02  # the oracle's turning circle, in the robot's
STEP, CELL, SECTORS = 0.12, 0.06, 120  # a piece and a cell, in turning circles; headings
TABLE_M = 0.03  # side of a cell of the table of distances
STATES, STATES_ON_THE_WAY = 3_000_000, 300_000
FREE = np.arange(72) * math.tau / 72  # headings that are tried where any is allowed


class Case(NamedTuple):
    """A mission, and what the oracle has to know of it; headings are None where they are free."""

    mission: vs.Mission
    solids: shapely.Geometry
    size: float
    places: list[tuple[float, float]]
    start: float | None
    goal: float | None
    radius: float
    kept: float


def case_of(seed: int, kind: str) -> Case | None:
    """A random mission; None where there is no place for its points."""
    random = np.random.default_rng((77, seed, KINDS.index(kind)))
    size, body = float(random.choice([12.0, 18.0, 24.0])), float(random.choice([0.3, 0.5]))
    clearance = float(random.choice([0.0, 0.1, 0.3]))
    radius = float(random.choice([1.0, 1.6, 2.5, 4.0]))
    kept = body + clearance
    rings, discs = {"tight": _tight, "rooms": _rooms, "lanes": _lanes}[kind](random, size)
    round_ = [shapely.Point(x, y).buffer(r, quad_segs=128) for x, y, r in discs]
    solids = shapely.union_all([*map(shapely.Polygon, rings), *round_])
    free = shapely.box(0, 0, size, size).buffer(-kept - 5e-3, join_style="mitre")
    free = free.difference(solids.buffer(kept + 5e-3, quad_segs=64))

    def place(is_near: bool) -> tuple[float, float] | None:
        for _ in range(4000):
            x, y = random.uniform(kept, size - kept, 2).tolist()
            point = shapely.Point(x, y)
            if free.contains(point):
                gap = free.boundary.distance(point)
                if gap > 0.02 and (not is_near or gap < 0.35 * radius):
                    return x, y
        return None

    count = int(random.choice([2, 2, 2, 3, 4]))
    places = [place(random.random() < 0.7) for _ in range(count)]
    if any(each is None for each in places):
        return None
    start = float(random.uniform(-180, 180)) if random.random() < 0.7 else None
    goal = float(random.uniform(-180, 180)) if random.random() < 0.3 else None
    route = {"via": [list(each) for each in places[1:-1]]} if count > 2 else {}
    for key, at, heading in (("start", places[0], start), ("goal", places[-1], goal)):
        route[key] = {"at": at} | ({} if heading is None else {"heading_deg": heading})
    circles = [{"circle": {"center": [x, y], "radius": r}} for x, y, r in discs]
    known = [*({"polygon": ring} for ring in rings), *circles]
    mission = vs.Mission.model_validate({
        "world": {"bounds": [0, 0, size, size], "known": known},
        "robot": {"radius_m": body, "clearance_m": clearance, "min_turn_radius_m": radius,
                  "turn_on_spot": "never"},
        "route": route,
    })  # fmt: skip
    return Case(mission, solids, size, places, start, goal, radius, kept)


def _box(x: float, y: float, a: float, b: float, angle: float) -> list[list[float]]:
    c, s = math.cos(angle), math.sin(angle)
    corners = np.array([(-a, -b), (a, -b), (a, b), (-a, b)]) / 2
    return (corners @ np.array([(c, s), (-s, c)]) + (x, y)).tolist()


def _some(random, size, count, a, b):
    return [
        _box(*random.uniform(0, size, 2), random.uniform(*a), random.uniform(*b),
             random.uniform(0, math.tau)) for _ in range(count)
    ]  # fmt: skip


def _tight(random, size):
    rings = _some(random, size, random.integers(2, 8), (0.3, 4), (0.3, 4))
    discs = [
        (*random.uniform(0, size, 2), random.uniform(0.2, 2)) for _ in range(random.integers(4))
    ]
    return rings, discs


def _lanes(random, size):
    rings = _some(random, size, random.integers(2, 6), (4, 12), (0.2, 0.2))
    return rings + _some(random, size, random.integers(4), (0.2, 3), (0.2, 3)), []


def _rooms(random, size):
    angle, width, door, rings = random.uniform(0, math.tau), size / 3, random.uniform(1.6, 3), []
    c, s = math.cos(angle), math.sin(angle)
    for wall, room, is_across in np.ndindex(2, 3, 2):
        if random.random() < 0.15:
            continue
        at = room * width + random.uniform(0.3 + door / 2, width - 0.3 - door / 2)
        for low, high in ((room * width, at - door / 2), (at + door / 2, (room + 1) * width)):
            x, y = (wall + 1) * width - size / 2, (low + high) / 2 - size / 2
            x, y = (y, x) if is_across else (x, y)
            turned = angle + (0.0 if is_across else math.pi / 2)
            middle = (size / 2 + c * x - s * y, size / 2 + s * x + c * y)
            rings += [_box(*middle, high - low, 0.2, turned)] if high - low > 0.05 else []
    return rings, []


@numba.njit
def _room(table, x, y):
    i, j = x / TABLE_M, y / TABLE_M
    a, b = int(i), int(j)
    if a < 0 or b < 0 or a + 1 >= table.shape[0] or b + 1 >= table.shape[1]:
        return -1.0
    u, v = i - a, j - b
    low = (1 - u) * table[a, b] + u * table[a + 1, b]
    return (1 - v) * low + v * ((1 - u) * table[a, b + 1] + u * table[a + 1, b + 1])


@numba.njit
def _moved(x, y, heading, bend, length):
    if bend == 0.0:
        return x + length * math.cos(heading), y + length * math.sin(heading), heading
    to = heading + bend * length
    return (x + (math.sin(to) - math.sin(heading)) / bend,
            y - (math.cos(to) - math.cos(heading)) / bend, to)  # fmt: skip


@numba.njit
def _is_clear(table, x, y, heading, bend, length):
    s = 0.0
    while True:
        at_x, at_y, _ = _moved(x, y, heading, bend, s)
        gap = _room(table, at_x, at_y) - SPARE_M
        if gap < 0.0:
            return False
        if s >= length:
            return True
        s = min(length, s + max(gap, 0.004))


@numba.njit
def _comes_straight(table, x, y, heading, goal, rho, side):
    """The heading at a goal that an arc and a line lead to; NaN where they don't."""
    c_x, c_y = x - side * rho * math.sin(heading), y + side * rho * math.cos(heading)
    far = math.hypot(goal[0] - c_x, goal[1] - c_y)
    if far <= rho:
        return math.nan
    to = math.atan2(goal[1] - c_y, goal[0] - c_x) - side * math.acos(rho / far) + side * math.pi / 2
    turn = (side * (to - heading)) % (2 * math.pi) * rho
    if not _is_clear(table, x, y, heading, side / rho, turn):
        return math.nan
    x, y, _ = _moved(x, y, heading, side / rho, turn)
    rest = math.hypot(goal[0] - x, goal[1] - y)
    return to if _is_clear(table, x, y, to, 0.0, rest) else math.nan


@numba.njit
def _comes_with(table, x, y, heading, goal, rho, one, other):
    """Whether an arc, a line and an arc lead to a goal with its heading."""
    c_x, c_y = x - one * rho * math.sin(heading), y + one * rho * math.cos(heading)
    d_x, d_y = goal[0] - other * rho * math.sin(goal[2]), goal[1] + other * rho * math.cos(goal[2])
    far, to = math.hypot(d_x - c_x, d_y - c_y), math.atan2(d_y - c_y, d_x - c_x)
    line = far
    if one != other:
        if far < 2 * rho:
            return False
        to += one * math.asin(2 * rho / far)
        line = math.sqrt(far * far - 4 * rho * rho)
    turn = (one * (to - heading)) % (2 * math.pi) * rho
    if not _is_clear(table, x, y, heading, one / rho, turn):
        return False
    x, y, _ = _moved(x, y, heading, one / rho, turn)
    if not _is_clear(table, x, y, to, 0.0, line):
        return False
    x, y, _ = _moved(x, y, to, 0.0, line)
    return _is_clear(table, x, y, to, other / rho, (other * (goal[2] - to)) % (2 * math.pi) * rho)


@numba.njit
def _arrivals(table, starts, goal, rho, most, is_last):
    """Headings with which a goal (x, y, heading or NaN) is come to from some poses (n, 3)."""
    cell, step = CELL * rho, STEP * rho
    columns = int(table.shape[0] * TABLE_M / cell) + 2
    seen = np.zeros(columns * columns * SECTORS, np.uint8)
    poses, size, has, found = np.empty((most, 3)), len(starts), np.zeros(360, np.uint8), [goal[2]]
    poses[:size] = starts
    at = 0
    while at < size:
        x, y, heading = poses[at]
        at += 1
        for one in (1.0, -1.0):
            if math.isnan(goal[2]):
                to = _comes_straight(table, x, y, heading, goal, rho, one)
                if math.isnan(to):
                    continue
                sector = int((to % (2 * math.pi)) / (2 * math.pi) * 360) % 360
                if has[sector] == 0:
                    has[sector] = 1
                    found.append(to)
            elif _comes_with(table, x, y, heading, goal, rho, one, one) or _comes_with(
                table, x, y, heading, goal, rho, one, -one
            ):
                found.append(goal[2])
        if is_last and len(found) > 1:
            break
        for bend in (0.0, 1 / rho, -1 / rho):
            if not _is_clear(table, x, y, heading, bend, step):
                continue
            to_x, to_y, to = _moved(x, y, heading, bend, step)
            sector = int((to % (2 * math.pi)) / (2 * math.pi) * SECTORS) % SECTORS
            key = (int(to_x / cell) * columns + int(to_y / cell)) * SECTORS + sector
            if seen[key] == 0 and size < most:
                seen[key] = 1
                poses[size] = to_x, to_y, to
                size += 1
    return found[1:]


def way_found(case: Case) -> bool:
    """Whether the oracle has a way through all places."""
    along = np.arange(int(case.size / TABLE_M) + 2) * TABLE_M
    x, y = np.meshgrid(along, along, indexing="ij")
    shapely.prepare(case.solids)
    gaps = shapely.distance(case.solids, shapely.points(x, y))
    gaps[shapely.contains_xy(case.solids, x, y)] = -0.05
    edges = np.minimum.reduce([gaps, x, y, case.size - x, case.size - y])
    table = np.ascontiguousarray(np.nan_to_num(edges, nan=case.size) - case.kept)
    headings = FREE if case.start is None else [math.radians(case.start)]
    for leg, place in enumerate(case.places[1:]):
        is_last = leg == len(case.places) - 2
        to = math.radians(case.goal) if is_last and case.goal is not None else math.nan
        starts = np.array([(*case.places[leg], heading) for heading in headings])
        most = STATES if is_last else STATES_ON_THE_WAY
        rho = WIDER * case.radius
        headings = _arrivals(table, starts, np.array([*place, to]), rho, most, is_last)
        if not headings:
            return False
    return True


def main() -> None:
    """Print every refusal that the oracle has a way for, and how many there were of what."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("first", type=int)
    parser.add_argument("after", type=int)
    asked = parser.parse_args()
    counts: dict[str, int] = {}
    spent = []
    for seed in range(asked.first, asked.after):
        case = case_of(seed, asked.kind)
        if case is None:
            continue
        began = time.process_time()
        result = plan_outcome(case.mission)
        spent.append(time.process_time() - began)
        if result != "planned" and way_found(case):
            result = f"{result}, though there is a way"
            print(f"seed {seed}: {result}", flush=True)
        counts[result] = counts.get(result, 0) + 1
    for result, number in sorted(counts.items()):
        print(f"{result}: {number}")
    print(f"processor time: {sum(spent):.0f} s in all, median {np.median(spent):.2f}, "
          f"most {max(spent):.1f} s")  # fmt: skip


if __name__ == "__main__":
    main()
