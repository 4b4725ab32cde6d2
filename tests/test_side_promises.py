"""The side that is asked for is the side that is driven: by every robot, route and re-plan.

The oracle knows nothing of the planner. It walks along dense points of a path and adds up the angle
that it sweeps about a place inside of an obstacle: a path that leaves it on the robot's right turns
clockwise about it. Between the same two ends that angle tells the sides apart by a full turn.
"""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.curve.path import Path
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.replanning import replan

seeds = st.integers(0, 1_000_000)
REQUIRED_M = 1.0  # radius and clearance of every robot here
ROBOTS: dict[str, dict[str, Any]] = {
    "point": {"radius_m": 0.0, "clearance_m": 1.0},
    "disc": {"radius_m": 0.5, "clearance_m": 0.5},
    "circle": {"radius_m": 0.5, "clearance_m": 0.5, "min_turn_radius_m": 1.0},
    "car": {
        "footprint": [[-0.5, -0.5], [1.5, -0.5], [1.5, 0.5], [-0.5, 0.5]],
        "clearance_m": 0.5,
        "min_turn_radius_m": 3.0,
    },
    "body": {"footprint": [[-1, -0.5], [1, -0.5], [1, 0.5], [-1, 0.5]], "clearance_m": 0.5},
    "differential": {
        "radius_m": 0.5, "clearance_m": 0.5, "tracking_error_m": 0.05,
        "drive": {"differential": {"track_m": 0.5}},
    },
    "omnidirectional": {
        "radius_m": 0.5, "clearance_m": 0.5, "tracking_error_m": 0.05,
        "drive": {"omnidirectional": {"max_speed_along_mps": 1.5, "max_speed_across_mps": 1.0}},
    },
    "steered": {
        "radius_m": 0.5, "clearance_m": 0.5, "tracking_error_m": 0.05,
        "drive": {"ackermann": {"wheelbase_m": 1.2, "max_steer_deg": 25}},
    },
}  # fmt: skip


def random_shape(rng: np.random.Generator, x: float, y: float, most: float) -> dict[str, Any]:
    radius = rng.uniform(0.3, most)
    if rng.random() < 0.6:
        return {"circle": {"center": [x, y], "radius": radius}}
    corners = int(rng.integers(3, 7))
    angle = np.arange(corners) * math.tau / corners + rng.uniform(0, 0.5, corners)
    return {"polygon": np.column_stack((x + radius * np.cos(angle), y + radius * np.sin(angle)))
            .tolist()}  # fmt: skip


def asked_for(rng: np.random.Generator, obstacle: dict[str, Any], name: str) -> dict[str, Any]:
    key, side = str(rng.choice(["pass_on", "never_pass_on"])), str(rng.choice(["left", "right"]))
    return obstacle | {"name": name, key: side}


def random_case(seed: int, robot: str) -> vs.Mission | None:
    """Buoys along a route of one to three legs, open or closed; None where they cover its ends."""
    rng = np.random.default_rng(seed)
    body = dict(ROBOTS[robot])
    if robot == "circle":
        body["min_turn_radius_m"] = float(rng.choice([0.5, 1.0, 2.0, 3.5, 5.0, 6.5, 8.0]))
    count = int(rng.integers(2, 4)) + (closed := bool(rng.random() < 0.3))
    angle = np.arange(count) * math.tau / count + rng.uniform(-0.3, 0.3, count)
    stops = 30.0 * np.column_stack((np.cos(angle), np.sin(angle)))
    known: list[dict[str, Any]] = []
    for k, (a, b) in enumerate(itertools.pairwise([*stops, *stops[: int(closed)]])):
        for w in ([0.5], [0.35, 0.65])[rng.random() < 0.4]:
            x, y = a + w * (b - a) + rng.normal(0, 1.2, 2)
            known.append(asked_for(rng, random_shape(rng, x, y, 3.0), f"buoy {k} {w}"))
            if rng.random() < 0.25:
                known.append(random_shape(rng, x + rng.normal(0, 6), y + rng.normal(0, 6), 3.0))
    unseen = []
    for obstacle in known[: 2 if rng.random() < 0.5 else 0]:
        x, y = shape_of(vs.Obstacle(**obstacle)).centroid.coords[0]
        place = np.array([x, y]) + rng.normal(0, 4, 2)
        unseen.append(random_shape(rng, *place, 1.5))
    via: list[Any] = stops[1 : len(stops) if closed else -1].tolist()
    if via and rng.random() < 0.3:
        via[0] = {"at": via[0], "dwell_s": 1.0}
    route: dict[str, Any] = {"start": {"at": stops[0].tolist()}, "via": via, "closed": closed}
    if not closed:
        route["goal"] = {"at": stops[-1].tolist()}
    try:
        return vs.Mission.model_validate({
            "world": {"known": known, "unseen": unseen},
            "robot": body | {"sensor": {"range_m": 9.0}},
            "route": route,
        })  # fmt: skip
    except vs.MissionError:
        return None


