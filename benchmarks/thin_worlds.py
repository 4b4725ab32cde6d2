"""Mazes, combs, spirals, traps, rings and clutter: thin walls at odd angles, a seed each.

Gaps are given by what a robot needs, some wider and some narrower by as little as a millimetre.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import count
from typing import Any

import numpy as np
from problems import Box, Problem, Solids, core_of, places_with_room, turned

THICKNESSES_M = (1e-3, 0.02, 0.02, 0.1)
LEAST_SPARE_M = 2e-3  # of the room at start and goal, beyond what is required
WALL_KINDS = ("capsule", "polygon")
NEAREST_DECADE, FARTHEST_DECADE = -3.0, -0.5  # of a gap's width beyond what is needed [log10 m]


@dataclass(frozen=True)
class Walls:
    """A world in its own frame, before it is turned.

    Attributes:
        lines: From and to of each wall [m], shape (n, 2, 2).
        required: Distance that the robot keeps [m].
        start: Where its start is sought [m].
        goal: Where its goal is sought [m].
        box: The world's edge [m]; it turns with the walls, as a frame of walls.
    """

    lines: np.ndarray
    required: float
    start: Box
    goal: Box
    box: Box


def thin_problem(seed: int, only: str | None = None) -> Problem:
    """The problem of a seed; of one kind only if asked for."""
    random = np.random.default_rng((2, seed))
    kind = only or list(KINDS)[seed % len(KINDS)]
    for _ in count():
        found = KINDS[kind](random, kind)
        if found is not None:
            return found.shared_out(random)
    raise AssertionError


def nearly(random: np.random.Generator, needed: float) -> float:
    """A width [m] that is more or less than is needed, by a millimetre or by a lot."""
    more = 10 ** random.uniform(NEAREST_DECADE, FARTHEST_DECADE)
    return max(needed + float(random.choice((-1, 1)) * more), 0.02 * needed)


def gaps(random: np.random.Generator, needed: float, count_of: int) -> np.ndarray:
    """Widths that are all more than is needed, but one that may be less [m], (count_of,)."""
    widths = needed + 10 ** random.uniform(NEAREST_DECADE, FARTHEST_DECADE, count_of)
    widths[random.integers(count_of)] = nearly(random, needed)
    return widths


def _of_walls(lay: Callable[[np.random.Generator, float], Walls]):
    """A kind of world that is made of straight walls, turned as a whole."""

    def laid(random: np.random.Generator, kind: str) -> Problem | None:
        thickness = float(random.choice(THICKNESSES_M))
        walls = lay(random, thickness)
        angle = float(random.choice((0.0, random.uniform(0, math.tau))))
        away = random.uniform(-50, 50, 2)
        made: str = random.choice(WALL_KINDS)
        lines = [turned(line, angle) + away for line in (*walls.lines, *_frame(walls.box))]
        obstacles = tuple(_wall(line, thickness, made) for line in lines)
        corners = np.array(lines).reshape(-1, 2)
        low, high = corners.min(axis=0) - 2.0, corners.max(axis=0) + 2.0
        bounds = (*low.tolist(), *high.tolist())
        ends = _ends(random, obstacles, bounds, walls, angle, away)
        if ends is None:
            return None
        note = f"walls of {thickness:g} m as {made}s, turned by {math.degrees(angle):.0f} deg"
        return _problem(kind, bounds, walls.required, ends, obstacles, note)

    return laid


def _ends(random, obstacles, bounds: Box, walls: Walls, angle: float, away: np.ndarray):
    """A start and a goal with room, each in its box; None where there is none."""
    back = [_turned_back(o, angle, away) for o in obstacles]
    cores, radii = zip(*map(core_of, back), strict=True)
    far = (-1e3, -1e3, 1e3, 1e3)  # bounds don't turn: the frame of walls is nearer
    solids = Solids(cores=np.array(cores, object), radii=np.array(radii), bounds=far)
    found = []
    for box in (walls.start, walls.goal):
        places = places_with_room(random, solids, box, walls.required + LEAST_SPARE_M, 1)
        if not places:
            return None
        found.append(tuple((turned(np.array(places), angle) + away)[0].tolist()))
    return found


def _turned_back(obstacle: dict[str, Any], angle: float, away: np.ndarray) -> dict[str, Any]:
    if "polygon" in obstacle:
        return {"polygon": turned(np.array(obstacle["polygon"]) - away, -angle).tolist()}
    line = obstacle["capsule"]
    a, b = turned(np.array([line["from"], line["to"]]) - away, -angle).tolist()
    return {"capsule": {"from": a, "to": b, "radius": line["radius"]}}


def _problem(kind, bounds, required: float, ends, obstacles, note: str) -> Problem:
    start, goal = ends
    return Problem(
        kind=kind, bounds=bounds, radius=required, start=start, goal=goal,
        obstacles=tuple(obstacles), note=note,
    )  # fmt: skip


def _wall(line: np.ndarray, thickness: float, made: str) -> dict[str, Any]:
    """A straight wall: round at its ends, or a rectangle as much longer."""
    (a, b), half = line, 0.5 * thickness
    if made == "capsule":
        return {"capsule": {"from": a.tolist(), "to": b.tolist(), "radius": half}}
    along = half * (b - a) / np.linalg.norm(b - a)
    across = np.array([-along[1], along[0]])
    ring = a - along - across, b + along - across, b + along + across, a - along + across
    return {"polygon": np.array(ring).tolist()}


def _frame(box: Box) -> np.ndarray:
    x0, y0, x1, y1 = box
    corners = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
    return np.stack((corners, np.roll(corners, -1, axis=0)), axis=1)


def maze(random: np.random.Generator, thickness: float) -> Walls:
    """A perfect maze of square rooms, with some walls more or fewer."""
    rooms = int(random.integers(3, 13) if random.random() < 0.9 else random.integers(13, 40))
    free = 1.0 - thickness
    required = 0.5 * float(random.choice((random.uniform(0.1, 0.9) * free, nearly(random, free))))
    required = min(required, 0.6 * free)
    doors = _tree(random, rooms)
    for _ in range(int(random.integers(0, 4))):
        _toggle(random, doors, rooms)
    lines = [
        [[x + 1, y], [x + 1, y + 1]] if across else [[x, y + 1], [x + 1, y + 1]]
        for x in range(rooms)
        for y in range(rooms)
        for across in (True, False)
        if (x, y, across) not in doors and (x if across else y) < rooms - 1
    ]
    box = (0.0, 0.0, float(rooms), float(rooms))
    return Walls(np.array(lines, float).reshape(-1, 2, 2), required, box, box, box)


def _tree(random: np.random.Generator, rooms: int) -> set[tuple[int, int, bool]]:
    """The doors of a perfect maze: (x, y, True) to the right of a room, (x, y, False) above."""
    doors, seen, path = set(), {(0, 0)}, [(0, 0)]
    while path:
        x, y = path[-1]
        ways = [
            (x + i, y + j)
            for i, j in ((1, 0), (-1, 0), (0, 1), (0, -1))
            if 0 <= x + i < rooms and 0 <= y + j < rooms and (x + i, y + j) not in seen
        ]
        if not ways:
            path.pop()
            continue
        room = ways[random.integers(len(ways))]
        doors.add((min(x, room[0]), min(y, room[1]), room[0] != x))
        seen.add(room)
        path.append(room)
    return doors


def _toggle(random: np.random.Generator, doors: set, rooms: int) -> None:
    door = (*random.integers(0, rooms - 1, 2).tolist(), bool(random.integers(2)))
    doors ^= {door}


def comb(random: np.random.Generator, thickness: float) -> Walls:
    """Teeth from below and above in turn, each with a gap at its tip."""
    teeth = int(random.integers(2, 12))
    required = float(random.uniform(0.05, 0.8))
    pitch = 2 * required * float(random.uniform(1.05, 3.0)) + thickness + 0.02
    height = max(6.0, 6 * required)
    lines = []
    for k, width in enumerate(gaps(random, 2 * required, teeth)):
        x, gap = (k + 1) * pitch, min(width + thickness, 0.9 * height)
        lines.append([[x, 0], [x, height - gap]] if k % 2 else [[x, gap], [x, height]])
    width = (teeth + 1) * pitch
    box = (0.0, 0.0, width, height)
    return Walls(
        np.array(lines, float), required, (0.0, 0.0, pitch, height),
        (teeth * pitch, 0.0, width, height), box,
    )  # fmt: skip


def spiral(random: np.random.Generator, thickness: float) -> Walls:
    """A square spiral with stubs across its lane, which leave nearly what the robot needs."""
    required = float(random.uniform(0.1, 0.8))
    lane = 2 * required * float(random.uniform(1.1, 3.0)) + thickness
    turns = int(random.integers(4, 22))
    ring, at = [np.zeros(2)], np.zeros(2)
    for k in range(turns):
        heading = ((1, 0), (0, 1), (-1, 0), (0, -1))[k % 4]
        at = at + lane * (1 + k // 2) * np.array(heading)
        ring.append(at)
    lines = list(np.stack((ring[:-1], ring[1:]), axis=1))
    at_walls = sorted({int(k) for k in random.integers(2, turns, 3)})
    for k, width in zip(at_walls, gaps(random, 2 * required, len(at_walls)), strict=True):
        lines.append(_stub(lines[k], lane - width - thickness, float(random.uniform(0.3, 0.7))))
    corners = np.array(ring)
    low, high = corners.min(axis=0) - 3 * lane, corners.max(axis=0) + 3 * lane
    goal = (float(low[0]), float(low[1]), float(high[0]), float(corners[:, 1].min()))
    lines = [line for line in lines if np.linalg.norm(line[1] - line[0]) > 1e-3]
    edge = (*low.tolist(), *high.tolist())
    return Walls(np.array(lines), required, (0.0, 0.0, lane, lane), goal, edge)


def _stub(wall: np.ndarray, length: float, share: float) -> np.ndarray:
    """A wall that stands on another's left, towards the middle of the spiral."""
    along = (wall[1] - wall[0]) / np.linalg.norm(wall[1] - wall[0])
    foot = wall[0] + share * (wall[1] - wall[0])
    return np.array((foot, foot + max(length, 0.0) * np.array([-along[1], along[0]])))


