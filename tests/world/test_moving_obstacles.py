"""Where moving obstacles are, and how far from them a place is, against numpy and shapely."""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.affinity import rotate, translate

from viaspline.errors import GeometryError, MissionWarning
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.moving_obstacles import MovingObstacles

DISC = {"circle": {"center": (0.0, 0.0), "radius": 1.0}}
BOX = {"polygon": [(-2.0, -1.0), (3.0, -1.0), (3.0, 1.0), (-2.0, 1.0)]}
FRAMES = [(1.0, 0.0, 0.0), (3.0, 4.0, 0.0), (4.0, 4.0, 2.0)]


def moved(motion: dict[str, Any], shape: dict[str, Any] = DISC) -> MovingObstacles:
    return MovingObstacles([Obstacle.model_validate({**shape, "motion": motion})])


def place(after: str, time: float, before: str | None = None) -> tuple[float, float] | None:
    """Where the frame is, by numpy alone."""
    t, x, y = np.array(FRAMES).T
    if after == "loop":
        time = t[0] + (time - t[0]) % (t[-1] - t[0])
    if after == "bounce":
        late = (time - t[0]) % (2 * (t[-1] - t[0]))
        time = t[0] + min(late, 2 * (t[-1] - t[0]) - late)
    if time > t[-1] and after == "vanish":
        return None
    if time < t[0] and (before == "absent" or (before is None and after == "vanish")):
        return None
    return float(np.interp(time, t, x)), float(np.interp(time, t, y))


@settings(max_examples=200, deadline=None)
@given(
    st.sampled_from(["loop", "bounce", "stay", "vanish"]),
    st.floats(-20, 20),
    st.floats(-9, 9),
    st.floats(-9, 9),
)
def test_the_distance_is_that_to_where_it_is_then(
    after: str, time: float, x: float, y: float
) -> None:
    moving = moved({"keyframes": FRAMES, "after": after})
    there = place(after, time)
    period = {"loop": 3.0, "bounce": 6.0}.get(after)
    if period is not None and abs((time - 1.0) / period - round((time - 1.0) / period)) < 1e-9:
        return  # at the seam either end will do
    if after == "vanish" and abs(time - FRAMES[-1][0]) < 1e-9:
        return  # there or not: it is gone from then on
    distance = moving.distance((x, y), time)[0]
    if there is None:
        assert distance == math.inf
    else:
        assert distance == pytest.approx(math.dist((x, y), there) - 1.0, abs=1e-9)


def test_what_comes_with_its_first_keyframe_is_not_there_before() -> None:
    moving = moved({"keyframes": FRAMES, "after": "stay", "before": "absent"})
    assert moving.distance((0, 0), 0.99)[0] == math.inf
    assert moving.distance((0, 0), 1.0)[0] == -1.0
    assert np.isnan(moving.frames(0.5)).all()


@settings(max_examples=100, deadline=None)
@given(st.floats(0, 9), st.floats(-9, 9), st.floats(-9, 9))
def test_a_polygon_turns_with_its_frame(time: float, x: float, y: float) -> None:
    frames = [(0.0, 1.0, 2.0, 10.0), (10.0, 5.0, -3.0, 250.0)]
    moving = moved({"keyframes": frames, "after": "stay"}, BOX)
    share = time / 10.0
    shape = rotate(shapely.Polygon(BOX["polygon"]), 10.0 + 240.0 * share, origin=(0.0, 0.0))
    shape = translate(shape, 1.0 + 4.0 * share, 2.0 - 5.0 * share)
    point = shapely.Point(x, y)
    outside = shapely.distance(shape, point)
    truth = outside if outside > 0 else -shapely.distance(shape.exterior, point)
    assert moving.distance((x, y), time)[0] == pytest.approx(truth, abs=1e-9)


def test_an_error_is_taken_off_and_grows_from_when_it_is_known() -> None:
    obstacle = Obstacle.model_validate(
        {
            **DISC,
            "motion": {
                "from": (0, 0),
                "velocity_mps": (0, 0),
                "error": {"position_m": 0.5, "growth_mps": 0.1},
            },
        }
    )
    known = MovingObstacles([obstacle])
    assert known.distance([(5, 0)] * 3, [-10, 0, 20]).tolist() == [3.5, 3.5, 1.5]
    later = MovingObstacles([obstacle], since=10.0)
    assert later.distance([(5, 0)] * 2, [10, 20]).tolist() == [3.5, 2.5]


def test_no_point_of_it_is_faster_than_is_said() -> None:
    frames = [(0.0, 0.0, 0.0, 0.0), (2.0, 3.0, 0.0, 90.0)]
    moving = moved({"keyframes": frames, "after": "bounce"}, BOX)
    far = math.hypot(3.0, 1.0)
    assert moving.top_speed == pytest.approx(1.5 + far * math.pi / 4.0)
    assert MovingObstacles().top_speed == 0.0


def test_two_that_look_alike_are_two() -> None:
    obstacle = Obstacle.model_validate({**DISC, "motion": {"from": (0, 0), "velocity_mps": (1, 0)}})
    moving = MovingObstacles([obstacle, obstacle])
    assert len(moving) == 2
    assert moving.names == ("moving obstacle 1", "moving obstacle 2")