def shape_of(obstacle: vs.Obstacle) -> Any:
    if obstacle.circle is not None:
        return shapely.Point(obstacle.circle.center).buffer(obstacle.circle.radius, 64)
    return shapely.Polygon(obstacle.polygon)


def swept(points: Any, about: Any) -> float:
    """The angle that a line sweeps about a place [rad]."""
    off = np.asarray(points)[:, :2] - about
    turns = np.diff(np.unwrap(np.arctan2(off[:, 1], off[:, 0])))
    assert np.abs(turns).max() < 1.0, "the points are too far apart to tell"
    return float(turns.sum())


def legs(path: Path) -> list[Any]:
    """Dense points of the path from user via point to user via point."""
    users = [via for via in path.vias if via.kind == "user"]
    found = []
    for before, after in itertools.pairwise(users):
        count = 1 + 200 * max(1, round(after.u - before.u))
        found.append(path.evaluate(np.linspace(before.u, after.u, count)))
    return found


def check_sides(path: Path, obstacles: Any, required: float = REQUIRED_M) -> None:
    """Every leg passes what is in its way on the side that is asked for."""
    for points in legs(path):
        ends = points[[0, -1], :2]
        straight = np.linspace(*ends, 2001)
        for obstacle in obstacles:
            asked = obstacle.forced_side
            if asked is None:
                continue
            shape = shape_of(obstacle)
            heart = np.array(shape.representative_point().coords[0])
            along = swept(np.vstack((straight[:1], points[:, :2], straight[-1:])), heart)
            gap = shape.distance(shapely.LineString(ends))
            bare = float(np.arctan2(
                np.linalg.det(np.array([ends[0] - heart, ends[1] - heart])),
                (ends[0] - heart) @ (ends[1] - heart),
            ))  # fmt: skip
            left, right = (bare, bare + math.tau) if bare < 0 else (bare - math.tau, bare)
            as_asked = left if asked == "left" else right
            is_near = shapely.LineString(points[:, :2]).distance(shape) < 1.99 * required
            if gap < required or is_near or as_asked == bare:
                assert along == pytest.approx(as_asked, abs=1e-6), (obstacle.name, asked, gap)


@pytest.mark.parametrize("robot", ROBOTS)
@settings(max_examples=12)
@given(seeds)
def test_every_plan_passes_on_the_sides_that_are_asked_for(robot: str, seed: int) -> None:
    mission = random_case(seed, robot)
    if mission is None:
        return
    try:
        plan = vs.plan(mission)
    except vs.PlanningError:
        return
    check_sides(plan.path, mission.world.known)
    for entry in plan.ledger:
        for candidate in entry.candidates:
            for obstacle in mission.world.known:
                if candidate.chosen and obstacle.name in entry.members and obstacle.forced_side:
                    assert candidate.side == obstacle.forced_side


@pytest.mark.parametrize("robot", ["disc", "circle", "car", "differential"])
@settings(max_examples=6)
@given(seeds)
def test_every_replan_passes_on_the_sides_that_are_asked_for(robot: str, seed: int) -> None:
    mission = random_case(seed, robot)
    if mission is None or not mission.world.unseen:
        return
    try:
        run = vs.simulate(mission)
    except vs.ViasplineError:
        return
    for new in run.replans:
        check_sides(new.path, mission.world.known)


def beside(radius: float, side: str, y: float = 0.0) -> vs.Mission:
    buoy = {"name": "buoy", "circle": {"center": [20, y], "radius": 1.0}, "pass_on": side}
    return vs.Mission.model_validate({
        "world": {"known": [buoy]},
        "robot": {"radius_m": 0.5, "clearance_m": 0.5, "min_turn_radius_m": radius},
        "route": {"start": [0, 0], "goal": [40, 0]},
    })  # fmt: skip


@pytest.mark.parametrize("radius", [0.5, 2.0, 3.5, 5.0, 6.5, 8.0])
@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("y", [-1.5, 0.7])
def test_a_buoy_is_passed_as_asked_with_any_turning_circle(
    radius: float, side: str, y: float
) -> None:
    mission = beside(radius, side, y)
    check_sides(vs.plan(mission).path, mission.world.known)


