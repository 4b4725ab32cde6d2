"""If there is a way, it is found; if there is none, it is refused. Oracles: cells' areas, shapely.

``benchmarks/completeness.py`` hunts for more of these at random, in larger worlds.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.ndimage import label

import viaspline as vs

Place = tuple[float, float]
MARGIN_M = 5e-4  # by which the oracle grows a world more and less than is required
SPARE_M = 2e-3  # of the room at start and goal, beyond what is required
TOLERANCE_M = 2e-5  # of a proof and of the chords that stand for a path
ARC_SEGMENTS = 64  # of a quarter of a circle

seeds = st.integers(0, 2**32 - 1)


LONGER = 1e-4  # what a path may be than a fatter robot's, where the shortest is asked for


def planned(
    known: list[Any],
    bounds: tuple[float, ...],
    required: float,
    ends: list[Place],
    optimise: str = "time",
) -> vs.Plan | None:
    """A plan; None for one that is refused. Giving up fails the test."""
    mission = vs.Mission.model_validate(
        {
            "world": {"bounds": bounds, "known": known},
            "robot": {"radius_m": required, "clearance_m": 0},
            "route": {"start": ends[0], "goal": ends[1], "optimise": optimise},
        }
    )
    try:
        return vs.plan(mission)
    except vs.NoPathError:
        return None


def core_of(obstacle: dict[str, Any]) -> tuple[Any, float]:
    """An obstacle as shapely has it, and by how much that is to be grown [m]."""
    if "circle" in obstacle:
        return shapely.Point(obstacle["circle"]["center"]), obstacle["circle"]["radius"]
    if "capsule" in obstacle:
        line = obstacle["capsule"]
        return shapely.LineString([line["from"], line["to"]]), line["radius"]
    return shapely.Polygon(obstacle["polygon"]), 0.0


def squares_of(cells: NDArray[np.bool_]) -> list[tuple[Any, float]]:
    """Blocked cells of 1 m."""
    y, x = np.nonzero(cells)
    return [(square, 0.0) for square in shapely.box(x, y, x + 1, y + 1)]


def free_area(
    cores: list[tuple[Any, float]], bounds: tuple[float, ...], required: float, *, grown: float
) -> Any:
    """What keeps a distance, with arcs whose radii are ``grown`` times as large."""
    x0, y0, x1, y1 = bounds
    inside = shapely.box(x0 + required, y0 + required, x1 - required, y1 - required)
    blocked = [
        shapely.buffer(core, grown * (r + required), quad_segs=ARC_SEGMENTS) for core, r in cores
    ]
    return shapely.difference(inside, shapely.union_all(blocked))


def is_joined(area: Any, ends: list[Place]) -> bool:
    parts = shapely.get_parts(area)
    a, b = shapely.points(ends)
    return bool((shapely.covers(parts, a) & shapely.covers(parts, b)).any())


def truth(
    cores: list[tuple[Any, float]], bounds: tuple[float, ...], required: float, ends: list[Place]
) -> bool | None:
    """Whether there is a way; None where that can't be told."""
    outside = 1.0 / math.cos(1.5 * math.pi / (4 * ARC_SEGMENTS))  # arcs round the true ones
    if is_joined(free_area(cores, bounds, required + MARGIN_M, grown=outside), ends):
        return True
    if not is_joined(free_area(cores, bounds, required - MARGIN_M, grown=1.0), ends):
        return False
    return None


def roomy_places(
    random: np.random.Generator,
    cores: list[tuple[Any, float]],
    bounds: tuple[float, ...],
    room: float,
) -> list[Place]:
    """Two random places with room, or fewer."""
    at = random.uniform(bounds[:2], bounds[2:], (60, 2))
    x0, y0, x1, y1 = bounds
    found = np.minimum(at - (x0, y0), np.array((x1, y1)) - at).min(axis=1)
    for core, radius in cores:
        found = np.minimum(found, shapely.distance(core, shapely.points(at)) - radius)
    return [(float(x), float(y)) for x, y in at[found >= room][:2]]


def least_room(plan: vs.Plan, cores: list[tuple[Any, float]], bounds: tuple[float, ...]) -> float:
    """Distance of a path from the world, by shapely on chords [m]."""
    spans = np.asarray(plan.path.spans)
    u = np.linspace(0.0, 1.0, 201)[:, None, None]
    b0, b1, b2, b3 = np.moveaxis(spans[:, :, :2], 1, 0)
    points = (1 - u) ** 3 * b0 + 3 * u * (1 - u) ** 2 * b1 + 3 * u * u * (1 - u) * b2 + u**3 * b3
    lines = shapely.linestrings(np.moveaxis(points, 0, 1))
    edge = shapely.distance(shapely.box(*bounds).exterior, lines).min()
    solids, radii = np.array([core for core, _ in cores]), np.array([r for _, r in cores])
    (core, _), gaps = shapely.STRtree(lines).query_nearest(
        solids, all_matches=False, return_distance=True
    )
    return float(min(edge, (gaps - radii[core]).min()))


