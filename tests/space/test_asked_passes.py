from collections.abc import Sequence

import numpy as np
import pytest

from viaspline.errors import GaveUpError, NoPathError
from viaspline.mission.model import Mission
from viaspline.space.asked_passes import asked_passes, gates_of_leg
from viaspline.space.plan_spatial import plan_spatial
from viaspline.space.routing.pass_gates import SIDE_BITS


def mission(**asked: object) -> Mission:
    mast = {"circle": {"center": [50, 0], "radius": 2}, "height_m": [0, 20], **asked}
    return Mission.model_validate(
        {"world": {"known": [mast]}, "route": {"start": [0, 0, 5], "goal": [100, 0, 5]}}
    )


@pytest.mark.parametrize("side", ["left", "right", "over", "under"])
def test_a_side_that_is_forced_is_the_only_one_that_is_left(side: str) -> None:
    (asked,) = asked_passes(mission(pass_on=side))
    assert asked.allowed == (side,)
    (forbidden,) = asked_passes(mission(never_pass_on=side))
    assert set(forbidden.allowed) == set(SIDE_BITS) - {side}


def test_an_obstacle_counts_on_legs_that_come_near_it_and_on_no_other() -> None:
    asked = asked_passes(mission(pass_on="left"))
    near = gates_of_leg(asked, np.array([0.0, 3, 5]), np.array([100.0, 3, 5]), 1.0)
    far = gates_of_leg(asked, np.array([0.0, 40, 5]), np.array([100.0, 40, 5]), 1.0)
    assert near.shape == (1, 8)
    assert far.shape == (0, 8)
    assert asked_passes(mission()) == ()


WALL = {"name": "wall", "box": {"min": [20, -5, 0], "max": [22, 5, 18]}, "pass_on": "over"}


def flight(*known: dict[str, object], via: Sequence[list[float]] = (), **route: object) -> Mission:
    return Mission.model_validate({
        "world": {"known": known, "altitude": {"min_m": 1, "max_m": 18}},
        "robot": {"radius_m": 0.5, "clearance_m": 1},
        "route": {"start": [0, 0, 8], "via": via, "goal": [40, 0, 8], **route},
    })  # fmt: skip


def test_sides_that_leave_no_way_are_named_where_there_is_one_without_them() -> None:
    lid = {"name": "lid", "box": {"min": [10, -9, 15], "max": [32, 9, 18]}}
    low = {**WALL, "box": {"min": [20, -5, 0], "max": [22, 5, 14]}}
    with pytest.raises(GaveUpError) as told:
        plan_spatial(flight(low, lid))
    assert "passes 'wall' over; without that there is one" in str(told.value)
    assert "pass_on" in told.value.remedy


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"pass_on": "over"}, "'wall' over"),
        ({"pass_on": "under"}, "'wall' under"),
    ],
)
def test_a_side_for_which_the_limits_leave_no_room_is_refused(
    asked: dict[str, str], words: str
) -> None:
    with pytest.raises(
        NoPathError, match=f"nothing passes {words}: there is no room for 1 m"
    ) as told:
        plan_spatial(flight({**WALL, **asked}))
    assert told.value.obstacles == ("wall",)
    assert told.value.via == "goal"
    assert plan_spatial(flight({**WALL, "pass_on": "left"})).certificate.holds
    never = {"never_pass_on": "right", **{k: WALL[k] for k in ("name", "box")}}
    assert plan_spatial(flight(never)).certificate.holds


def test_an_order_leaves_out_legs_that_would_pass_where_there_is_no_room() -> None:
    """Beyond the wall's ends lie both via points: from one to the other none may go straight."""
    high = {**WALL, "box": {"min": [20, -30, 0], "max": [22, 5, 18]}}
    found = plan_spatial(flight({**high, "pass_on": "left"}, via=[[30, 20, 8], [10, 20, 8]],
                                order="shortest"))  # fmt: skip
    assert [via.at[0] for via in found.mission.route.via] == [10.0, 30.0]
