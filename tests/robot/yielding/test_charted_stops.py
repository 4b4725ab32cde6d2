"""A robot that may have to stop at any time doesn't do so in the way of what moves by the map."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from charted_movers import Floats, Mover, least_gaps
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.curve.path import Path
from viaspline.robot.simulation.driven_step import DrivenStep
from viaspline.robot.yielding.certified_stop import (
    StopAsked,
    certified_stop,
    kept_or_stopped,
    left_alone_until,
    stay_meant,
)
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.passive_premises import PassivePremises
from viaspline.trajectory.passive_safety import passive_law
from viaspline.trajectory.retime import braking, retime
from viaspline.world.moving_obstacles import MovingObstacles

RADIUS, STEP = 0.2, 0.1
LIMITS = Limits(max_speed=1.0, max_accel=0.5)
SPANS = [[(x, 0.0) for x in (0, 2, 4, 6)]]


@cache
def path() -> Path:
    return Path(SPANS, [])


def crossing(begin: float, lasts: float, at: tuple[float, float]) -> Mover:
    """A cart that comes across the robot's way, from one place of it to another [m]."""
    frames = [[begin, at[0], -3.0], [begin + lasts, at[1], 3.0]]
    motion = {"keyframes": frames, "after": "stay"}
    return {"name": "cart", "circle": {"center": [0, 0], "radius": 0.4}, "motion": motion}


def hidden(sides: tuple[float, float, float], x: float) -> Mover:
    """Something that nobody knows of, which comes towards the robot's way and goes again."""
    frames = [[0, 5.0, sides[0]], [3, x, sides[1]], [9, 5.0, sides[2]]]
    motion = {"keyframes": frames, "after": "bounce"}
    return {"name": "ghost", "circle": {"center": [0, 0], "radius": 0.2}, "motion": motion}


def mission(known: list[Mover], unseen: list[Mover], sight: float, **route: Any) -> vs.Mission:
    robot = {
        "radius_m": RADIUS,
        "clearance_m": 0.1,
        "max_speed_mps": 1,
        "max_accel_mps2": 0.5,
        "sensor": {"range_m": sight},
        "moving": {"max_speed_mps": 1, "safety": "passive"},
    }
    route = {"start": [0, 0], "goal": [3, 0], **route}
    carts = [{**cart, "name": f"cart {i}"} for i, cart in enumerate(known)]
    world = {"known": carts, "unseen": unseen}
    return vs.Mission.model_validate({"world": world, "robot": robot, "route": route})


def driven(asked: vs.Mission) -> tuple[vs.Run, Floats]:
    """A run, and t, x, y and speed of the robot every 20 ms, by what it meant at each step."""
    rows: list[tuple[float, float, float, float]] = []

    def watch(step: DrivenStep) -> None:
        for time in (step.time + np.linspace(0.0, STEP, 6)).tolist():
            state = step.nav.reference(time)
            rows.append((time, *state.position, state.speed))

    run = vs.simulate(asked, step=STEP, watch=watch)
    return run, np.array(rows)


def fastest_touch(movers: list[Mover], rows: Floats) -> float:
    """How fast the robot is at most while something touches it [m/s]."""
    touched = least_gaps(movers, rows[:, 0], rows[:, 1:3], RADIUS) < 0.0
    return float(rows[touched, 3].max(initial=0.0))


def test_it_doesnt_creep_into_the_way_of_what_it_knows_to_come() -> None:
    """It stopped there at 0.1 m/s for what may come unseen, and had meant to be past by then."""
    cart, ghost = crossing(1.0, 8.6, (1.7, 0.9)), hidden((0.3, 0.9, 0.0), 3.6)
    run, rows = driven(mission([cart], [ghost], 1.3))
    assert run.reached
    assert least_gaps([cart, ghost], rows[:, 0], rows[:, 1:3], RADIUS).min() > 0.0
    assert run.encounters is not None
    assert run.encounters.contacts == ()


sides = st.floats(-2.0, 2.0).map(lambda side: round(side, 1))