def check(
    known: list[Any],
    cores: list[tuple[Any, float]],
    bounds: tuple[float, ...],
    required: float,
    ends: list[Place],
    is_open: bool,
) -> None:
    """A plan is there if a way is, and keeps its distance."""
    found = planned(known, bounds, required, ends)
    assert (found is not None) == is_open
    if found is not None:
        assert found.certificate.holds
        assert least_room(found, cores, bounds) >= required - TOLERANCE_M


def random_cells(seed: int, aside: int, share: float) -> NDArray[np.bool_]:
    blocked: NDArray[np.bool_] = np.random.default_rng(seed).random((aside, aside)) < share
    return blocked


@given(seeds, st.sampled_from((0.2, 0.3, 0.35, 0.4)), st.floats(0.05, 0.49))
@example(0, 0.35, 0.49)  # joined, and were refused or given up once
@example(62, 0.3, 0.4)
@example(118, 0.3, 0.25)
@example(9, 0.35, 0.4)
@example(407, 0.4, 0.1)
def test_a_robot_thinner_than_a_cell_passes_wherever_cells_share_edges_and_nowhere_else(
    seed: int, share: float, radius: float
) -> None:
    aside = 40
    cells = random_cells(seed, aside, share)
    cells[0, 0] = cells[-1, -1] = False
    areas, _ = label(~cells)
    bounds = (0.0, 0.0, float(aside), float(aside))
    ends = [(0.5, 0.5), (aside - 0.5, aside - 0.5)]
    known = [vs.Obstacle(grid=vs.Grid(cells, 1.0))]
    is_open = bool(areas[0, 0] == areas[-1, -1])
    check(known, squares_of(cells), bounds, radius, ends, is_open)


@settings(max_examples=20)
@given(seeds, st.floats(0.51, 2.4))
def test_a_robot_wider_than_a_cell_passes_wherever_the_grown_cells_leave_a_way(
    seed: int, required: float
) -> None:
    aside, random = 30, np.random.default_rng(seed)
    one_grown = 1.0 + 4.0 * required + math.pi * required**2
    cells = random_cells(seed, aside, float(random.uniform(0.3, 1.3)) / one_grown)
    bounds, cores = (0.0, 0.0, float(aside), float(aside)), squares_of(cells)
    ends = roomy_places(random, cores, bounds, required + SPARE_M)
    assume(len(ends) == 2)
    is_open = truth(cores, bounds, required, ends)
    assume(is_open is not None)
    known = [vs.Obstacle(grid=vs.Grid(cells, 1.0))]
    check(known, cores, bounds, required, ends, bool(is_open))


def rooms_with_doors(random: np.random.Generator) -> tuple[list[dict[str, Any]], float, float]:
    """Rooms of 6 m, doors in most of their walls, some a little too narrow for the robot.

    Returns:
        The walls, what the robot keeps from them, and how wide the world is [m].
    """
    aside, rooms, half = 6.0, int(random.integers(2, 5)), float(random.choice((0.05, 0.15)))
    required = float(random.uniform(0.15, 0.6))
    walls: list[dict[str, Any]] = []

    def wall(flipped: bool, across: float, begin: float, end: float) -> None:
        box = [(begin, across - half), (end, across - half), (end, across + half),
               (begin, across + half)]  # fmt: skip
        walls.append({"polygon": [[y, x] if flipped else [x, y] for x, y in box]})

    for i, j, flipped in np.ndindex(rooms, rooms - 1, 2):
        begin, across = aside * i, aside * (j + 1)
        wider = float(random.choice((-1, 1, 1))) * 10 ** random.uniform(-2.5, -0.3)
        door = max(2.0 * required + wider, 0.05)
        left = float(random.uniform(0.3, aside - door - 0.3))
        if random.random() < 0.2:
            wall(bool(flipped), across, begin, begin + aside)
        else:
            wall(bool(flipped), across, begin, begin + left)
            wall(bool(flipped), across, begin + left + door, begin + aside)
    return walls, required, aside * rooms


def concave_rings(random: np.random.Generator) -> tuple[list[dict[str, Any]], float, float]:
    """Stars with deep notches, over each other here and there; see ``rooms_with_doors``."""
    width, rings = 30.0, []
    for _ in range(int(random.integers(5, 30))):
        corners = int(random.integers(5, 14))
        angles = np.sort(random.uniform(0, math.tau, corners))
        far = random.uniform(0.3, random.uniform(1.0, 5.0), corners)
        ring = random.uniform(0, width, 2) + (far * np.array((np.cos(angles), np.sin(angles)))).T
        if shapely.Polygon(ring).is_valid and shapely.Polygon(ring).area > 0.05:
            rings.append({"polygon": ring.tolist()})
    return rings, float(random.uniform(0.1, 0.9)), width


