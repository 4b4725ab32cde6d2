"""Proofs that two robots can't pass, against drives that are made up and driven."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.fleet.unserved.passing_proof import PassingRobot, cannot_both_arrive
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

LEFT, RIGHT = (1.0, 1.0), (19.0, 1.0)


def disc(*points: tuple[float, float], leaves: bool = False) -> PassingRobot:
    """A robot of 0.4 m that keeps 0.1 m of walls, and 0.2 m of other bodies."""
    return PassingRobot(points, 0.5, 0.5, leaves)


def corridor(height: float, *, bay: tuple[float, float, float] | None = None) -> World:
    """A corridor along the lower edge, with a bay (from, to, depth) or without one."""
    walls = [(0.0, 20.0, height)]
    if bay is not None:
        low, high, depth = bay
        walls = [(0.0, low, height), (high, 20.0, height), (low, high, height + depth)]
    known = [
        Obstacle.model_validate({"polygon": [[a, h], [b, h], [b, 9], [a, 9]]}) for a, b, h in walls
    ]
    return World(known, bounds=(0, 0, 20, 8))


def test_two_cannot_change_ends_of_a_narrow_corridor() -> None:
    assert cannot_both_arrive(corridor(1.4), disc(LEFT, RIGHT), disc(RIGHT, LEFT))


def test_a_bay_lets_them() -> None:
    world = corridor(1.4, bay=(8, 12, 2.5))
    assert not cannot_both_arrive(world, disc(LEFT, RIGHT), disc(RIGHT, LEFT))


def test_one_behind_the_other_needs_no_room() -> None:
    first, second = disc((5.0, 0.7), (19.0, 0.7)), disc((1.0, 0.7), (15.0, 0.7))
    assert not cannot_both_arrive(corridor(1.4), first, second)
    turned = disc((5.0, 0.7), (15.0, 0.7)), disc((1.0, 0.7), (19.0, 0.7))
    assert cannot_both_arrive(corridor(1.4), *turned)


def test_one_that_leaves_at_the_end_of_the_corridor_lets_the_other_pass() -> None:
    first, second = disc((5.0, 0.7), (15.0, 0.7), leaves=True), disc((1.0, 0.7), (19.0, 0.7))
    assert not cannot_both_arrive(corridor(1.4), first, second)


def test_a_via_point_beyond_the_other_robot_cannot_be_served() -> None:
    there_and_back = disc((1.0, 0.7), (19.0, 0.7), (3.0, 0.7))
    assert cannot_both_arrive(corridor(1.4), there_and_back, disc((10.0, 0.7), (12.0, 0.7)))
    assert not cannot_both_arrive(corridor(4.0), there_and_back, disc((10.0, 0.7), (12.0, 0.7)))


def test_nothing_is_proven_of_an_open_world() -> None:
    assert not cannot_both_arrive(World(), disc(LEFT, RIGHT), disc(RIGHT, LEFT))


@given(
    height=st.floats(1.1, 3.0),
    bay=st.none() | st.tuples(st.floats(3, 8), st.floats(9.5, 16), st.floats(0.5, 4.0)),
    first=st.tuples(st.floats(1, 19), st.floats(1, 19)),
    second=st.tuples(st.floats(1, 19), st.floats(1, 19)),
)
@settings(max_examples=12, deadline=None)
@example(height=1.4, bay=(8.0, 12.0, 2.0), first=(1.0, 19.0), second=(19.0, 1.0))
def test_no_drive_that_there_is_is_proven_impossible(
    height: float,
    bay: tuple[float, float, float] | None,
    first: tuple[float, float],
    second: tuple[float, float],
) -> None:
    """An oracle of its own: on a fine line and a pocket, every pair of places, flooded."""
    for low, high in (first, second):
        if abs(low - high) < 0.1:
            return
    if min(abs(first[0] - second[0]), abs(first[1] - second[1])) < 1.0:
        return
    passes = (first[0] < second[0]) != (first[1] < second[1])
    has_room = bay is not None and bay[2] >= 1.2 and bay[1] - bay[0] >= 1.2
    one, two = (disc(*((x, 0.55) for x in ends)) for ends in (first, second))
    impossible = cannot_both_arrive(corridor(height, bay=bay), one, two)
    # who needn't pass, or can in a bay with room for one, or beside each other, has a drive
    if not passes or has_room or height >= 2.05:
        assert not impossible


@pytest.mark.parametrize("seed", range(4))
def test_random_pairs_of_drives_are_never_called_impossible(seed: int) -> None:
    random = np.random.default_rng(seed)
    circles = random.uniform(1, 9, (3, 2))
    world = World(
        [
            Obstacle.model_validate({"circle": {"center": c.tolist(), "radius": 0.8}})
            for c in circles
        ],
        bounds=(0, 0, 10, 10),
    )
    places = []
    for _ in range(4000):  # one robot at a time walks a little, wherever there is room
        if not places:
            pair = random.uniform(0.5, 9.5, (2, 2))
        else:
            pair = places[-1].copy()
            pair[random.integers(2)] += random.normal(0.0, 0.15, 2)
        is_free = (np.hypot(*(pair[:, None] - circles).T) >= 1.3).all()
        is_inside = ((pair >= 0.5) & (pair <= 9.5)).all()
        if is_free and is_inside and np.hypot(*(pair[0] - pair[1])) >= 1.0:
            places.append(pair)
    if len(places) < 2:
        return
    one, two = (
        disc(*(tuple(places[k][i].tolist()) for k in (0, len(places) // 2, -1))) for i in (0, 1)
    )
    assert not cannot_both_arrive(world, one, two)
