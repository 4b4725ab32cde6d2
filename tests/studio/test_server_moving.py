"""What the page is told of what moves."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import viaspline as vs
from viaspline.report.space_time import kept_from_moving
from viaspline.world.moving_obstacles import MovingObstacles

START = Any

MISSION = """\
world:
  known:
    - {tracks: people.csv, radius_m: 0.3}
    - {name: rock, circle: {center: [15, 4], radius: 1}}
    - name: cart
      circle: {center: [0, 0], radius: 1}
      motion: {keyframes: [[0, 10, -8], [8, 10, 8]], after: bounce, error: {position_m: 0.1}}
  unseen:
    - {circle: {center: [0, 0], radius: 0.5}, motion: {from: [18, 9], velocity_mps: [0, -1]}}
    - {circle: {center: [22, 6], radius: 0.5}}
robot: {sensor: {range_m: 6}}
route: {start: [0, 0], goal: [25, 0], depart_s: 1, hold_s: 3}
"""
PEOPLE = "id,t,x,y\nann,0,5,2\nann,4,9,2\nbob,2,20,-3\nbob,9,20,3\n"


@pytest.fixture
def mission(tmp_path: Path) -> Path:
    (tmp_path / "people.csv").write_text(PEOPLE)
    file = tmp_path / "moving.yaml"
    file.write_text(MISSION)
    return file


def test_recorded_tracks_are_sent_as_items_of_a_document(start: START, mission: Path) -> None:
    with start(mission).client() as client:
        first, second = client.edit()["tracks"]
    assert (first["list"], first["item"], first["as"]["name"]) == ("known", 0, "ann")
    assert second["as"]["motion"]["keyframes"] == [[2, 20, -3], [9, 20, 3]]
    assert second["as"]["motion"]["before"] == "absent"
    assert second["as"]["circle"] == {"center": [0, 0], "radius": 0.3}


def test_the_plan_in_time_is_that_of_plan_json(start: START, mission: Path) -> None:
    with start(mission).client() as client:
        timing = client.edit()["timing"]
    plan = vs.plan(vs.load(mission))
    assert plan.timed is not None
    assert timing["certificate"]["clearance_m"] == plan.timed.certificate.clearance
    assert [one["lost_s"] for one in timing["waits"]] == [one.lost for one in plan.timed.waits]
    assert len(timing["candidates"]) == len(plan.timed.candidates)
    assert timing["items"] == {"ann": "known:0", "bob": "known:0", "cart": "known:2"}
    assert timing["holds_until"] == plan.trajectory.end_time + 3


def test_what_is_blocked_is_what_lies_nearer_than_is_kept(start: START, mission: Path) -> None:
    with start(mission).client() as client:
        client.edit()
        message = client.hear("space_time")
    plan = vs.plan(vs.load(mission))
    moving, required = MovingObstacles.known(plan.mission), kept_from_moving(plan)
    regions = {
        one["obstacle"]: shapely.union_all([
            shapely.Polygon(np.reshape(ring, (-1, 2))) for ring in one["rings"]
        ])
        for one in message["blocked"]
    }  # fmt: skip
    rng = np.random.default_rng(3)
    for s, t in rng.uniform((0, message["begin"]), (plan.path.length, message["end"]), (400, 2)):
        place = np.asarray(plan.path.at_distance([s]))[:, :2]
        for i, name in enumerate(moving.names):
            gap = float(moving.alone(i).distance(place, float(t))[0]) - required
            if abs(gap) > 0.25:  # the grid that is looked at is as coarse as that
                inside = name in regions and regions[name].contains(shapely.Point(s, t))
                assert inside == (gap < 0), (s, t, name)
    law = np.reshape(message["law"], (-1, 2))
    assert law[0].tolist() == [0, 1]
    assert law[-1, 1] == pytest.approx(plan.trajectory.end_time, abs=1e-3)


def test_a_run_tells_when_each_unseen_thing_was_first_in_reach(start: START, mission: Path) -> None:
    with start(mission).client() as client:
        client.edit()
        driven = client.ask("drive", "driven", seed=0)
    moving, standing = driven["sight"]["seen"]
    samples = driven["samples"]
    for seen, at in ((moving, lambda t: (18.0, 9.0 - t)), (standing, lambda t: (22.0, 6.0))):
        assert seen is not None
        k = int(np.searchsorted(samples["time"], seen))
        x, y = at(seen)
        away = np.hypot(samples["x"][k] - x, samples["y"][k] - y) - 0.5
        assert away == pytest.approx(6.0, abs=0.3)


def test_what_moves_blocks_the_beams_that_are_shown_and_leaves_no_points_behind(
    start: START, tmp_path: Path
) -> None:
    file = tmp_path / "beams.yaml"
    file.write_text(
        "world:\n  unseen:\n    - circle: {center: [0, 0], radius: 1}\n"
        "      motion: {from: [9, 4], velocity_mps: [0.2, 0.1]}\n"
        "robot: {max_speed_mps: 2, sensor: {lidar: {range_m: 8, fov_deg: 270, beams: 181}}}\n"
        "route: {start: [0, 0], goal: [20, 0]}\n"
    )
    with start(file).client() as client:
        client.edit()
        driven = client.ask("drive", "driven", seed=0)
    sight, samples = driven["sight"], driven["samples"]
    assert sight["hits"] == []
    blocked = 0
    for time, fan in zip(sight["times"], sight["fans"], strict=True):
        x, y, heading = (
            np.interp(time, samples["time"], samples[k]) for k in ("x", "y", "heading")
        )
        dx, dy = 9 + 0.2 * time - x, 4 + 0.1 * time - y
        bearing = np.arctan2(dy, dx) - heading
        beam = round((bearing - sight["first"]) / sight["step"])
        away = np.hypot(dx, dy) - 1
        if away < 7.9 and 0 <= beam < len(fan):
            assert fan[beam] == pytest.approx(away, abs=0.1)
            blocked += 1
    assert blocked > 50


def test_a_goal_that_is_taken_for_good_is_told_as_a_proof_and_not_as_given_up(
    start: START, mission: Path
) -> None:
    parked = {
        "name": "van",
        "circle": {"center": [0, 0], "radius": 2},
        "motion": {"keyframes": [[0, 40, 0], [4, 25, 0]], "after": "stay"},
    }
    with start(mission).client() as client:
        answer = client.edit([["world", "known", 3], parked])
    assert not answer["ok"]
    assert not answer["gave_up"]
    assert "van" in str(answer["problems"])