def traps(random: np.random.Generator, thickness: float) -> Walls:
    """U traps, each inside of the next, open to any side."""
    required = float(random.uniform(0.1, 0.6))
    lane = nearly(random, 2 * required) + thickness
    if random.random() < 0.6:
        lane = 2 * required * float(random.uniform(1.05, 2.5)) + thickness
    half, lines = 1.5 * required + thickness, []
    count_of = int(random.integers(1, 7))
    inner = half
    for _ in range(count_of):
        sides = _frame((-half, -half, half, half))
        lines.extend(np.delete(sides, random.integers(4), axis=0))
        half += lane
    edge = half + 3 * required
    box = (-edge, -edge, edge, edge)
    return Walls(np.array(lines), required, (-inner, -inner, inner, inner), box, box)


def ring_walls(random: np.random.Generator, thickness: float) -> Walls:
    """Polygonal rings round each other, with one gap each of nearly the needed width."""
    required = float(random.uniform(0.1, 0.8))
    radius, lines = 3 * required + 0.5, []
    inner = 0.5 * radius
    for width in gaps(random, 2 * required, int(random.integers(1, 5))):
        sides, gap = int(random.integers(3, 25)), float(width) + thickness
        lines.extend(_broken_ring(random, radius, sides, gap))
        radius = radius / math.cos(math.pi / sides) + gap + 2.2 * required + thickness
    box = (-radius, -radius, radius, radius)
    return Walls(np.array(lines), required, (-inner, -inner, inner, inner), box, box)


