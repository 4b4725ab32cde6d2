"""What a body came too near to is named, with whether its sensor could have shown it in time."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from viaspline.mission.model import Mission
from viaspline.report.files.run_json import run_json
from viaspline.report.terminal.run_tables import shortfall_words
from viaspline.robot.run import Shortfall
from viaspline.robot.simulation.driven_motion import DrivenMotion
from viaspline.robot.simulation.near_misses import near_misses
from viaspline.robot.simulator import simulate
from viaspline.trajectory.limits import REACTION_S
from viaspline.world.world import World

RADIUS, CLEARANCE, BRAKE, STEP, LENGTH = 0.3, 0.2, 1.0, 0.05, 12.0
GRAZED_M = 0.1
"""What is driven until one of the beams that graze a surface hits it near the place sought [m]."""
Disc = tuple[float, float, float]

discs = st.lists(
    st.tuples(st.floats(1.0, 11.0), st.floats(0.4, 2.0), st.floats(0.05, 0.35)).flatmap(
        lambda disc: st.sampled_from([disc, (disc[0], -disc[1], disc[2])])
    ),
    min_size=1,
    max_size=5,
)


def mission_among(things: list[Disc], sensor: dict[str, Any], **world: Any) -> Mission:
    unseen = [{"circle": {"center": [x, y], "radius": r}} for x, y, r in things]
    robot = {"radius_m": RADIUS, "clearance_m": CLEARANCE, "max_accel_mps2": BRAKE}
    return Mission.model_validate(
        {
            "world": {"unseen": unseen, **world},
            "robot": {**robot, "sensor": sensor},
            "route": {"start": [0, 0], "goal": [LENGTH, 0]},
        }
    )


def straight(speed: float) -> DrivenMotion:
    """A robot that drives along x and looks where it goes."""
    times = np.arange(0.0, LENGTH / speed, 0.01)
    still = np.zeros(len(times))
    along = speed * times
    return DrivenMotion(times, np.column_stack((along, still)), still, still + speed, along, STEP)


def in_view(
    place: np.ndarray, surface: np.ndarray, own: Disc, others: list[Disc], lidar: dict[str, float],
    slack: float,
) -> bool:  # fmt: skip
    """Whether a place is in view, by shapely; with a slack above 0 rather yes, below rather no."""
    away = surface - place
    turned = abs(math.degrees(math.atan2(away[1], away[0])))
    spread = math.degrees(math.atan2(slack, math.hypot(*away)))
    if math.hypot(*away) > lidar["range_m"] + slack:
        return False
    if turned > 0.5 * lidar["fov_deg"] + spread:
        return False
    line = shapely.LineString([place, surface])
    solid = [(x, y, r - slack) for x, y, r in others if r > slack]
    if any(shapely.Point(x, y).distance(line) < r for x, y, r in solid):
        return False
    x, y, r = own
    return bool(shapely.Point(x, y).distance(line) > r - max(3.0 * slack, 1e-6))


@settings(max_examples=60, deadline=None)
@given(
    things=discs,
    far=st.floats(0.6, 5.0),
    wide=st.floats(20.0, 350.0),
    speed=st.floats(0.3, 2.0),
)
@example(things=[(4.0, 0.4375, 0.25)], far=4.0, wide=247.0, speed=0.5)  # grazed, at 3 degrees
def test_what_a_lidar_could_have_shown_is_what_lay_open_to_it(
    things: list[Disc], far: float, wide: float, speed: float
) -> None:
    assume(all(abs(y) > r + 0.05 for _, y, r in things))
    lidar = {"range_m": far, "fov_deg": wide, "beams": 1440}
    mission, motion = mission_among(things, {"lidar": lidar}), straight(speed)
    near = near_misses(mission, World.everything(mission), motion)
    for index, disc in enumerate(things):
        x, y, r = disc
        gaps = np.hypot(motion.places[:, 0] - x, y) - r - RADIUS
        found = [one for one in near if one.obstacle == f"obstacle {index + 1}"]
        if gaps.min() > CLEARANCE:
            assert not found
        elif gaps.min() < CLEARANCE - 1e-3:
            check(found[0], disc, things, motion, lidar, speed)


def check(
    found: Shortfall, disc: Disc, things: list[Disc], motion: DrivenMotion,
    lidar: dict[str, float], speed: float,
) -> None:  # fmt: skip
    x, y, r = disc
    surface = np.array([x, y - math.copysign(r, y)])
    assert found.clearance == pytest.approx(abs(y) - r - RADIUS, abs=1e-3)
    assert found.surface_at == pytest.approx(surface, abs=0.03)
    half = math.sqrt((RADIUS + CLEARANCE) ** 2 - min(abs(y) - r, RADIUS + CLEARANCE) ** 2)
    needed = (x - half) / speed - (REACTION_S + 0.5 * speed / BRAKE)
    if needed < 0.0:
        assert found.needed_by is None
    else:
        assert found.needed_by == pytest.approx(needed, abs=0.05 / speed + 0.02)
    others = [other for other in things if other is not disc]
    looks = np.arange(0.0, motion.times[-1], STEP)
    views = {
        slack: [
            t for t in looks
            if in_view(np.array([speed * t, 0.0]), surface, disc, others, lidar, slack)
        ]
        for slack in (0.05, -0.02)
    }  # fmt: skip
    if found.shown is not None:
        assert found.shown >= min(views[0.05]) - 0.02
    if views[-0.02]:
        assert found.shown is not None
        apart = 5.0 * STEP + GRAZED_M / speed
        assert found.shown <= min(views[-0.02]) + apart
    both = found.shown is not None and found.needed_by is not None
    assert found.seen_in_time == (both and found.shown <= found.needed_by)  # type: ignore[operator]


def test_a_range_sensor_shows_a_thing_as_soon_as_any_part_of_it_is_near() -> None:
    for far, in_time in ((0.7, False), (4.0, True)):
        mission = mission_among([(6.0, 0.6, 0.2)], {"range_m": far})
        (near,) = near_misses(mission, World.everything(mission), straight(1.0))
        assert near.shown == pytest.approx(6.0 - math.sqrt((far + 0.2) ** 2 - 0.36), abs=STEP)
        assert near.seen_in_time is in_time


def test_what_is_on_the_map_was_known_and_the_edges_are() -> None:
    mission = mission_among(
        [], {"range_m": 1}, known=[{"circle": {"center": [5, 0.6], "radius": 0.2}, "name": "post"}],
        bounds=[-1, -0.52, 13, 9],
    )  # fmt: skip
    beside = straight(1.0)
    beside.places[:, 1] -= 0.05  # which keeps 0.15 m to the post and 0.17 m to the bounds
    near = near_misses(mission, World.everything(mission), beside)
    assert [one.obstacle for one in near] == ["post", "bounds"]
    assert all(one.on_map and one.seen_in_time and one.shown == 0.0 for one in near)
    assert "it is on the map" in shortfall_words(near[0])


@pytest.mark.slow
def test_a_run_that_keeps_its_clearance_has_none_and_one_that_does_not_says_why() -> None:
    for far, kept in ((9.0, True), (0.45, False)):
        mission = mission_among([(6.0, 0.0, 0.4)], {"lidar": {"range_m": far}})
        run = simulate(mission)
        assert run.certificate.holds is kept
        data = json.loads(run_json(run, "x"))["nearer_than_asked"]
        assert len(data) == len(run.shortfalls) == (0 if kept else 1)
        if not kept:
            assert data[0]["obstacle"] == "obstacle 1"
            assert data[0]["clearance_m"] == pytest.approx(run.certificate.clearance, abs=2e-3)
            assert data[0]["seen_in_time"] is False
            assert "could NOT have shown it in time" in shortfall_words(run.shortfalls[0])
