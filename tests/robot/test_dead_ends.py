"""Dead ends deeper than a lidar sees: the robot gets out of them, or says that there is no way."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.ndimage import label

from viaspline.mission.model import Mission
from viaspline.robot.navigator import Navigator
from viaspline.robot.replanning import deadline
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate
from viaspline.robot.state import RobotState

Wall = tuple[float, float, float, float]

THICK = 0.2
RADIUS, RANGE, GOAL = 0.3, 1.5, (4.5, 0.0)
DRIVES: dict[str, dict[str, Any]] = {
    "point": {},
    "differential": {"drive": {"differential": {"track_m": 0.4}}},
}


def cup(depth: float, width: float) -> list[Wall]:
    """Three walls about the start, open on the side away from the goal."""
    half, left = 0.5 * width, 2.0 - depth
    return [(left, half, 2.0, half), (2.0, half, 2.0, -half), (2.0, -half, left, -half)]


def spiral(turns: int, width: float) -> list[Wall]:
    """Walls in which the robot starts in the middle; it leaves after so many quarter turns."""
    walls, x, y = [], -0.5 * width, 0.5 * width
    for k in range(turns + 3):
        length = width * (1 + k // 2)
        dx, dy = ((1, 0), (0, -1), (-1, 0), (0, 1))[k % 4]
        walls.append((x, y, x + length * dx, y + length * dy))
        x, y = x + length * dx, y + length * dy
    return walls


def comb(teeth: int, depth: float, width: float) -> list[Wall]:
    """A wall across the way with teeth towards the start: a pocket between every two of them."""
    half = 0.5 * teeth * width
    walls = [(2.5, -half, 2.5, half)]
    for k in range(teeth + 1):
        y = k * width - half
        walls.append((2.5 - depth, y, 2.5, y))
    return walls


def drive(walls: list[Wall], keys: dict[str, Any], noise: float, seed: int = 7) -> Run:
    unseen = [{"capsule": {"from": w[:2], "to": w[2:], "radius": 0.5 * THICK}} for w in walls]
    lidar = {"range_m": RANGE, "fov_deg": 270, "beams": 180, "noise_m": noise}
    mission = Mission.model_validate(
        {
            "world": {"unseen": unseen, "bounds": [-6, -6, 6, 6]},
            "robot": {
                "radius_m": RADIUS, "clearance_m": 0.05, "max_speed_mps": 1.5,
                "sensor": {"lidar": lidar}, **keys,
            },
            "route": {"start": {"at": [0, 0], "heading_deg": 0}, "goal": list(GOAL)},
        }
    )  # fmt: skip
    return simulate(mission, seed=seed, step=0.1)


def depth_of_touch(run: Run, walls: list[Wall]) -> float:
    """How far the body was inside of a wall, by shapely on the path that was driven [m]."""
    line = shapely.LineString(np.asarray(run.path.evaluate(np.linspace(*run.path.domain, 20000))))
    there = shapely.MultiLineString([(w[:2], w[2:]) for w in walls])
    return RADIUS + 0.5 * THICK - float(shapely.distance(line, there))


def flood(walls: list[Wall], kept: float) -> bool:
    """Whether a disc gets to the goal, by a flood over a lattice of 5 cm."""
    x = np.arange(-6.0, 6.0, 0.05)
    places = shapely.points(*np.meshgrid(x, x))
    there = shapely.MultiLineString([(w[:2], w[2:]) for w in walls])
    shapely.prepare(there)
    areas, _ = label(~shapely.dwithin(places, there, kept + 0.5 * THICK))
    start, goal = (areas[round((b + 6) / 0.05), round((a + 6) / 0.05)] for a, b in ((0, 0), GOAL))
    return bool(start and start == goal)


def assert_it_goes_where_the_flood_goes(walls: list[Wall], run: Run) -> None:
    assert depth_of_touch(run, walls) < 0.0
    assert sum(beyond.until - beyond.since for beyond in run.excesses) <= 1e-3 * run.duration
    if flood(walls, RADIUS + 0.15):
        assert run.reached, run.reason
    elif not flood(walls, RADIUS):
        assert run.reason == "sees no way to 'goal'"
    assert run.reached or run.reason
    assert run.duration < 90.0


@pytest.mark.slow
@settings(max_examples=2, deadline=None, derandomize=True)
@given(
    depth=st.floats(1.0, 4.0),
    width=st.floats(1.0, 2.0),
    noise=st.sampled_from([0.0, 0.01]),
    shut=st.booleans(),
)
@example(depth=4.0, width=1.2, noise=0.01, shut=False)
def test_a_robot_gets_out_of_a_cup_unless_it_is_shut(
    depth: float, width: float, noise: float, shut: bool
) -> None:
    walls = cup(2.0 + depth, width)
    if shut:
        walls.append((-depth, 0.5 * width, -depth, -0.5 * width))
    assert_it_goes_where_the_flood_goes(walls, drive(walls, {}, noise))


@pytest.mark.slow
@pytest.mark.parametrize("kind", DRIVES)
def test_each_drive_gets_out_of_a_spiral_and_of_the_pockets_of_a_comb(kind: str) -> None:
    keys = DRIVES[kind]
    assert_it_goes_where_the_flood_goes(spiral(2, 1.4), drive(spiral(2, 1.4), keys, 0.01))
    keys = {**keys, "tracking_error_m": 0.1}  # at a stop it is that far beyond a corner
    assert_it_goes_where_the_flood_goes(comb(2, 2.0, 1.4), drive(comb(2, 2.0, 1.4), keys, 0.01))


@pytest.mark.parametrize(("work", "seed"), [(1e-2, 10), (1e-3, 7)])
def test_a_robot_that_has_no_time_to_search_stays_clear_and_gets_out_later(
    monkeypatch: pytest.MonkeyPatch, work: float, seed: int
) -> None:
    """It had stopped a hair behind where it was held, and then went on along a blocked path."""
    monkeypatch.setattr(deadline, "STEP_WORK_S", work)
    monkeypatch.setattr(deadline, "STANDING_WORK_S", work)
    walls = spiral(2, 1.4)
    run = drive(walls, {}, 0.01, seed)
    assert_it_goes_where_the_flood_goes(walls, run)
    assert all(replan.work <= deadline.MAX_STANDING_WORK_S for replan in run.replans)


LONGEST_DRIVE_S = 240.0
"""More than any of the drives to a closed door takes [s]."""


def drive_to_closed_door(jerk: float | None, sight: float, aside: float) -> Run:
    """A car that sees late that a door is closed; another one is open, but it can't turn there."""
    walls = [[-8.0, -2.8], [2.5, 30.0]]
    known = [{"polygon": [[-0.3, a], [0.3, a], [0.3, b], [-0.3, b]]} for a, b in walls]
    mission = Mission.model_validate(
        {
            "world": {
                "bounds": [-15, -8, 15, 40],
                "known": known,
                "unseen": [{"circle": {"center": [0, -0.15], "radius": 2.2}}],
            },
            "robot": {
                "clearance_m": 0.3, "max_speed_mps": 1.6, "max_lateral_accel_mps2": 0.8,
                "max_jerk_mps3": jerk,
                "drive": {"ackermann": {"wheelbase_m": 1.0, "max_steer_deg": 32.0},
                          "delay_s": 0.1, "lag_s": 0.1},
                "sensor": {"lidar": {"range_m": sight, "fov_deg": 120.0}},
            },
            "route": {"start": [-10.5, aside], "goal": [10.5, -2]},
        }
    )  # fmt: skip
    step = Navigator.step

    def timed(nav: Navigator, state: RobotState, sensed: Any, time: float) -> Any:
        assert time < LONGEST_DRIVE_S, "neither goes on nor says that it can't"
        return step(nav, state, sensed, time)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Navigator, "step", timed)
        return simulate(mission)


@pytest.mark.parametrize("jerk", [pytest.param(None, marks=pytest.mark.slow), 2.0])
def test_a_car_before_a_closed_door_says_that_it_finds_no_way_on(jerk: float | None) -> None:
    """With a limit of the jerk it had crept on by half a millimetre after every search."""
    run = drive_to_closed_door(jerk, 3.0, 1.16)
    assert not run.reached
    assert "turning circle" in str(run.reason)


@pytest.mark.slow
@settings(max_examples=4, deadline=None, derandomize=True)
@given(st.floats(0.5, 3.0), st.floats(3.0, 8.0), st.floats(-1.5, 1.5))
def test_a_car_before_a_closed_door_gets_on_or_says_that_it_cannot(
    jerk: float, sight: float, aside: float
) -> None:
    run = drive_to_closed_door(jerk, sight, aside)
    assert run.reached or run.reason
