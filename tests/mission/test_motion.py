"""How obstacles move: what may be said of it, and what is wrong with what was said."""

from __future__ import annotations

import itertools
import math
import warnings
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from viaspline.errors import MissionError, MissionWarning
from viaspline.formats.mission_yaml import yaml_text
from viaspline.formats.yaml_document import yaml_document
from viaspline.mission.model import Mission
from viaspline.mission.motion_checks import MIN_PERIOD_S

ROUTE = {"start": [0, 0], "goal": [9, 0]}
DISC = {"circle": {"center": [0, 0], "radius": 1}}


def mission_with(motion: Any, **more: Any) -> Mission:
    known = [{**DISC, **more, "motion": motion}]
    return Mission.model_validate({"world": {"known": known}, "route": ROUTE})


def fault_of(motion: Any, **more: Any) -> str:
    with pytest.raises(MissionError) as caught:
        mission_with(motion, **more)
    [fault] = caught.value.faults
    return str(fault)


def test_an_obstacle_moves_along_keyframes_or_straight_on() -> None:
    along = mission_with({"keyframes": [[0, 1, 2], [4, 5, 2]], "after": "stay"})
    straight = mission_with({"from": [1, 2], "velocity_mps": [1, 0]})
    assert [len(m.world.moving) for m in (along, straight)] == [1, 1]
    assert along.world.standing == ()


@pytest.mark.parametrize(
    ("motion", "words"),
    [
        ({}, "has none of keyframes and from"),
        ({"from": [0, 0], "velocity_mps": [1, 0], "keyframes": [[0, 0, 0]]}, "exclude"),
        ({"from": [0, 0]}, "doesn't say how fast it goes"),
        ({"keyframes": [[0, 1, 2], [1, 2, 2]]}, "when the keyframes are over"),
        ({"keyframes": [[0, 1, 2], [0, 2, 2]], "after": "stay"}, "not after the one before"),
        ({"keyframes": [[2, 1, 2], [1, 2, 2]], "after": "stay"}, "not after the one before"),
        ({"keyframes": [[0, 1, 2], [1e-9, 2, 2]], "after": "loop"}, "too short a time"),
        ({"keyframes": [[0, 1, 2]], "after": "bounce"}, "too short a time"),
        (
            {"keyframes": [[0, 1, 2], [1, 2, 2], [1 + 1e-9, 2, 4]], "after": "stay"},
            "keyframes[2]: is 2 m from the one before, 1e-09 s later",
        ),
        (
            {"keyframes": [[0, 1, 2, 0], [1e-05, 1, 2, 90]], "after": "vanish"},
            "keyframes[1]: is turned by 90 deg",
        ),
        ({"keyframes": [[0, 1, math.nan]], "after": "stay"}, "NaN"),
        ({"keyframes": [[0, 1, 2, 1e9]], "after": "stay"}, r"[0][3]: 1e+09 is out of range"),
        ({"keyframes": [[0, 1e20, 2]], "after": "stay"}, r"[0][1]: 1e+20 is out of range"),
        ({"keyframes": [], "after": "stay"}, "an empty list"),
        ({"keyframes": [[0, 1]], "after": "stay"}, "list of 2"),
        ({"keyframes": [[0, 1, 2]], "after": "return"}, "loop, bounce, stay or vanish"),
        (
            {"keyframes": [[0, 1, 2], [1, 1, 2]], "after": "loop", "before": "absent"},
            "goes on and on",
        ),
    ],
)
def test_what_makes_no_sense_is_named_with_a_remedy(motion: Any, words: str) -> None:
    assert words in fault_of(motion)


def test_what_rises_faster_than_anything_does_is_named() -> None:
    frames = [[0, 1, 2, 0, 0], [1, 1, 2], [1.0001, 1, 2, 0, 500]]
    with pytest.raises(MissionError) as caught:
        mission_with({"keyframes": frames, "after": "stay"})
    words = "keyframes[2]: is 500 m from the one before, 0.0001 s later: it goes 5e+06 m/s"
    assert any(words in str(fault) for fault in caught.value.faults)


def test_what_moves_has_no_side_no_holes_and_is_no_map() -> None:
    motion = {"from": [0, 0], "velocity_mps": [1, 0]}
    assert "no side" in fault_of(motion, pass_on="left")
    ring = [[0, 0], [9, 0], [9, 9], [0, 9]]
    hole = [[2, 2], [3, 2], [3, 3]]
    with pytest.raises(MissionError, match="can't have holes"):
        Mission.model_validate(
            {
                "world": {"known": [{"polygon": ring, "holes": [hole], "motion": motion}]},
                "route": ROUTE,
            }
        )


def test_a_moving_obstacle_may_stand_on_a_via_point_for_a_while() -> None:
    mission = mission_with({"from": [0, 0], "velocity_mps": [1, 0]})
    assert mission.route.start.at == (0, 0)


def test_a_loop_that_jumps_draws_a_warning_that_says_how_far() -> None:
    with pytest.warns(MissionWarning, match="'cart' jumps by 4 m where its loop begins again"):
        mission_with({"keyframes": [[0, 1, 2], [4, 5, 2]], "after": "loop"}, name="cart")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mission_with({"keyframes": [[0, 1, 2], [2, 5, 2], [4, 1, 2]], "after": "loop"})
        mission_with({"keyframes": [[0, 1, 2], [4, 5, 2]], "after": "bounce"})


times = st.lists(st.floats(-100, 100), min_size=2, max_size=6, unique=True)
times = times.map(sorted)


@settings(max_examples=50, deadline=None)
@given(times, st.sampled_from(["loop", "bounce", "stay", "vanish"]), st.booleans(), st.data())
def test_a_motion_survives_being_written_and_read(
    at: list[float], after: str, turns: bool, data: st.DataObject
) -> None:
    numbers = st.floats(-50, 50)
    frames = [[t, *(data.draw(numbers) for _ in range(3 if turns else 2))] for t in at]
    assume(at[-1] - at[0] >= MIN_PERIOD_S)
    assume(all(b - a >= 0.02 for a, b in itertools.pairwise(at)))  # as fast as nothing goes
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        mission = mission_with({"keyframes": frames, "after": after})
        again = Mission.model_validate(yaml_document(yaml_text(mission), "x.yaml").data)
    assert again == mission


@pytest.mark.parametrize(
    "motion",
    [
        {"keyframes": [[0, 5, 5, 0, 3], [4, 9, 5]], "after": "stay"},
        {"from": [5, 5, 3], "velocity_mps": [1, 0]},
        {"from": [5, 5], "velocity_mps": [1, 0, 0.5]},
    ],
)
def test_a_motion_with_heights_makes_a_mission_one_in_space(motion: dict[str, Any]) -> None:
    disc = {"circle": {"center": [0, 0], "radius": 1}, "motion": motion}
    data = {"world": {"known": [disc]}, "route": {"start": [0, 0, 9], "goal": [9, 0, 9]}}
    assert Mission.model_validate(data).is_spatial
    with pytest.raises(MissionError, match="has no height, in a mission in space"):
        Mission.model_validate({**data, "route": {"start": [0, 0, 9], "goal": [9, 0]}})


def test_numbers_beyond_a_height_are_too_many() -> None:
    disc = {"circle": {"center": [0, 0], "radius": 1},
            "motion": {"keyframes": [[0, 5, 5, 0, 3, 1]], "after": "stay"}}  # fmt: skip
    with pytest.raises(MissionError, match="keyframes"):
        Mission.model_validate({"world": {"known": [disc]}, "route": {"start": [0, 0]}})
