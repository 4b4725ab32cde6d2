"""Straight lines through doors: clear by shapely, and found wherever there is one to be had."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import affinity

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.turning.hybrid_astar.narrow_places import Passage
from viaspline.planning.turning.hybrid_astar.pose_search import SEARCH_EFFORTS, pose_problems
from viaspline.planning.turning.hybrid_astar.pose_sequence import find_row
from viaspline.planning.turning.hybrid_astar.search_outcome import Goal, NotFound, Pose
from viaspline.world.world import World

HALF_WIDTH_M, KEPT_M = 0.6, 0.2
CAR = Requirements(
    radius=0.4,
    clearance=KEPT_M,
    footprint=((-0.4, -0.6), (2.2, -0.6), (2.2, 0.6), (-0.4, 0.6)),
)
RHO_M = 2.7
OVERHANG_M = 0.1 * HALF_WIDTH_M  # of the discs by which a search knows the body, and more
START, GOAL = (-15.0, 1.0), (15.0, -2.0)


def box(x0: float, y0: float, x1: float, y1: float, turn: float = 0.0) -> Obstacle:
    ring = affinity.rotate(shapely.box(x0, y0, x1, y1), turn, origin=(0, 0), use_radians=True)
    return Obstacle(polygon=shapely.get_coordinates(ring)[:-1].tolist())


def wall_with_door(aside: float, width: float, thick: float, turn: float = 0.0) -> World:
    below, above = aside - 0.5 * width, aside + 0.5 * width
    walls = [
        box(-0.5 * thick, -40, 0.5 * thick, below, turn),
        box(-0.5 * thick, above, 0.5 * thick, 40, turn),
    ]
    return World(walls, bounds=(-20, -20, 20, 20))


def found_in(world: World, requirements: Requirements = CAR) -> tuple[Passage, ...]:
    places = np.array([START, GOAL])
    *_, problem = pose_problems(world, requirements, RHO_M, RHO_M, places, SEARCH_EFFORTS[0])
    return problem.passages(places[0], Goal(*GOAL))


def swept(passage: Passage) -> shapely.Geometry:
    body = shapely.Polygon(CAR.footprint)
    return shapely.union_all(
        [
            affinity.translate(
                affinity.rotate(body, pose.heading, origin=(0, 0), use_radians=True), pose.x, pose.y
            )
            for pose in (passage.enter, passage.leave)
        ]
    ).convex_hull


@given(
    aside=st.floats(-8.0, 8.0),
    more=st.floats(0.01, 0.7),
    thick=st.floats(0.1, 1.5),
    turn=st.floats(-0.6, 0.6),
)
@settings(deadline=None, max_examples=30)
def test_through_a_door_that_the_body_fits_there_is_a_line_and_it_is_clear(
    aside: float, more: float, thick: float, turn: float
) -> None:
    width = 2.0 * (HALF_WIDTH_M + KEPT_M + OVERHANG_M) + more
    world = wall_with_door(aside, width, thick, turn)
    (passage,) = found_in(world)
    line = swept(passage)
    walls = shapely.union_all([shapely.Polygon(each.polygon) for each in world.obstacles])
    assert walls.distance(line) >= KEPT_M - 1e-9
    middle = affinity.rotate(shapely.Point(0, aside), turn, origin=(0, 0), use_radians=True)
    assert line.covers(middle)
    way = np.subtract((passage.leave.x, passage.leave.y), (passage.enter.x, passage.enter.y))
    assert way @ np.subtract(GOAL, START) > 0.0  # not backwards


def test_where_there_is_room_or_no_way_nothing_leads() -> None:
    assert found_in(World([], bounds=(-20, -20, 20, 20))) == ()
    assert found_in(wall_with_door(0.0, 6.0, 1.0)) == ()
    assert found_in(wall_with_door(0.0, 0.9, 1.0)) == ()


def test_a_corridor_longer_than_the_body_has_a_line_at_either_end() -> None:
    first, last = found_in(wall_with_door(0.0, 2.0, 12.0))
    assert first.enter.x < -6.0 < first.leave.x < last.enter.x < 6.0 < last.leave.x


def test_a_place_that_bends_too_sharply_for_the_body_has_none_that_it_would_touch_on() -> None:
    shelf = box(1.6, -8.0, 3.0, 8.0)  # right behind the door
    world = World([*wall_with_door(0.0, 1.8, 1.0).obstacles, shelf], bounds=(-20, -20, 20, 20))
    walls = shapely.union_all([shapely.Polygon(each.polygon) for each in world.obstacles])
    for passage in found_in(world):
        assert walls.distance(swept(passage)) >= KEPT_M - 1e-9


@cache
def room_with_a_shelf() -> World:
    parts = [
        box(34.16, 0.0, 36.92, 27.97), box(34.16, 29.44, 36.92, 40.0),
        box(39.01, 23.83, 44.7, 28.38),
    ]  # fmt: skip
    return World(parts, bounds=(0, 0, 60, 40))


def test_a_long_body_gets_through_a_door_and_past_a_shelf_right_behind_it() -> None:
    """The search by itself gave up after 33 s: it had seen everything but a straight approach."""
    cart = Requirements(
        radius=0.32,
        clearance=0.2,
        footprint=((-0.62, -0.32), (2.47, -0.32), (2.47, 0.32), (-0.62, 0.32)),
    )
    start, goal = Pose(8.9, 20.0, -2.5), Goal(54.9, 4.6)
    world = room_with_a_shelf()
    chains = find_row(world, cart, 0.785, 0.785, [start], [goal], WorkBudget(math.inf))
    assert not isinstance(chains, NotFound)
    (chain,) = chains
    assert np.allclose(chain.spans[0, 0], (start.x, start.y))
    assert np.allclose(chain.spans[-1, 3], (goal.x, goal.y))
    assert chain.expanded < 30_000