@settings(max_examples=20)
@given(
    seeds,
    st.sampled_from((rooms_with_doors, concave_rings)),
    st.sampled_from((0.1, 1.0, 5.0)),
    st.sampled_from((0.0, 0.13)),
)
def test_worlds_of_any_size_that_their_bounds_may_cut_are_passed_where_there_is_a_way(
    seed: int, made: Any, scale: float, cut: float
) -> None:
    random = np.random.default_rng(seed)
    obstacles, required, width = made(random)
    known = [{"polygon": (scale * np.array(one["polygon"])).tolist()} for one in obstacles]
    required, width = scale * required, scale * width
    bounds, cores = (cut * width, 0.0, width, (1.0 - cut) * width), [core_of(one) for one in known]
    ends = roomy_places(random, cores, bounds, required + SPARE_M)
    assume(len(ends) == 2)
    is_open = truth(cores, bounds, required, ends)
    assume(is_open is not None)
    check(known, cores, bounds, required, ends, bool(is_open))


def thin_walls(random: np.random.Generator, width: float) -> list[dict[str, Any]]:
    """Walls of a few millimetres to centimetres, and discs, at any angle."""
    obstacles: list[dict[str, Any]] = []
    for _ in range(int(random.integers(10, 60))):
        at, angle = random.uniform(0, width, 2), random.uniform(0, math.tau)
        along = random.uniform(0.5, 3.0) * np.array((math.cos(angle), math.sin(angle)))
        half = float(random.choice((5e-4, 0.01, 0.05)))
        across = half * np.array((-math.sin(angle), math.cos(angle)))
        made = random.integers(3)
        if made == 0:
            line = {"from": (at - along).tolist(), "to": (at + along).tolist(), "radius": half}
            obstacles.append({"capsule": line})
        elif made == 1:
            ring = np.array([-along - across, along - across, along + across, -along + across])
            obstacles.append({"polygon": (at + ring).tolist()})
        else:
            size = float(random.uniform(0.05, 0.8))
            obstacles.append({"circle": {"center": at.tolist(), "radius": size}})
    return obstacles


@settings(max_examples=20)
@given(seeds, st.floats(0.05, 0.8))
def test_a_way_between_thin_walls_is_found_wherever_the_grown_walls_leave_one(
    seed: int, required: float
) -> None:
    random, bounds = np.random.default_rng(seed), (0.0, 0.0, 12.0, 12.0)
    known = thin_walls(random, 12.0)
    cores = [core_of(obstacle) for obstacle in known]
    ends = roomy_places(random, cores, bounds, required + SPARE_M)
    assume(len(ends) == 2)
    is_open = truth(cores, bounds, required, ends)
    assume(is_open is not None)
    check(known, cores, bounds, required, ends, bool(is_open))


@given(
    st.floats(0.05, 1.0),
    st.floats(0.0, math.tau),
    st.floats(-3.0, -0.7).map(lambda power: 10.0**power),
    st.booleans(),
)
@example(0.5, 0.3, 1e-3, True)
@example(0.5, 0.3, 1e-3, False)
def test_a_gap_is_passed_if_it_is_a_millimetre_wider_than_the_robot_and_not_if_it_is_narrower(
    required: float, angle: float, more: float, is_wider: bool
) -> None:
    half = required + (0.5 if is_wider else -0.5) * more
    assume(half > 0.01)
    turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
    walls = np.array([[(0, -8), (0, -half - 0.01)], [(0, half + 0.01), (0, 8)]]) @ turn
    frame = np.array([(-6, -8), (6, -8), (6, 8), (-6, 8)]) @ turn
    lines = [*walls, *np.stack((frame, np.roll(frame, -1, axis=0)), axis=1)]
    known = [{"capsule": {"from": a.tolist(), "to": b.tolist(), "radius": 0.01}} for a, b in lines]
    start, goal = (np.array([(-3.0, 1.5), (3.0, -2.0)]) @ turn).tolist()
    bounds = (-15.0, -15.0, 15.0, 15.0)
    ends = [(start[0], start[1]), (goal[0], goal[1])]
    check(known, [core_of(wall) for wall in known], bounds, required, ends, is_wider)


