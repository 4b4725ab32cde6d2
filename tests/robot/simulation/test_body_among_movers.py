"""Bodies that are no discs beside what moves, held against shapely."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.simulation.body_among_movers import BodyAmongMovers
from viaspline.robot.simulation.driven_motion import DrivenMotion

TRUCK = [(-0.3, -0.5), (2.3, -0.5), (2.3, 0.5), (-0.3, 0.5)]
"""About its rear axle."""
SHAPES: list[tuple[dict[str, Any], shapely.Geometry]] = [
    ({"circle": {"center": [0.1, 0], "radius": 0.4}}, shapely.Point(0.1, 0).buffer(0.4, 256)),
    ({"capsule": {"from": [-1, 0], "to": [1, 0.2], "radius": 0.2}},
     shapely.LineString([(-1, 0), (1, 0.2)]).buffer(0.2, 256)),
    ({"polygon": [[-0.6, -0.3], [0.6, -0.3], [0, 0.8]]},
     shapely.Polygon([(-0.6, -0.3), (0.6, -0.3), (0, 0.8)])),
]  # fmt: skip


def placed(shape: shapely.Geometry, x: float, y: float, heading: float) -> shapely.Geometry:
    turned = shapely.affinity.rotate(shape, heading, origin=(0, 0), use_radians=True)
    return shapely.affinity.translate(turned, x, y)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 100_000))
def test_the_least_distance_is_that_of_the_body_as_it_is_turned(seed: int) -> None:
    rng = np.random.default_rng(seed)
    keys, shape = SHAPES[seed % len(SHAPES)]
    velocity, begin = rng.uniform(-1, 1, 2), rng.uniform(-6, 6, 2)
    motion = {"from": begin.tolist(), "velocity_mps": velocity.tolist()}
    moving = vs.MovingObstacles([vs.Obstacle(**keys, motion=motion)])
    times = np.linspace(0.0, 10.0, 101)
    places, headings = rng.uniform(-5, 5, (101, 2)), np.cumsum(rng.uniform(-0.3, 0.3, 101))
    driven = DrivenMotion(times, places, headings, np.ones(101), times, 0.1)
    robot = RobotSpec(footprint=TRUCK)
    gaps, index = BodyAmongMovers(moving, robot, driven).nearest(places, times)
    bodies = [
        placed(shapely.Polygon(TRUCK), *place, heading)
        for place, heading in zip(places.tolist(), headings.tolist(), strict=True)
    ]
    things = [placed(shape, *(begin + time * velocity), 0.0) for time in times.tolist()]
    true = np.array([a.distance(b) for a, b in zip(bodies, things, strict=True)])
    assert max(gaps.min(), 0.0) == pytest.approx(true.min(), abs=1e-3)
    told_apart = (gaps < 0.0) == (true == 0.0)
    assert (true[~told_apart] < 1e-3).all()
    assert (gaps <= true + 1e-3).all()
    assert set(index.tolist()) == {0}


def in_lanes(offset: float) -> vs.Mission:
    """A truck, and a cart that comes towards it so far beside its path [m]."""
    motion = {"from": [30, offset], "velocity_mps": [-1, 0]}
    cart = {"name": "cart", "circle": {"center": [0, 0], "radius": 0.4}, "motion": motion}
    robot = {"footprint": TRUCK, "clearance_m": 0.2, "max_speed_mps": 1.5}
    route = {"start": [0, 0], "goal": [30, 0]}
    return vs.Mission.model_validate({"world": {"known": [cart]}, "robot": robot, "route": route})


def test_a_truck_drives_on_beside_what_comes_along_the_next_lane() -> None:
    """It waited for that at its start for half a minute, and was told to have been touched."""
    mission = in_lanes(1.4)
    plan = vs.plan(mission)
    run = vs.simulate(mission, plan=plan)
    assert run.reached
    assert run.duration == pytest.approx(plan.trajectory.duration)
    assert run.encounters is not None
    assert run.encounters.contacts == ()
    assert run.encounters.clearance == pytest.approx(0.5, abs=5e-3)


def test_a_truck_that_is_run_into_is_touched() -> None:
    """By what comes from the side faster than it can stop, right before it."""
    motion = {"keyframes": [[0, 4, 30], [2, 4, 6], [4, 4, -6], [6, 4, -30]], "after": "stay"}
    dog = {"name": "dog", "circle": {"center": [0, 0], "radius": 0.3}, "motion": motion}
    robot = {"footprint": TRUCK, "max_speed_mps": 1.5, "sensor": {"range_m": 8}}
    route = {"start": [0, 0], "goal": [30, 0]}
    data = {"world": {"unseen": [dog]}, "robot": robot, "route": route}
    run = vs.simulate(vs.Mission.model_validate(data))
    assert run.encounters is not None
    assert [contact.obstacle for contact in run.encounters.contacts] == ["dog"]
