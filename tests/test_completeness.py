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
from scipy.ndimage import label

import viaspline as vs
from mazes import concave_rings, nested_traps, random_cells, rooms_with_doors, thin_walls
from ways_by_areas import Place, core_of, least_room, roomy_places, squares_of, truth

SPARE_M = 2e-3  # of the room at start and goal, beyond what is required
TOLERANCE_M = 2e-5  # of a proof and of the chords that stand for a path
LONGER = 1e-4  # what a path may be than a fatter robot's, where the shortest is asked for

seeds = st.integers(0, 2**32 - 1)


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


ROOM = (0.0, 0.0, 12.0, 12.0)


def between_thin_walls(
    seed: int, required: float
) -> tuple[list[dict[str, Any]], list[tuple[Any, float]], list[Place]]:
    """Thin walls in a room, as missions and as shapely have them, and two places among them."""
    random = np.random.default_rng(seed)
    known = thin_walls(random, ROOM[2])
    cores = [core_of(obstacle) for obstacle in known]
    ends = roomy_places(random, cores, ROOM, required + SPARE_M)
    assume(len(ends) == 2)
    return known, cores, ends


@settings(max_examples=20)
@given(seeds, st.floats(0.05, 0.8))
def test_a_way_between_thin_walls_is_found_wherever_the_grown_walls_leave_one(
    seed: int, required: float
) -> None:
    known, cores, ends = between_thin_walls(seed, required)
    is_open = truth(cores, ROOM, required, ends)
    assume(is_open is not None)
    check(known, cores, ROOM, required, ends, bool(is_open))


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
    known, _, ends = between_thin_walls(seed, required)
    fat = planned(known, ROOM, required, ends, "length")
    assume(fat is not None)
    assert fat is not None
    for share in (0.1, 0.5, 0.8, 0.95):
        thin = planned(known, ROOM, share * required, ends, "length")
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


@settings(max_examples=10)
@given(seeds)
@example(2)  # the thinner one's turns had no room for their ramps, and were laid wider for it
@example(10)
@example(46)
def test_out_of_traps_a_thinner_robot_has_no_longer_way(seed: int) -> None:
    """Round the end of a wall it turns twice within its thickness, and may have little room."""
    known, required, half = nested_traps(np.random.default_rng(seed))
    bounds, ends = (-half, -half, half, half), [(0.0, 0.0), (half - 1.5 * required,) * 2]
    check_no_longer(known, bounds, required, ends, (0.1, 0.5, 0.8, 0.9, 0.95, 0.99, 1.0))


@settings(max_examples=10)
@given(seeds, st.floats(0.6, 2.4))
@example(11, 0.698)  # coarse cells led a thinner one another way round
@example(18, 1.738)
@example(132, 1.342)
def test_past_lone_cells_a_thinner_robot_has_no_longer_way(seed: int, required: float) -> None:
    """Of many ways that hardly differ it isn't to take a longer one."""
    aside, random = 60, np.random.default_rng(seed)
    one_grown = 1.0 + 4.0 * required + math.pi * required**2
    cells = random_cells(seed, aside, float(random.uniform(0.3, 0.7)) / one_grown)
    bounds = (0.0, 0.0, float(aside), float(aside))
    ends = roomy_places(random, squares_of(cells), bounds, required + SPARE_M)
    assume(len(ends) == 2)
    known = [vs.Obstacle(grid=vs.Grid(cells, 1.0))]
    check_no_longer(known, bounds, required, ends, (0.35, 0.5, 0.65, 0.8, 0.9, 1.0))


def check_no_longer(
    known: list[Any], bounds: tuple[float, ...], required: float, ends: list[Place],
    shares: tuple[float, ...],
) -> None:  # fmt: skip
    """No robot of parts of a size has a longer path than a fatter one, by ``LONGER``."""
    found = [planned(known, bounds, share * required, ends, "length") for share in shares]
    lengths = [math.inf if plan is None else plan.path.length for plan in found]
    for k, length in enumerate(lengths):
        shortest = min(lengths[k:])
        assert length <= shortest * (1.0 + LONGER) or math.isinf(shortest)


@settings(max_examples=6)
@given(seeds, st.floats(0.3, 1.2))
def test_a_refusal_names_a_gap_as_wide_as_it_is_and_remedies_that_serve(
    seed: int, required: float
) -> None:
    known, cores, ends = between_thin_walls(seed, required)
    asked = {
        "world": {"bounds": ROOM, "known": known},
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
        edge = shapely.distance(shapely.box(*ROOM).exterior, where)
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
