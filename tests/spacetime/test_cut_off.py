"""Robots that are cut off by what moves: proven, and only where no drive is found by any means."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.problem.requirements import Requirements
from viaspline.spacetime.world_squares import WorldSquares
from viaspline.world.world import World

BODY = {"radius_m": 0.3, "clearance_m": 0.1, "max_speed_mps": 1.5, "max_accel_mps2": 1}
LOW, HIGH = 1.2, 5.0


def corridor(*movers: tuple[list[list[float]], str], bay: bool, **route: Any) -> vs.Mission:
    """A corridor 24 m long and 1.2 m wide, with a bay in the middle of it or without."""
    walls = [[[0, LOW], [10, LOW], [10, HIGH], [0, HIGH]]]
    walls += [[[14, LOW], [24, LOW], [24, HIGH], [14, HIGH]]]
    walls += [] if bay else [[[10, LOW], [14, LOW], [14, HIGH], [10, HIGH]]]
    known: list[dict[str, Any]] = [{"polygon": one} for one in walls]
    for k, (frames, after) in enumerate(movers):
        disc = {"center": [0, 0], "radius": 0.4}
        motion = {"keyframes": frames, "after": after, "before": "stay"}
        known.append({"name": f"cart {k}", "circle": disc, "motion": motion})
    return vs.Mission.model_validate(
        {
            "world": {"bounds": [0, 0, 24, HIGH], "known": known},
            "robot": BODY,
            "route": {"start": [1, 0.6], "goal": [23, 0.6], **route},
        }
    )


def refused(asked: vs.Mission) -> vs.NoPathError:
    with pytest.raises(vs.NoPathError) as caught:
        vs.plan(asked)
    return caught.value


ONCOMING: list[list[float]] = [[0, 22, 0.6], [40, 2.5, 0.6]]


def test_a_robot_that_is_met_in_a_corridor_without_a_bay_is_refused_by_proof() -> None:
    """It gave up, after seconds in which paths on either side were tried."""
    error = refused(corridor((ONCOMING, "stay"), bay=False))
    assert error.reason.startswith("what moves cuts the robot off from its route")
    assert error.obstacles == ("cart 0",)


def test_with_a_bay_it_waits_there_until_the_other_is_past() -> None:
    asked = corridor(([[0, 22, 0.6], [60, 2.5, 0.6]], "vanish"), bay=True)
    assert vs.plan(asked).moving_certificate is not None


def test_who_is_met_while_it_holds_its_goal_is_led_aside_before() -> None:
    """Nothing was met under way, so no path was led round what came to the goal afterwards."""
    late = [[0, 23.5, 0.6], [25, 23.5, 0.6], [45, 1, 0.6]]
    asked = corridor((late, "vanish"), bay=True, goal=[20, 0.6], hold_s=60)
    plan = vs.plan(asked)
    assert plan.moving_certificate is not None
    assert plan.trajectory.end_time > 25.0


def test_what_leaves_the_way_in_the_end_cuts_nobody_off() -> None:
    parked = [[0, 7, 0.6], [30, 7, 0.6], [35, 12, 0.6], [40, 12, 3.9]]
    plan = vs.plan(corridor((parked, "stay"), bay=True))
    assert plan.trajectory.end_time > 35.0


@given(
    frames=st.lists(
        st.tuples(st.floats(1, 23), st.floats(0.6, 4.5)), min_size=2, max_size=5
    ),
    gaps=st.lists(st.floats(2, 30), min_size=4, max_size=4),
    after=st.sampled_from(["stay", "vanish"]),
    depart=st.floats(0, 20),
)  # fmt: skip
@settings(max_examples=25, deadline=None)
def test_nobody_is_refused_who_can_wait_for_a_free_way(
    frames: list[tuple[float, float]], gaps: list[float], after: str, depart: float
) -> None:
    """By samples: a point that waits at its start and then drives straight on at full speed."""
    times = np.cumsum([0.0, *gaps])[: len(frames)]
    keys = [[float(t), *place] for t, place in zip(times, frames, strict=True)]
    asked = corridor((keys, after), bay=True, depart_s=depart)
    if not waits_and_goes(keys, after, depart):
        return
    assert not said_of(asked).startswith("what moves cuts")


def said_of(asked: vs.Mission) -> str:
    """Why there is no plan; nothing where there is one."""
    try:
        vs.plan(asked)
    except vs.PlanningError as error:
        return error.reason
    return ""


def waits_and_goes(frames: list[list[float]], after: str, depart: float) -> bool:
    """Whether at some departure a straight drive stays clear, by samples."""
    t, x, y = np.array(frames).T
    for wait in np.arange(0.0, 120.0, 4.0):
        when = depart + np.arange(0.0, wait + 40.0, 0.02)
        late = np.clip(when - depart - wait, 0, None)
        at = np.clip(1.0 + 1.5 * late, 1.0, 23.0)
        gap = np.hypot(np.interp(when, t, x) - at, np.interp(when, t, y) - 0.6)
        there = (when <= t[-1]) | (after == "stay")
        if (gap[there] > 0.8).all():
            return True
    return False


def test_squares_are_joined_wherever_a_body_may_pass() -> None:
    wall = vs.Obstacle.model_validate({"polygon": [[4, 0], [5, 0], [5, 9.1], [4, 9.1]]})
    for gap, passes in ((0.9, True), (0.1, False)):
        world = World([wall], bounds=(0, 0, 10, 9.1 + gap))
        bare = World(bounds=(0, 0, 10, 9.1 + gap))
        least = Requirements(radius=0.4, clearance=0.0).required
        squares = WorldSquares.over(bare, 2_500, least)
        assert squares is not None
        assert squares.may_join(world, [(1, 1), (9, 1)]) is passes
    assert WorldSquares.over(World(), 900, 0.4) is None
