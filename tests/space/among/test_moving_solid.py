"""What moves in space, as a way in time."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.mission.motion_spec import Motion
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.space.among.moving_solid import HIGH_M, MovingSolid

BALL = {"center": (0.0, 0.0, 0.0), "radius": 1.0}


def moving(begin: float, end: float, **motion: Any) -> MovingSolid:
    return MovingSolid.of(Obstacle(ball=BALL, motion=motion), "ball", begin, end)  # type: ignore[arg-type]


def at(solid: MovingSolid, time: float) -> list[float]:
    return [float(np.interp(time, solid.times, solid.places[:, k])) for k in range(3)]


@given(time=st.floats(0, 40))
def test_what_bounces_is_where_it_was_on_its_way_back(time: float) -> None:
    solid = moving(0, 40, keyframes=[(1, 0, 0, 0, 2), (4, 6, 3, 0, 8)], after="bounce")
    phase = (time - 1) % 6
    share = min(phase, 6 - phase) / 3
    assert at(solid, time) == pytest.approx([6 * share, 3 * share, 2 + 6 * share], abs=1e-6)
    assert solid.there.all()


def test_what_loops_and_jumps_is_not_there_for_a_moment() -> None:
    solid = moving(0, 9.5, keyframes=[(0, 0, 0, 0, 2), (3, 6, 0, 0, 2)], after="loop")
    assert at(solid, 4.0)[0] == pytest.approx(2.0, abs=1e-4)
    away = np.diff(solid.times)[~solid.there[:-1]]
    assert len(away) == 3
    assert (away < 1e-5).all()
    assert (np.diff(solid.times) > 0).all()


def test_before_and_after_keyframes_it_stands_or_isnt_there() -> None:
    frames = [(2, 0, 0, 0, 2), (3, 6, 0, 0, 2)]
    stays = moving(0, 9, keyframes=frames, after="stay")
    assert stays.there.all()
    assert at(stays, 0.5)[0] == 0.0
    assert at(stays, 8.0)[0] == 6.0
    gone = moving(0, 9, keyframes=frames, after="vanish")
    there = {t: bool(gone.there[np.searchsorted(gone.times, t, side="right") - 1])
             for t in (1.0, 2.5, 4.0)}  # fmt: skip
    assert there == {1.0: False, 2.5: True, 4.0: False}
    assert moving(0, 9, keyframes=frames, after="vanish", before="stay").there[0]


def test_a_keyframe_without_a_height_has_that_of_the_one_before() -> None:
    solid = moving(0, 9, keyframes=[(0, 0, 0, 0, 5), (4, 8, 0)], after="stay")
    assert at(solid, 4.0) == pytest.approx([8, 0, 5])


def test_a_shape_is_held_by_its_cylinder() -> None:
    still = Motion(from_=(0, 0), velocity_mps=(1, 0))
    box = Obstacle.model_validate({"box": {"min": [2, 0, 5], "max": [8, 8, 9]}, "motion": still})
    solid = MovingSolid.of(box, "box", 0, 1)
    assert solid.body == pytest.approx((5.0, 2.0, 0.0))
    assert solid.places[0].tolist() == [5.0, 4.0, 7.0]
    turning = Motion(keyframes=((0, 0, 0, 0), (9, 0, 0, 90)), after="stay")
    arm = Obstacle.model_validate({"box": {"min": [2, 0, 5], "max": [8, 6, 9]}, "motion": turning})
    assert MovingSolid.of(arm, "arm", 0, 1).body == pytest.approx((10.0, 2.0, 0.0))


def test_what_has_no_heights_is_at_every_height() -> None:
    motion = Motion(from_=(0, 0), velocity_mps=(1, 0))
    disc = Obstacle.model_validate({"circle": {"center": [0, 0], "radius": 2}, "motion": motion})
    radius, half, margin = MovingSolid.of(disc, "disc", 0, 1).body
    assert (radius, margin) == (2.0, 0.0)
    assert half >= HIGH_M


def test_what_gets_less_certain_is_farther_off_later() -> None:
    solid = moving(0, 9, **{"from": (0, 0, 5)}, velocity_mps=(1, 0, 0),
                   error={"position_m": 0.2, "growth_mps": 0.1})  # fmt: skip
    assert (np.diff(solid.times) <= 1.0 + 1e-9).all()
    assert solid.off[0] == pytest.approx(0.3)
    assert solid.off[-1] == pytest.approx(1.1)


@given(seed=st.integers(0, 100_000))
def test_a_part_of_it_is_where_all_of_it_is(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows = rng.uniform(-9, 9, (4, 3))
    frames = [[t, *row, 0] for t, row in zip([0, 2, 3, 7], rows[:, :2].tolist(), strict=True)]
    motion = {"keyframes": frames, "after": str(rng.choice(["loop", "bounce", "stay", "vanish"]))}
    one = MovingSolid.of(
        Obstacle(ball={"center": (0, 0, 0), "radius": 1}, motion=motion), "one", 1.0, 20.0
    )
    begin, end = np.sort(rng.uniform(-3, 24, 2)).tolist()
    part = one.between(begin, end)
    first, last = np.clip([begin, end], one.times[0], one.times[-1]).tolist()
    assert (part.times[0], part.times[-1]) == (first, max(first, last))
    times = rng.uniform(first, last, 50)
    np.testing.assert_allclose(part.at(times), one.at(times), atol=1e-9)
    np.testing.assert_array_equal(part.off_at(times), one.off_at(times))