def test_a_hundred_thousand_keyframes_are_looked_up_at_once() -> None:
    frames = [(float(k), float(k % 7), 0.0) for k in range(100_000)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MissionWarning)
        moving = moved({"keyframes": frames, "after": "loop"})
    assert moving.distance((0, 0), 3.0)[0] == pytest.approx(2.0)


def test_what_makes_no_sense_is_refused_in_words() -> None:
    standing = Obstacle.model_validate(DISC)
    with pytest.raises(GeometryError, match="doesn't move"):
        MovingObstacles([standing])
    moving = moved({"from": (0, 0), "velocity_mps": (1, 0)})
    for points, times in (((math.nan, 0), 0.0), ((0, 0), math.inf), ([(0, 0)] * 2, [0, 1, 2])):
        with pytest.raises(GeometryError):
            moving.distance(points, times)


def test_a_keyframe_without_a_heading_has_that_of_the_one_before() -> None:
    frames = [(0.0, 0.0, 0.0), (1.0, 1.0, 0.0, 90.0), (2.0, 2.0, 0.0), (3.0, 3.0, 0.0, 0.0)]
    moving = moved({"keyframes": frames, "after": "stay"}, BOX)
    headings = [float(np.degrees(moving.frames(t)[0, 2])) for t in (-1, 0.5, 1.0, 1.5, 2.5, 4)]
    assert headings == pytest.approx([0, 45, 90, 90, 45, 0])


def test_some_of_them_and_others_are_what_they_would_be_if_they_were_made_at_once() -> None:
    """They are put together in every step under way: what was looked at isn't looked at again."""
    made = [
        Obstacle.model_validate({"circle": {"center": (0, 0), "radius": 1}, "motion": motion})
        for motion in (
            {"keyframes": [(0, 1, 2), (4, 5, 2, 90), (5, 5, 3)], "after": "bounce"},
            {"from": (3, 4), "velocity_mps": (1, 0), "error": {"growth_mps": 0.5}},
            {"keyframes": [(0, 9, 2)], "after": "vanish"},
        )
    ]
    whole = MovingObstacles(made, since=(1.0, 2.0, 3.0))
    joined = MovingObstacles(made[:1], since=1.0).and_those(
        MovingObstacles(made[1:], since=(2.0, 3.0))
    )
    assert joined == whole
    parts = {
        whole: joined,
        MovingObstacles(made[:2], since=(1.0, 2.0)): joined.first(2),
        MovingObstacles(made[1:], since=(2.0, 3.0)): joined.from_on(1),
        MovingObstacles(made[1:2], since=2.0): joined.alone(1),
    }
    for expected, found in parts.items():
        assert found == expected
        for one, other in zip(expected.packed[1:], found.packed[1:], strict=True):
            assert one.tolist() == other.tolist()
        times = np.linspace(0.0, 9.0, 20)
        places = np.tile((4.0, 3.0), (20, 1))
        assert found.distance(places, times).tolist() == expected.distance(places, times).tolist()
    assert joined.first(3) is joined
    assert MovingObstacles().and_those(whole) == whole


def test_those_that_go_on_and_those_that_end_are_packed_side_by_side_as_each_alone() -> None:
    frames = [[0.0, 1.0, 2.0, 30.0], [2.0, 3.0, 2.0], [5.0, 3.0, 6.0, 90.0]]
    ways: list[dict[str, object]] = [
        {"keyframes": frames, "after": after, **more}
        for after, more in (
            ("loop", {}), ("bounce", {}), ("stay", {}), ("vanish", {}),
            ("stay", {"before": "absent"}), ("vanish", {"before": "stay"}),
        )
    ]  # fmt: skip
    ways += [
        {"from": [1.0, 2.0], "velocity_mps": [0.5, -1.0]},
        {"keyframes": [[3, 1, 1]], "after": "stay"},
    ]
    carts = [
        Obstacle(polygon=[(0, 0), (1, 0), (0, 0.5)], motion=motion)  # type: ignore[arg-type]
        for motion in ways
    ]
    together = MovingObstacles(carts)
    for time in (-4.0, -1e-3, 0.0, 1.0, 2.0, 4.9, 5.0, 7.3, 11.0):
        places = together.frames(time)
        for i in range(len(carts)):
            alone = MovingObstacles([carts[i]]).frames(time)[0]
            np.testing.assert_array_equal(places[i], alone)
    looped, bounced = MovingObstacles(carts[:1]), MovingObstacles(carts[1:2])
    np.testing.assert_allclose(looped.frames(6.0), looped.frames(1.0), atol=1e-12)
    np.testing.assert_allclose(bounced.frames(6.0), bounced.frames(4.0), atol=1e-12)
    assert np.isnan(together.frames(6.0)[3]).all()
    assert np.isnan(together.frames(-1.0)[4]).all()
    assert together.frames(-1.0)[5, :2].tolist() == [1.0, 2.0]
    assert together.frames(2.0)[6, :2].tolist() == [2.0, 0.0]
