"""Missions by which it is judged how well a path is driven, by a seed."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import shapely
from scipy.ndimage import distance_transform_edt, label
from worlds import obstacles

import viaspline as vs

SPEED, ACCEL = 5.0, 1.0  # [m/s], [m/s²] along the path and across it
SIZE = 500.0
PAIRS = 30  # of places on a map, one of which is taken
TURNING: tuple[dict, ...] = (
    {},
    {"max_yaw_rate_degps": 90.0},
    {"drive": {"differential": {"track_m": 0.5}}},
    {"drive": {"differential": {"track_m": 0.5}, "lag_s": 0.15, "delay_s": 0.1},
     "localization": {"position_noise_m": 0.02}},
    {"drive": {"skid_steer": {"track_m": 0.6}}},
)  # fmt: skip


def vector_world(seed: int) -> vs.Mission:
    """A standard vector world from corner to corner, at 5 m/s with 1 m/s² both ways."""
    robot = {"radius_m": 2.0, "clearance_m": 0.0}
    return _crossing(obstacles(seed), robot, ((15.0, 15.0), (485.0, 485.0)))


def four_vias(seed: int) -> vs.Mission:
    """Four via points among twelve discs in 100 m x 100 m, all places with room."""
    random = np.random.default_rng((11, seed))
    robot = {"radius_m": 0.5, "clearance_m": 0.5}
    discs = [
        {"circle": {"center": random.uniform(0, 100, 2).tolist(), "radius": float(radius)}}
        for radius in random.uniform(2.0, 8.0, 12)
    ]
    places: list[list[float]] = []
    while len(places) < 6:
        place = random.uniform(2, 98, 2)
        gaps = [math.dist(place, d["circle"]["center"]) - d["circle"]["radius"] for d in discs]
        if min(gaps) > 1.2:
            places.append(place.tolist())
    return vs.Mission.model_validate({
        "world": {"bounds": [0, 0, 100, 100], "known": discs},
        "robot": robot | _limits(),
        "route": {"start": places[0], "via": places[1:-1], "goal": places[-1]},
    })  # fmt: skip


def lake(seed: int) -> vs.Mission:
    """Lanes of 100 to 600 m over a lake; an island of 5 to 30 m stands in the middle of each."""
    random = np.random.default_rng((12, seed))
    lanes = int(random.integers(2, 6))
    places, heading = [np.zeros(2)], float(random.uniform(-math.pi, math.pi))
    while len(places) <= lanes:
        length = float(random.uniform(100, 600))
        turn = float(random.uniform(-2.2, 2.2))
        end = places[-1] + length * np.array((math.cos(heading + turn), math.sin(heading + turn)))
        lane = shapely.LineString((places[-1], end))
        if all(shapely.distance(lane, shapely.Point(place)) > 60 for place in places[:-1]):
            places.append(end)
            heading += turn
    known = []
    for a, b in pairwise(places):
        along = (b - a) / math.dist(a, b)
        across = np.array((-along[1], along[0]))
        reach = float(random.uniform(5, 30)) / 2.0
        middle = (a + b) / 2.0 + random.uniform(-0.3, 0.3) * reach * across
        known.append(_island(random, middle, reach))
    return vs.Mission.model_validate({
        "world": {"known": known},
        "robot": {"radius_m": 1.0, "clearance_m": 1.0, "max_speed_mps": 3.0,
                  "max_accel_mps2": 0.5, "max_lateral_accel_mps2": 0.5},
        "route": {"start": places[0].tolist(), "via": [p.tolist() for p in places[1:-1]],
                  "goal": places[-1].tolist()},
    })  # fmt: skip


def _island(random: np.random.Generator, middle: np.ndarray, reach: float) -> dict:
    """A disc or a polygon so wide [m]."""
    if random.random() < 0.5:
        return {"circle": {"center": middle.tolist(), "radius": reach}}
    corners = int(random.integers(5, 10))
    angles = (np.arange(corners) + random.uniform(0, 0.6, corners)) * math.tau / corners
    spokes = random.uniform(0.6, 1.0, (corners, 1)) * reach
    ring = middle + np.column_stack((np.cos(angles), np.sin(angles))) * spokes
    return {"polygon": ring.tolist()}


def rooms(seed: int, side: int = 80) -> vs.Mission:
    """A map of rooms with doors, cells of 0.5 m."""
    random = np.random.default_rng((13, seed))
    blocked = np.zeros((side, side), bool)
    blocked[[0, -1]] = blocked[:, [0, -1]] = True
    walls = np.arange(16, side - 8, 16) + random.integers(-3, 4, len(range(16, side - 8, 16)))
    for wall in walls.tolist():
        blocked[wall], blocked[:, wall] = True, True
    edges = [0, *walls.tolist(), side - 1]
    for wall in walls.tolist():
        for low, high in pairwise(edges):
            for cells in (blocked[wall], blocked[:, wall]):
                door = int(random.integers(low + 2, high - 5))
                cells[door : door + 4] = False
    blocked |= random.random((side, side)) < 0.004
    return _on_map(random, blocked, 0.5, 0.4)


def crop(seed: int, folder: Path, side: int = 120) -> vs.Mission:
    """A part of one of the maps in a folder, cells of 1 m."""
    random = np.random.default_rng((14, seed))
    files = sorted(folder.rglob("*.map"))
    if not files:
        raise SystemExit(f"{str(folder)!r} has no maps; give MovingAI's .map files")
    while True:
        (obstacle,) = vs.load_map(files[int(random.integers(len(files)))])
        cells = obstacle.grid.blocked
        rows, columns = (min(side, n) for n in cells.shape)
        row, column = (
            int(random.integers(n - m + 1))
            for n, m in zip(cells.shape, (rows, columns), strict=True)
        )
        part = cells[row : row + rows, column : column + columns].copy()
        if not part.all() and part.mean() < 0.7:
            return _on_map(random, part, 1.0, 0.7)


def indoor_round(seed: int, file: Path) -> vs.Mission:
    """Five places on a map, in any order; of vias half are stations, of rounds half closed."""
    random = np.random.default_rng((16, seed))
    (obstacle,) = vs.load_map(file)
    world = vs.World([obstacle])
    low, high = np.reshape(obstacle.grid.extent, (2, 2))
    places: list[list[float]] = []
    while len(places) < 5:
        place = random.uniform(low + 0.65, high - 0.65).round(2)
        if world.distance([place])[0] > 0.65:
            places.append(place.tolist())
    vias = [
        {"at": at, "dwell_s": 4.0} if random.random() < 0.5 else {"at": at} for at in places[1:]
    ]
    ends = {"closed": True} if random.random() < 0.5 else {"goal": vias.pop()["at"]}
    robot = {"radius_m": 0.35, "clearance_m": 0.15, "max_speed_mps": 1.5, "max_accel_mps2": 0.8}
    return vs.Mission.model_validate({
        "world": {"known": [obstacle]},
        "robot": robot | {"max_lateral_accel_mps2": 0.6},
        "route": {"start": places[0], "via": vias, **ends},
    })  # fmt: skip


def with_stations(seed: int, *, discs: int, closed: bool) -> vs.Mission:
    """Three to seven places on 15 to 80 m, three of five of the vias stations, among discs or none.

    By turns for a robot without a drive, one that turns by 90 degrees a second, and drives that
    turn on the spot, two wheels with lag and noise among them.
    """
    random = np.random.default_rng((17, seed, discs, closed))
    size, count = float(random.choice([15.0, 30.0, 80.0])), int(random.integers(3, 8))
    known = [
        {"circle": {"center": random.uniform(0, size, 2).tolist(), "radius": float(share) * size}}
        for share in random.uniform(0.02, 0.08, discs)
    ]
    places: list[list[float]] = []
    while len(places) < count:
        at = random.uniform(1, size - 1, 2).round(3).tolist()
        gaps = [math.dist(at, one["circle"]["center"]) - one["circle"]["radius"] for one in known]
        if min(gaps, default=1.0) > 0.65 and all(math.dist(at, place) > 1.0 for place in places):
            places.append(at)
    stays = random.choice([0.5, 2.0, 4.0, 10.0], count) * (random.random(count) < 0.6)
    vias = [{"at": at, "dwell_s": float(stay)} for at, stay in zip(places[1:], stays, strict=False)]
    ends = {"closed": True} if closed else {"goal": vias.pop()["at"]}
    robot = {"radius_m": 0.3, "clearance_m": 0.2, "max_speed_mps": 2.0, "max_accel_mps2": 1.0}
    return vs.Mission.model_validate({
        "world": {"known": known}, "robot": robot | TURNING[seed % len(TURNING)],
        "route": {"start": places[0], "via": vias, **ends},
    })  # fmt: skip


def _on_map(
    random: np.random.Generator, blocked: np.ndarray, cell: float, required: float
) -> vs.Mission:
    """Between two far places of the largest area in which the robot gets about.

    The farthest of some pairs between which something stands, if there are such.
    """
    room = cell * (distance_transform_edt(np.pad(~blocked, 1))[1:-1, 1:-1] - 0.5)
    areas, _ = label(room > 1.3 * required + 0.3 * cell)
    largest = np.argwhere(areas == np.argmax(np.bincount(areas[areas > 0])))
    ends = largest[random.integers(len(largest), size=(PAIRS, 2))][..., ::-1]  # x, y
    between = ends[:, :1] + np.linspace(0, 1, 200)[:, None] * (ends[:, 1:] - ends[:, :1])
    column, row = np.rint(between).astype(int).transpose(2, 0, 1)
    is_met = blocked[row, column].any(axis=1)
    far = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    start, goal = cell * (ends[np.argmax(far + far.max() * is_met)] + 0.5)
    height, width = blocked.shape
    grid = vs.Obstacle(grid=vs.Grid(blocked, cell))
    robot = {"radius_m": 0.6 * required, "clearance_m": 0.4 * required}
    return vs.Mission.model_validate({
        "world": {"bounds": [0, 0, cell * width, cell * height], "known": [grid]},
        "robot": robot | _limits(2.0),
        "route": {"start": start.tolist(), "goal": goal.tolist()},
    })  # fmt: skip


def _crossing(found: list, robot: dict, ends: tuple) -> vs.Mission:
    return vs.Mission.model_validate({
        "world": {"bounds": [0, 0, SIZE, SIZE], "known": found},
        "robot": robot | _limits(),
        "route": {"start": ends[0], "goal": ends[1]},
    })  # fmt: skip


def _limits(speed: float = SPEED) -> dict[str, float]:
    return {"max_speed_mps": speed, "max_accel_mps2": ACCEL, "max_lateral_accel_mps2": ACCEL}