def _broken_ring(random: np.random.Generator, radius: float, sides: int, gap: float):
    """A ring's sides, one of which has a gap in it (or two a corner between them, if short)."""
    angles = random.uniform(0, math.tau) + np.arange(sides + 1) * math.tau / sides
    ring = radius / math.cos(math.pi / sides) * np.column_stack((np.cos(angles), np.sin(angles)))
    lines = list(np.stack((ring[:-1], ring[1:]), axis=1))
    a, b = lines.pop(int(random.integers(sides)))
    length = float(np.linalg.norm(b - a))
    if gap < 0.95 * length:
        first = float(random.uniform(0.0, length - gap))
        ends = a + (b - a) * first / length, a + (b - a) * (first + gap) / length
        lines += [np.array(side) for side in ((a, ends[0]), (ends[1], b))
                  if np.linalg.norm(side[1] - side[0]) > 1e-3]  # fmt: skip
    return lines


def clutter(random: np.random.Generator, kind: str) -> Problem | None:
    """Discs and polygons that overlap, as many as just leave a way through, or don't."""
    width = 30.0 if random.random() < 0.9 else 90.0
    required = float(random.uniform(0.05, 0.6))
    largest = float(random.uniform(0.2, 2.0))
    sizes = random.uniform(0.3, 1.0, 40_000) * largest
    covered = float(random.uniform(0.6, 1.5))  # overlapping areas counted again and again
    number = int(np.searchsorted(np.cumsum(math.pi * (sizes + required) ** 2), covered * width**2))
    obstacles = [_lump(random, random.uniform(0, width, 2), size) for size in sizes[:number]]
    if not obstacles:
        return None
    bounds = (0.0, 0.0, width, width)
    cores, radii = zip(*map(core_of, obstacles), strict=True)
    solids = Solids(cores=np.array(cores, object), radii=np.array(radii), bounds=bounds)
    spare = required + LEAST_SPARE_M
    low = places_with_room(random, solids, (0.0, 0.0, width, 0.2 * width), spare, 1)
    high = places_with_room(random, solids, (0.0, 0.8 * width, width, width), spare, 1)
    if not low or not high:
        return None
    return _problem(kind, bounds, required, (low[0], high[0]), obstacles, f"{number} lumps")


def _lump(random: np.random.Generator, at: np.ndarray, size: float) -> dict[str, Any]:
    """A disc, or a polygon of four to eight corners round it, seldom convex."""
    if random.random() < 0.5:
        return {"circle": {"center": at.tolist(), "radius": float(size)}}
    corners = int(random.integers(4, 9))
    angles = (np.arange(corners) + random.uniform(0.0, 0.7, corners)) * math.tau / corners
    spokes = size * random.uniform(0.3, 1.0, (corners, 1))
    return {"polygon": (at + spokes * np.column_stack((np.cos(angles), np.sin(angles)))).tolist()}


Laid = Callable[[np.random.Generator, str], Problem | None]
KINDS: dict[str, Laid] = {
    "maze": _of_walls(maze),
    "comb": _of_walls(comb),
    "spiral": _of_walls(spiral),
    "traps": _of_walls(traps),
    "rings": _of_walls(ring_walls),
    "clutter": clutter,
}
"""The kinds of worlds, by the seed in turn."""