@pytest.mark.parametrize("mode", ["reflex", "planned", "from_rest"])
@settings(max_examples=12)
@given(seeds)
def test_a_replan_beside_a_buoy_keeps_to_the_side_of_the_whole_leg(mode: str, seed: int) -> None:
    """From anywhere on the leg: seen from there, the buoy may lie on the other side of the way."""
    rng = np.random.default_rng(seed)
    mission = beside(float(rng.choice([0.5, 2.0, 4.0])), str(rng.choice(["left", "right"])))
    world, requirements = vs.World.known(mission), Requirements.of(mission)
    path = vs.plan(mission).path
    at = float(rng.uniform(0.05, 0.7) * path.length)
    place = path.at_distance(min(at + rng.uniform(3, 12), path.length - 3)) + rng.normal(0, 2, 2)
    seen = vs.Obstacle(circle={"center": tuple(place), "radius": rng.uniform(0.3, 1.5)})
    try:
        new = getattr(replan, mode)(path, at, world.with_obstacles([seen]), requirements)
    except vs.PlanningError:
        return
    check_sides(new.path, world.obstacles)


def test_an_unseen_buoy_is_passed_as_asked_from_when_it_is_seen() -> None:
    data = beside(1.0, "left").model_dump()
    buoy = {"name": "buoy", "circle": {"center": [25, 1.8]} | {"radius": 0.5}, "pass_on": "left"}
    data["world"] = {"unseen": [buoy]}
    data["robot"]["sensor"] = {"range_m": 12.0}
    mission = vs.Mission.model_validate(data)
    run = vs.simulate(mission)
    assert run.reached
    assert len(run.replans) == 1  # nothing is in the robot's way but the side
    check_sides(run.replans[0].path, mission.world.unseen)


def test_a_closed_round_keeps_its_sides_on_every_lap() -> None:
    known = [
        {"name": f"mark {k}", "circle": {"center": at, "radius": 0.5}, "pass_on": "right"}
        for k, at in enumerate(([20, -0.5], [40.5, 20], [20, 40.5], [-0.5, 20]))
    ]
    mission = vs.Mission.model_validate({
        "world": {"known": known},
        "robot": {"radius_m": 0.5, "clearance_m": 0.5, "min_turn_radius_m": 4.0},
        "route": {"start": [0, 0], "via": [[40, 0], [40, 40], [0, 40]], "closed": True, "laps": 2},
    })  # fmt: skip
    check_sides(vs.plan(mission).path, mission.world.known)


def is_connected(mission: vs.Mission, kept: float, bound: set[str | None]) -> bool:
    """Whether the free plane without the rays of the forbidden sides leads from start to goal."""
    ends = np.array([mission.route.start.at, mission.route.goal.at])
    along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    solid = []
    for obstacle in mission.world.known:
        shape = shape_of(obstacle)
        solid.append(shape.buffer(kept, 64))
        if obstacle.name in bound:
            heart = np.array(shape.representative_point().coords[0])
            out = np.array([-along[1], along[0]]) * (-1 if obstacle.forced_side == "left" else 1)
            solid.append(shapely.LineString([heart, heart + 1000 * out]).buffer(1e-6))
    free = shapely.box(-200, -200, 200, 200).difference(shapely.union_all(solid))
    rooms = [part.buffer(1e-3) for part in shapely.get_parts(free)]
    return any(all(room.contains(shapely.Point(end)) for end in ends) for room in rooms)


@settings(max_examples=40)
@given(seeds)
def test_a_way_on_the_sides_that_are_asked_for_is_found_and_a_refusal_is_true(seed: int) -> None:
    rng = np.random.default_rng(seed)
    length = rng.uniform(12, 40)
    known = []
    for k in range(int(rng.integers(1, 4))):
        shape = random_shape(rng, rng.uniform(0.25, 0.75) * length, rng.normal(0, 1.5), 2.5)
        known.append(asked_for(rng, shape, f"buoy {k}") if rng.random() < 0.7 else shape)
    if rng.random() < 0.4:
        x, low, high = rng.uniform(0.3, 0.7) * length, *(rng.choice([-1, 1]) * np.array([3, 40]))
        known.append({"polygon": [[x, low], [x + 1, low], [x + 1, high], [x, high]]})
    data = {"world": {"known": known}, "route": {"start": [0, 0], "goal": [length, 0]}}
    try:
        mission = vs.Mission.model_validate(data)
    except vs.MissionError:
        return
    line = shapely.LineString([(0, 0), (length, 0)])
    sided = {o.name: o for o in mission.world.known if o.forced_side}
    surely_bound: set[str | None] = {
        name
        for name, obstacle in sided.items()
        if shape_of(obstacle).distance(line) < 2 * REQUIRED_M
        or (shape_of(obstacle).representative_point().y < 0) == (obstacle.forced_side == "left")
    }
    try:
        path = vs.plan(mission).path
    except vs.NoPathError:
        assert not is_connected(mission, 1.02 * REQUIRED_M, set(sided))
    else:
        check_sides(path, mission.world.known)
        assert is_connected(mission, 0.98 * REQUIRED_M, surely_bound)
