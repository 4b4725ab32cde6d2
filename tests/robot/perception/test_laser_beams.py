"""Scans from LaserScan messages, as drivers really fill them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.state import RobotState

HERE = (0.0, 0.0, 0.0)
INF, NAN = math.inf, math.nan


def scan(ranges: object, first: float = 0.0, step: float = 0.1, **keys: object) -> Scan:
    pose = keys.pop("pose", HERE)
    return Scan.from_laserscan(ranges, first, step, 0.1, 5.0, pose, **keys)  # type: ignore[arg-type]


def test_what_was_not_measured_is_neither_free_nor_there() -> None:
    found = scan([NAN, -INF, 0.0, 0.05, 5.5, 65.5, INF, 5.0, 2.0, 0.1])
    nan = np.isnan(found.ranges)
    assert nan.tolist() == [True] * 6 + [False] * 4
    assert found.free.tolist() == [0.0] * 6 + [5.0, 5.0, 2.0, 0.1]
    assert len(found.hits) == 2


@given(
    ranges=st.lists(st.floats(0.2, 4.9), min_size=2, max_size=60),
    first=st.floats(-6.0, 6.0),
    step=st.floats(1e-3, 0.1),
    x=st.floats(-50, 50),
    heading=st.floats(-10, 10),
    mount=st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(-4, 4)),
)
def test_hits_are_where_the_beams_end(
    ranges: list[float],
    first: float,
    step: float,
    x: float,
    heading: float,
    mount: tuple[float, float, float],
) -> None:
    """By complex numbers, beam by beam, in both directions of turning."""
    pose = (x, -2.0 * x, heading)
    eye = complex(*pose[:2]) + complex(*mount[:2]) * np.exp(1j * heading)
    for turn in (step, -step):
        found = scan(ranges, first, turn, pose=pose, mount=mount)
        angles = heading + mount[2] + first + turn * np.arange(len(ranges))
        ends = eye + np.array(ranges) * np.exp(1j * angles)
        got = found.hits[:, 0] + 1j * found.hits[:, 1]
        if turn < 0.0:
            got = got[::-1]
        assert np.allclose(got, ends, atol=1e-7)
        assert found.angle_increment > 0.0


@pytest.mark.parametrize("turns", [1.0, 1.02, 2.0, 3.7])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_of_more_than_a_turn_the_last_one_counts(turns: float, sense: float) -> None:
    step = math.tau / 90
    count = round(90 * turns)
    ranges = np.linspace(1.0, 2.0, count)
    found = scan(ranges, 0.3, sense * step)
    assert len(found.ranges) == 90
    assert np.allclose(np.sort(found.ranges), ranges[-90:])
    newest = 0.3 + sense * step * (count - 1)
    directions = found.first_direction + found.angle_increment * np.arange(90)
    k = int(np.argmax(found.ranges))
    assert math.isclose(math.remainder(directions[k] - newest, math.tau), 0.0, abs_tol=1e-9)


def test_a_full_turn_in_32_bits_keeps_all_its_beams() -> None:
    step = float(np.float32(math.tau / 360))
    assert len(scan([1.0] * 360, -math.pi, step).ranges) == 360


@pytest.mark.parametrize("ranges", [[], [NAN], [NAN, -INF, 0.0, 9.0]])
def test_without_anything_measured_it_shows_nothing(ranges: list[float]) -> None:
    found = scan(ranges)
    assert found.shows_nothing
    assert len(found.hits) == 0
    assert found.free.max() == 0.0
    assert not scan([INF]).shows_nothing


def test_the_pose_may_be_a_state_and_intensities_are_not_looked_at() -> None:
    state = RobotState((1.0, 2.0), math.pi / 2, 0.3)
    found = scan([1.0], pose=state, mount=(0.5, 0.0, 0.0), intensities=object(), stamp=3)
    assert found.position == pytest.approx((1.0, 2.5))
    assert found.hits == pytest.approx(np.array([[1.0, 3.5]]))
    assert found.stamp == 3.0


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"ranges": [[1.0, 2.0]]}, "one for each beam"),
        ({"ranges": "far"}, "expected numbers"),
        ({"angle_min": NAN}, "angles of the beams"),
        ({"angle_increment": INF}, "angles of the beams"),
        ({"angle_increment": 0.0}, "what is between them"),
        ({"range_min": 5.0}, "range_min < range_max"),
        ({"range_min": -1.0}, "range_min < range_max"),
        ({"range_max": INF}, "range_min < range_max"),
        ({"pose": (0.0, 0.0)}, "three finite numbers"),
        ({"pose": (0.0, 0.0, NAN)}, "three finite numbers"),
        ({"mount": (0.0, "left", 0.0)}, "mount"),
        ({"stamp": NAN}, "stamp"),
    ],
)
def test_numbers_that_make_no_scan_are_refused(keys: dict[str, object], said: str) -> None:
    message = {
        "ranges": [1.0, 2.0],
        "angle_min": 0.0,
        "angle_increment": 0.1,
        "range_min": 0.1,
        "range_max": 5.0,
        "pose": HERE,
        **keys,
    }
    with pytest.raises(GeometryError, match=said):
        Scan.from_laserscan(**message)  # type: ignore[arg-type]