@pytest.mark.slow
@given(
    st.lists(
        st.builds(
            crossing,
            st.floats(-2.0, 4.0),
            st.floats(4.0, 15.0),
            st.tuples(st.floats(0.8, 2.6), st.floats(0.8, 2.6)),
        ),
        min_size=1,
        max_size=2,
    ),
    st.builds(hidden, st.tuples(sides, sides, sides), st.floats(3.2, 5.0)),
    st.floats(0.8, 2.5),
)
@settings(max_examples=12)
def test_nothing_touches_it_while_it_moves(carts: list[Mover], ghost: Mover, sight: float) -> None:
    """Whatever comes unseen, and known things as well: tried by samples against shapely."""
    try:
        run, rows = driven(mission(carts, [ghost], sight))
    except vs.PlanningError:
        return  # the carts leave it no way
    assert fastest_touch([*carts, ghost], rows) < 1e-3
    assert run.encounters is not None
    assert all(contact.robot_speed == 0.0 for contact in run.encounters.contacts)


def asked_for(cart: Mover, reach: float, now: float = 0.0) -> StopAsked:
    upper = retime(path(), LIMITS, start_time=now)
    known = MovingObstacles([vs.Obstacle.model_validate(cart)])
    premises = PassivePremises(MovingObstacles(), now, 1.0, (0.0, 0.0), reach, charted=known)
    return StopAsked(path(), upper, premises, RADIUS, (0.5, 0.5), now, meant_stay=0.0)


def test_it_goes_on_for_a_moment_where_nothing_comes_to_its_stop() -> None:
    law = certified_stop(asked_for(crossing(30.0, 5.0, (3.0, 3.0)), math.inf))
    assert law is not None
    assert 0.4 < law.distances[-1] < 0.8  # a second, and then it brakes


def test_it_stops_before_the_way_of_what_comes_if_it_sees_too_little_to_pass() -> None:
    asked = asked_for(crossing(0.0, 10.0, (0.8, 0.8)), 2.5)
    law = certified_stop(asked)
    assert law is not None
    assert left_alone_until(asked, law) == math.inf
    assert law.distances[-1] < 0.8 - 0.4 - RADIUS


def test_it_goes_through_that_in_one_go_if_it_sees_far_enough() -> None:
    asked = asked_for(crossing(0.0, 14.0, (0.8, 0.8)), math.inf)
    law = certified_stop(asked)
    assert law is not None
    assert law.distances[-1] > 0.8 + 0.4 + RADIUS
    assert left_alone_until(asked, law) == math.inf


def test_in_the_way_of_what_comes_it_keeps_to_a_law_that_leads_out_of_it() -> None:
    """What it sees now doesn't prove another one, but a look before has proven that to its end."""
    cart = crossing(0.0, 9.0, (1.6, 1.6))
    far = asked_for(cart, math.inf)
    through, _ = passive_law(path(), far.upper, far.premises, RADIUS, far.limits, 0.0)
    now, speed = float(through.time_at(0.8)), float(through.speed_at(0.8))
    later = retime(path(), LIMITS, start=0.8, start_time=now, start_speed=speed)
    near = replace(asked_for(cart, 0.9, now), upper=later)
    assert certified_stop(near) is None
    stop = braking(0.8, speed, 0.5, now)
    assert kept_or_stopped(near, stop) is stop
    assert kept_or_stopped(replace(near, proven=through), stop) is through
    short = replace(near, proven=through, upper=stop)
    assert kept_or_stopped(short, stop) is stop  # something stands where that law ends


def test_it_stays_at_a_station_and_at_its_goal_for_as_long_as_it_means_to() -> None:
    law = retime(path(), LIMITS, [Station(2.0, 1.5)])
    assert stay_meant(law, path(), 0.5, hold=7.0) == pytest.approx(1.5)
    assert stay_meant(law, path(), 2.5, hold=7.0) == 7.0


def test_it_leaves_a_station_by_a_law_that_is_proven() -> None:
    """Its plan went on from there at once, in the time until the next look."""
    asked = mission([], [], 0.4, start={"at": [0, 0], "dwell_s": 0.55}, goal=[0.1, 0.0])
    run, rows = driven(asked)
    assert run.reached
    assert rows[rows[:, 0] <= 0.6, 3].max() == 0.0
    assert rows[:, 3].max() < 0.2
