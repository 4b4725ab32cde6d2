"""Drives that are searched in places and times at once: sampled here by numpy alone."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.kernels.arrays import Floats
from viaspline.kernels.spacetime.thrust_clear import KeptClear
from viaspline.kernels.spacetime.thrust_search import ThrustLattice, search_thrusts
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

RADIUS = 0.3
CART_RADIUS = 0.6


def oncoming(speed: float) -> dict[str, Any]:
    return {
        "name": "cart",
        "circle": {"center": [0, 0], "radius": CART_RADIUS},
        "motion": {"from": [12, 0], "velocity_mps": [-speed, 0]},
    }


def lane(speed: float, **robot: Any) -> vs.Mission:
    """A lane that is too narrow for two, with a niche behind the start alone."""
    walls = [
        ("west", [[-8.5, -1], [-8, -1], [-8, 1], [-8.5, 1]]),
        ("north", [[-20, 0.9], [20, 0.9], [20, 1.4], [-20, 1.4]]),
        ("south west", [[-20, -1.4], [-5, -1.4], [-5, -0.9], [-20, -0.9]]),
        ("south east", [[-3, -1.4], [20, -1.4], [20, -0.9], [-3, -0.9]]),
        ("niche west", [[-5.5, -4], [-5, -4], [-5, -1.4], [-5.5, -1.4]]),
        ("niche east", [[-3, -4], [-2.5, -4], [-2.5, -1.4], [-3, -1.4]]),
        ("niche south", [[-5.5, -4.5], [-2.5, -4.5], [-2.5, -4], [-5.5, -4]]),
    ]
    known = [{"name": name, "polygon": corners} for name, corners in walls]
    return vs.Mission.model_validate(
        {
            "world": {"known": [*known, oncoming(speed)]},
            "robot": {"radius_m": RADIUS, "clearance_m": 0.05, **robot},
            "route": {"start": [0, 0], "goal": [14, 0]},
        }
    )


def test_a_robot_goes_back_to_a_niche_behind_it_and_lets_what_comes_pass() -> None:
    plan = vs.plan(lane(0.8))
    law = plan.trajectory
    times = np.arange(law.start_time, law.end_time, 1e-3)
    robot = np.asarray(plan.path.at_distance(law.distance_at(times)))
    cart = np.column_stack((12.0 - 0.8 * times, np.zeros(len(times))))
    assert robot[:, 0].min() < -3.0
    assert np.hypot(*(robot - cart).T).min() >= RADIUS + CART_RADIUS + 0.05 - 1e-6
    assert plan.certificate.holds
    assert plan.timed is not None
    assert [one.is_searched for one in plan.timed.candidates if one.chosen] == [True]
    assert plan.drivability.curvature_jumps == 0


def test_a_robot_with_a_turning_circle_is_not_led_back_on_a_path_that_it_cannot_drive() -> None:
    with pytest.raises(vs.GaveUpError) as caught:
        vs.plan(lane(0.8, min_turn_radius_m=1.0))
    assert not any("at once" in words for words in caught.value.tried)


def test_what_was_searched_says_so_where_it_finds_nothing() -> None:
    mission = lane(0.8)
    walled = [one for one in mission.world.known if not (one.name or "").startswith("niche")]
    closed = Obstacle(name="lid", polygon=((-5.0, -1.4), (-3.0, -1.4), (-3.0, -0.9), (-5.0, -0.9)))
    world = mission.world.model_copy(update={"known": (*walled, closed)})
    with pytest.raises(vs.PlanningError, match="cart"):
        vs.plan(mission.model_copy(update={"world": world}))


def driven(states: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Times, places, speeds and accelerations along the cubics between states, by samples."""
    found = []
    for first, last in pairwise(states):
        lasts = last[0] - first[0]
        w = np.linspace(0.0, 1.0, 60)[:, None]
        p0, p3 = first[1:3], last[1:3]
        p1, p2 = p0 + first[3:] * lasts / 3.0, p3 - last[3:] * lasts / 3.0
        v = 1.0 - w
        place = v**3 * p0 + 3 * v**2 * w * p1 + 3 * v * w**2 * p2 + w**3 * p3
        speed = 3 * (v**2 * (p1 - p0) + 2 * v * w * (p2 - p1) + w**2 * (p3 - p2)) / lasts
        accel = 6 * (v * (p2 - 2 * p1 + p0) + w * (p3 - 2 * p2 + p1)) / lasts**2
        found.append((first[0] + w[:, 0] * lasts, place, speed, accel))
    times, places, speeds, accels = zip(*found, strict=True)
    return tuple(map(np.concatenate, (times, places, speeds, accels)))  # type: ignore[return-value]


discs = st.lists(
    st.tuples(
        st.floats(2, 12), st.floats(-5, 5), st.floats(-1.5, 1.5), st.floats(-1.5, 1.5),
        st.floats(0.2, 0.8),
    ),
    min_size=1,
    max_size=6,
)  # fmt: skip


@settings(max_examples=30, deadline=None)
@given(discs, st.sampled_from([1.0, 1.2]))
@example([(4.0, 0.0, -1.0, 0.0, 0.5), (4.0, 1.2, -1.0, 0.0, 0.5), (4.0, -1.2, -1.0, 0.0, 0.5)], 1.0)
def test_a_drive_keeps_its_distance_and_its_limits(
    drawn: list[tuple[float, float, float, float, float]], weight: float
) -> None:
    moving = MovingObstacles(
        Obstacle(
            circle={"center": (0, 0), "radius": radius},
            motion={"from": (x, y), "velocity_mps": (vx, vy)},
        )
        for x, y, vx, vy, radius in drawn
    )
    around = KeptClear(World().packed, moving.packed, 0.4, 0.4)
    lattice = ThrustLattice(0.0, 0.5, 0.25, 8, 2, 2)
    goal = np.array([14.0, 0.5])
    states = search_thrusts(around, lattice, np.zeros(2), goal, 2.0, weight, 3000).states
    if not len(states):
        return
    times, places, speeds, accels = driven(states)
    for x, y, vx, vy, radius in drawn:
        disc = np.array([x, y]) + times[:, None] * [vx, vy]
        assert np.hypot(*(places - disc).T).min() >= radius + 0.4 - 1e-9
    assert np.hypot(*speeds.T).max() <= 2.0 + 0.05
    assert np.hypot(*accels.T).max() <= 1.0 + 1e-6
    assert states[0].tolist() == [0.0, 0.0, 0.0, 0.0, 0.0]
    assert states[-1, 1:].tolist() == [*goal, 0.0, 0.0]
