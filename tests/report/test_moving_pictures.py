"""What moves, on pictures, in films and in files."""

from __future__ import annotations

import json

import numpy as np
import pytest

import viaspline as vs
from viaspline.report.animation import frames
from viaspline.report.files.plan_json import plan_json
from viaspline.report.files.run_json import run_json
from viaspline.report.moving_film import arrow_line
from viaspline.report.moving_marks import trails
from viaspline.report.plan_picture import plan_picture
from viaspline.report.run_picture import run_picture
from viaspline.report.space_time import SpaceTime
from viaspline.world.moving_obstacles import MovingObstacles


@pytest.fixture(scope="module")
def run() -> vs.Run:
    box = [[-1, -0.5], [1, -0.5], [1, 0.5], [-1, 0.5]]
    mission = vs.Mission.model_validate(
        {
            "world": {
                "known": [
                    {
                        "name": "cart",
                        "polygon": box,
                        "motion": {
                            "keyframes": [[0, 10, -9, 90], [9, 10, 9, 90]],
                            "after": "bounce",
                        },
                    },
                    {"name": "rock", "circle": {"center": [14, 1], "radius": 1}},
                    {
                        "name": "guest",
                        "circle": {"center": [0, 0], "radius": 0.4},
                        "motion": {"keyframes": [[2, 5, 3], [4, 5, 8]], "after": "vanish"},
                    },
                ]
            },
            "route": {"start": [0, 0], "goal": [20, 0], "hold_s": 2.0},
        }
    )
    return vs.simulate(mission)


def test_the_files_tell_what_is_proven_and_what_was_tried(run: vs.Run) -> None:
    data = json.loads(plan_json(run.plan, "x", spacing=0.5))
    moving = data["certificate"]["moving"]
    assert moving["holds"]
    assert moving["clearance_m"] >= 0.5 - 1e-6
    assert moving["obstacle"] in ("cart", "guest")
    candidates = data["among_moving"]["candidates"]
    assert sum(one["chosen"] for one in candidates) == 1
    driven = json.loads(run_json(run, "x"))
    assert driven["contacts"] == []
    assert driven["moving"]["min_clearance_m"] > 0.45


def test_pictures_are_drawn_the_same_each_time(run: vs.Run) -> None:
    assert plan_picture(run.plan, "x") == plan_picture(run.plan, "x")
    assert run_picture(run, "x") == run_picture(run, "x")


def test_a_film_shows_it_move(run: vs.Run) -> None:
    first, middle, last = frames(run, "x", 3)
    assert first.shape == middle.shape == last.shape
    assert (first != middle).any()


def test_an_arrow_ends_in_a_head_that_is_even_and_no_longer_than_half_of_it() -> None:
    rng = np.random.default_rng(4)
    for _ in range(50):
        arrow, head = rng.uniform(-3, 3, 4), float(rng.uniform(0.1, 3))
        begin, end, left, again, right = arrow_line(arrow, head)
        assert begin == pytest.approx(arrow[:2])
        assert end == pytest.approx(arrow[:2] + arrow[2:])
        assert (end == again).all()
        length = np.hypot(*arrow[2:])
        barbs = [np.hypot(*(end - barb)) for barb in (left, right)]
        assert barbs == pytest.approx([min(head, length / 2)] * 2)
        assert np.hypot(*(begin - left)) == pytest.approx(np.hypot(*(begin - right)))
        assert np.hypot(*(begin - left)) < length


def test_trails_end_where_something_jumps_or_goes() -> None:
    mission = vs.Mission.model_validate(
        {
            "world": {
                "known": [
                    {
                        "circle": {"center": [0, 0], "radius": 1},
                        "motion": {"keyframes": [[0, 0, 0], [4, 8, 0], [8, 0, 0]], "after": "loop"},
                    },
                    {
                        "circle": {"center": [0, 0], "radius": 1},
                        "motion": {"keyframes": [[2, 0, 5], [4, 8, 5]], "after": "vanish"},
                    },
                ]
            },
            "route": {"start": [0, -9], "goal": [9, -9]},
        }
    )
    round_trip, short = trails(MovingObstacles.known(mission), 0.0, 10.0)
    assert np.ptp(round_trip[:, 0]) == pytest.approx(8.0, abs=0.1)
    assert len(short) < 50


def test_the_panel_says_how_much_room_there_is_where_and_when(run: vs.Run) -> None:
    moving = MovingObstacles.known(run.plan.mission)
    shown = SpaceTime(run.plan.path, moving, 1.0, 0.0, 12.0)
    distances, times, gaps = shown.gaps()
    i, k = 100, 60
    place = np.asarray(run.plan.path.at_distance(distances[i]))[:2]
    assert gaps[k, i] == pytest.approx(float(moving.distance(place, times[k])[0]) - 1.0)