@settings(max_examples=10)
@given(seeds, st.floats(0.1, 0.49))
def test_a_way_for_a_fat_robot_is_one_for_a_thinner_one_and_no_longer(
    seed: int, radius: float
) -> None:
    """Where the shortest is asked for: the soonest way of a thinner robot may be a longer one."""
    cells = random_cells(seed, 30, 0.25)
    cells[0, 0] = cells[-1, -1] = False
    known, bounds = [vs.Obstacle(grid=vs.Grid(cells, 1.0))], (0.0, 0.0, 30.0, 30.0)
    ends = [(0.5, 0.5), (29.5, 29.5)]
    fat = planned(known, bounds, radius, ends, "length")
    assume(fat is not None)
    assert fat is not None
    for share in (0.2, 0.7, 0.95):
        thin = planned(known, bounds, share * radius, ends, "length")
        assert thin is not None
        assert thin.path.length <= fat.path.length * (1.0 + LONGER)


@settings(max_examples=10)
@given(seeds, st.floats(0.05, 0.8))
def test_between_thin_walls_a_thinner_robot_has_no_longer_way(seed: int, required: float) -> None:
    random, bounds = np.random.default_rng(seed), (0.0, 0.0, 12.0, 12.0)
    known = thin_walls(random, 12.0)
    cores = [core_of(obstacle) for obstacle in known]
    ends = roomy_places(random, cores, bounds, required + SPARE_M)
    assume(len(ends) == 2)
    fat = planned(known, bounds, required, ends, "length")
    assume(fat is not None)
    assert fat is not None
    for share in (0.1, 0.5, 0.8, 0.95):
        thin = planned(known, bounds, share * required, ends, "length")
        assert thin is not None
        assert thin.path.length <= fat.path.length * (1.0 + LONGER)


@settings(max_examples=10)
@given(seeds, st.floats(0.1, 0.6), st.integers(2, 6))
def test_round_the_tips_of_teeth_a_thinner_robot_has_no_longer_way(
    seed: int, required: float, teeth: int
) -> None:
    """Where a fat robot just fits, its turns are tight; a thinner one's may not be wider."""
    random = np.random.default_rng(seed)
    pitch, height, half = float(2.0 * required * random.uniform(1.1, 2.5)), 6.0, 0.01
    tips = height - 2.0 * required - 10 ** random.uniform(-2.0, -0.5, teeth)
    walls = [
        [(k * pitch, 0.0), (k * pitch, tip)] if k % 2 else [(k * pitch, height - tip),
                                                            (k * pitch, height)]
        for k, tip in enumerate(tips.tolist(), 1)
    ]  # fmt: skip
    known = [{"capsule": {"from": a, "to": b, "radius": half}} for a, b in walls]
    bounds = (0.0, 0.0, (teeth + 1) * pitch + half, height)
    ends = [(0.5 * pitch, 3.0), ((teeth + 0.5) * pitch, 3.0)]
    lengths = [
        plan.path.length if plan is not None else math.inf
        for plan in (
            planned(known, bounds, share * required, ends, "length")
            for share in (0.2, 0.5, 0.8, 0.9, 0.95, 1.0)
        )
    ]
    assert math.isfinite(lengths[-1])
    for thin, fat in pairwise(lengths):
        assert thin <= fat * (1.0 + LONGER)


@settings(max_examples=6)
@given(seeds, st.floats(0.3, 1.2))
def test_a_refusal_names_a_gap_as_wide_as_it_is_and_remedies_that_serve(
    seed: int, required: float
) -> None:
    random, bounds = np.random.default_rng(seed), (0.0, 0.0, 12.0, 12.0)
    known = thin_walls(random, 12.0)
    cores = [core_of(obstacle) for obstacle in known]
    ends = roomy_places(random, cores, bounds, required + SPARE_M)
    assume(len(ends) == 2)
    asked = {
        "world": {"bounds": bounds, "known": known},
        "robot": {"radius_m": 0.1 * required, "clearance_m": 0.9 * required},
        "route": {"start": {"at": ends[0]}, "goal": {"at": ends[1]}},
    }
    try:
        vs.plan(vs.Mission.model_validate(asked))
        return
    except vs.NoPathError as refusal:
        changes, words = refusal.changes, str(refusal)
        where = shapely.Point(refusal.where[:2])
    if "m of room" in words:
        told = float(words.split(" m of room")[0].split()[-1])
        edge = shapely.distance(shapely.box(*bounds).exterior, where)
        room = min([float(edge), *(shapely.distance(core, where) - r for core, r in cores)])
        assert told == pytest.approx(2.0 * room, abs=1e-3)
    for change in changes:
        robot, route = dict(asked["robot"]), dict(asked["route"])
        if change.key == "robot.clearance_m":
            robot["clearance_m"] = change.value
        else:
            route[change.key.split(".")[1]] = {"at": change.value}
        followed = {**asked, "robot": robot, "route": route}
        assert vs.plan(vs.Mission.model_validate(followed)).certificate.holds
