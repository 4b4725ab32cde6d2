"""What a search that goes on from step to step does about what is seen meanwhile."""

from __future__ import annotations

import pytest

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigation.pending_search import (
    FIRST_STAGE,
    LAST_STAGE,
    NEARBY,
    NO_STAGE,
    ORDER,
    PendingSearch,
    SearchSoFar,
    SideInDoubt,
)
from viaspline.world.world import World

ROCK = Obstacle(circle={"center": (5, 0), "radius": 1}, name="rock")
POST = Obstacle(circle={"center": (9, 1), "radius": 1}, name="post")
DOUBT = SideInDoubt((5.0, 0.0), "left", ("reflex", "planned"), 40.0)


@pytest.fixture
def pending() -> PendingSearch:
    so_far = SearchSoFar(0.1, 0.0, World([ROCK]), {})
    return PendingSearch(2.0, World([ROCK]), ("rock",), (1, 0), so_far, 3.0, 4.0, DOUBT)


def test_a_search_goes_on_where_it_was_while_nothing_new_is_seen(pending: PendingSearch) -> None:
    assert pending.with_new(World()) is pending


def test_a_search_that_meets_something_new_begins_anew_with_all_that_is_in_the_way(
    pending: PendingSearch,
) -> None:
    both = pending.with_new(World([POST]))
    assert both.obstacles.names == both.names == ("rock", "post")
    assert both.begin_with == FIRST_STAGE
    assert both.again < both.since  # it doesn't wait
    assert both.so_far is pending.so_far
    assert both.doubt is None


def test_what_comes_after_the_last_stage_comes_after_all_of_them() -> None:
    assert all((k, 1000) < NO_STAGE for k in range(len(ORDER)))
    assert FIRST_STAGE < (NEARBY, 0) < LAST_STAGE < NO_STAGE
    assert [ORDER[k] for k in (NEARBY, LAST_STAGE[0])] == ["from_rest", "from_rest"]
