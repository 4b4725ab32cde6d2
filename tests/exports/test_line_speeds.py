"""Speeds that are set for lines: a vehicle that keeps them is nowhere faster than the plan."""

from itertools import pairwise

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.exports.line_speeds import SAME_SPEED, SettableSpeeds, set_speeds
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime

numbers = st.floats(-30, 30).map(lambda x: round(x, 1))


@settings(max_examples=12, deadline=None)
@given(st.lists(st.tuples(numbers, numbers), min_size=3, max_size=6, unique=True))
def test_a_vehicle_that_keeps_what_is_set_is_nowhere_faster_than_the_plan(
    points: list[tuple[float, float]],
) -> None:
    curve = CardinalSpline(points)
    limits = Limits(max_speed=3.0, max_accel=0.8)
    law = retime(curve, limits, [Station(0.4 * curve.length, 5.0)])
    settable = SettableSpeeds(law, 0.8, 0.8)
    ends = np.unique(np.r_[np.linspace(0, curve.length, 23), 0.4 * curve.length])
    told = [settable.of_line(a, b) for a, b in pairwise(ends)]
    at = np.linspace(0, curve.length, 4001)
    line = np.clip(np.searchsorted(ends, at, side="right") - 1, 0, len(told) - 1)
    square, driven = 0.0, np.zeros(len(at))
    rests = {int(np.argmin(np.abs(at - stop))) for stop in (0.4 * curve.length, curve.length)}
    for i in range(1, len(at)):
        square = min(square + 2 * 0.8 * (at[i] - at[i - 1]), told[line[i]] ** 2)
        driven[i] = np.sqrt(square)
        square = 0.0 if i in rests else square
    planned = np.asarray(law.speed_at(at))
    braking = np.zeros(len(at), bool)  # the vehicle brakes to its rests by itself
    for rest in rests:
        braking |= (at <= at[rest] + 0.1) & (at[rest] - at <= 3.0**2 / (2 * 0.8) + 0.2)
    creeping = np.array(told)[line] > 1.01 * np.array(
        [settable.least(ends[k], ends[k + 1]) for k in line]
    )
    assert (driven <= planned * 1.02 + 0.05)[~braking & ~creeping].all()


@settings(max_examples=12, deadline=None)
@given(
    st.lists(st.tuples(numbers, numbers), min_size=3, max_size=6, unique=True),
    st.sampled_from([0.2, 0.5, 2.0]),
)
@example([(0.0, 0.0), (10.0, 0.0), (10.0, 4.0), (30.0, 4.0)], 0.5)
def test_with_a_limit_of_the_jerk_it_is_hardly_faster_either(
    points: list[tuple[float, float]], max_jerk: float
) -> None:
    curve = CardinalSpline(points)
    law = retime(curve, Limits(max_speed=3.0, max_accel=0.8, max_jerk=max_jerk))
    settable = SettableSpeeds(law, 0.8, 0.8, max_jerk)
    ends = np.linspace(0, curve.length, 40)
    told = [settable.of_line(a, b) for a, b in pairwise(ends)]
    place, speed, accel, step = 0.0, 0.0, 0.0, 0.01
    limits = [np.array(law.speed_at(np.linspace(a, b, 40))).max() for a, b in pairwise(ends)]
    for _ in range(int(3 * law.duration / step)):
        line = int(np.searchsorted(ends, place, side="right")) - 1
        if line >= len(told):
            break
        rest = curve.length - place
        if rest < 3.0**2 / 1.6 + 3.0 * 0.8 / max_jerk + 0.2:
            break  # the vehicle brakes to its rest by itself
        creeping = told[line] > 1.01 * settable.least(ends[line], ends[line + 1])
        assert speed <= 1.1 * limits[line] + 0.1 or creeping
        # As hard as the jerk lets it, with the acceleration back at 0 at the speed it is told.
        missing = told[line] - speed
        wish = float(np.copysign(min(np.sqrt(2 * max_jerk * abs(missing)), 0.8), missing))
        accel += float(np.clip(wish - accel, -max_jerk * step, max_jerk * step))
        if missing < 0.0:
            accel, speed = 0.0, max(told[line], speed - 0.8 * step)
        speed = max(speed + accel * step, 1e-3)
        place += speed * step


@given(st.lists(st.floats(0.1, 5.0), min_size=1, max_size=30))
def test_no_line_gets_more_than_it_may_nor_much_less(speeds: list[float]) -> None:
    found = set_speeds(np.array(speeds))
    assert (found <= speeds).all()
    assert (found * SAME_SPEED >= np.array(speeds) - 1e-12).all()
