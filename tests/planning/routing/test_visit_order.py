import math
from itertools import pairwise, permutations
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.checking.driving_time import straight_time
from viaspline.planning.problem.path_pace import Pace
from viaspline.planning.routing.visit_order import is_surely_shortest, ordered, ways_between
from viaspline.world.world import World

seeds = st.integers(0, 100_000)


def mission(places: Any, *, closed: bool = False, **world: Any) -> vs.Mission:
    start, *via = np.asarray(places).tolist()
    route: dict[str, Any] = {"start": start, "via": via, "order": "shortest", "closed": closed}
    route["optimise"] = "length"
    if not closed:
        route["goal"] = route["via"].pop()
    return vs.Mission.model_validate({"world": world, "route": route})


def in_order(asked: vs.Mission) -> vs.Mission:
    return ordered(asked, World.known(asked))


def length(route: Any, *, closed: bool) -> float:
    stops = np.array([point.at for _, point in route.points()])
    if closed:
        stops = np.vstack((stops, stops[:1]))
    return float(np.hypot(*np.diff(stops, axis=0).T).sum())


@settings(max_examples=30)
@given(seeds, st.integers(1, 6), st.booleans())
def test_few_via_points_come_in_the_best_of_all_orders(seed: int, count: int, closed: bool) -> None:
    places = np.random.default_rng(seed).uniform(0, 100, (count + 2 - closed, 2))
    asked = mission(places, closed=closed)
    best = min(
        length(asked.route.model_copy(update={"via": via}), closed=closed)
        for via in permutations(asked.route.via)
    )
    assert length(in_order(asked).route, closed=closed) == pytest.approx(best)


@settings(max_examples=10)
@given(seeds)
def test_among_many_no_exchange_of_two_makes_the_round_shorter(seed: int) -> None:
    places = np.random.default_rng(seed).uniform(0, 100, (20, 2))
    route = in_order(mission(places, closed=True)).route
    found = length(route, closed=True)
    assert found <= length(mission(places, closed=True).route, closed=True) + 1e-9
    for i in range(len(route.via)):
        for j in range(i):
            via = list(route.via)
            via[i], via[j] = via[j], via[i]
            changed = route.model_copy(update={"via": tuple(via)})
            # an exchange of neighbours turns a part round; others are two moves of one point
            if i - j == 1:
                assert length(changed, closed=True) >= found - 1e-9


def test_what_stands_between_counts() -> None:
    wall = {"polygon": [[4, -50], [6, -50], [6, 3], [4, 3]]}
    asked = mission([[0, 0], [8, 0], [2, 9], [3, 20]], known=[wall], bounds=[-60, -49, 60, 60])
    lengths = ways_between(asked, World.known(asked)).lengths
    assert lengths[0, 1] > 8.0
    assert lengths == pytest.approx(lengths.T)
    assert [via.name for via in in_order(asked).route.via] == ["via 1", "via 2"]


def test_the_plan_serves_the_via_points_in_the_order_that_was_found() -> None:
    asked = mission([[0, 0], [60, 1], [20, 0], [40, -1], [80, 0]])
    plan = vs.plan(asked)
    names = [via.name for via in plan.path.vias if via.kind == "user"]
    assert names == ["start", "via 2", "via 3", "via 1", "goal"]
    assert plan.mission.route.order == "given"


@pytest.mark.parametrize("closed", [True, False])
def test_very_many_via_points_come_in_a_short_order(closed: bool) -> None:
    places = np.random.default_rng(3).uniform(0, 100, (300, 2))
    asked = mission(places, closed=closed)
    assert not is_surely_shortest(asked)
    route = in_order(asked).route
    assert sorted(via.at for via in route.via) == sorted(via.at for via in asked.route.via)
    # The shortest round is about 0.7124 sqrt(n area) long, and somewhat more among few.
    assert length(route, closed=closed) < 1.2 * 0.7124 * np.sqrt(300) * 100


def test_a_mission_that_gives_its_order_is_left_alone() -> None:
    asked = vs.Mission.model_validate({"route": {"start": [0, 0], "via": [[9, 0], [1, 0]]}})
    assert in_order(asked) is asked


def test_one_point_alone_and_none_at_all_are_in_order() -> None:
    assert in_order(mission([[0, 0], [5, 0], [9, 0]])).route.via[0].at == (5.0, 0.0)
    assert in_order(mission([[0, 0], [9, 0]])).route.via == ()


def past_sides(seed: int) -> dict[str, Any]:
    """A round of four places among discs that are to be passed on one side each."""
    random = np.random.default_rng(seed)
    discs = [
        {"circle": {"center": at, "radius": float(random.uniform(4, 10))},
         "pass_on": str(random.choice(["left", "right"]))}
        for at in random.uniform(15, 85, (3, 2)).tolist()
    ]  # fmt: skip
    places: list[list[float]] = []
    while len(places) < 4:
        at = random.uniform(0, 100, 2)
        gaps = [
            np.hypot(*(at - d["circle"]["center"])) - d["circle"]["radius"] for d in discs
        ]  # fmt: skip
        if min(gaps) > 2.0:
            places.append(at.tolist())
    route = {"start": places[0], "via": places[1:], "closed": True, "order": "shortest"}
    route["optimise"] = "length"
    return {"world": {"known": discs}, "route": route}


def planned_length(data: dict[str, Any], start: Any, goal: Any) -> float:
    route = {"start": list(start), "goal": list(goal)}
    try:
        return vs.plan(vs.Mission.model_validate(data | {"route": route})).path.length
    except vs.NoPathError:
        return float("inf")


@pytest.mark.parametrize("seed", range(8))
def test_the_sides_that_are_asked_for_count_in_the_order(seed: int) -> None:
    data = past_sides(seed)
    start, via = tuple(data["route"]["start"]), [tuple(at) for at in data["route"]["via"]]
    legs = {ends: planned_length(data, *ends) for ends in permutations((start, *via), 2)}

    def length(order: Any) -> float:
        return sum(legs[ends] for ends in pairwise((start, *order, start)))

    taken = in_order(vs.Mission.model_validate(data)).route.via
    best = min(length(order) for order in permutations(via))
    assert length([via.at for via in taken]) == pytest.approx(best, rel=2e-3)


def test_there_and_back_differ_where_sides_are_asked_for() -> None:
    post = {"circle": {"center": [20, 3], "radius": 5}, "pass_on": "left"}
    asked = mission([[0, 0], [40, 0], [60, 0]], known=[post])
    lengths = ways_between(asked, World.known(asked)).lengths
    assert abs(lengths[0, 1] - lengths[1, 0]) > 0.5


def timed(seed: int, count: int, *, closed: bool) -> vs.Mission:
    """Places of which some are stations, for a robot that has to slow down for turns."""
    rng = np.random.default_rng(seed)
    asked = mission(rng.uniform(0, 60, (count + 2 - closed, 2)), closed=closed).route
    dwells = rng.choice([0.0, 5.0], len(asked.via), p=[0.7, 0.3]).tolist()
    vias = [{"at": via.at, "dwell_s": dwell} for via, dwell in zip(asked.via, dwells, strict=True)]
    data = asked.model_dump(exclude_none=True) | {"via": vias, "optimise": "time"}
    robot = {"max_speed_mps": 4.0, "max_accel_mps2": 1.0}
    return vs.Mission.model_validate({"robot": robot, "route": data})


def reckoned(asked: vs.Mission, order: Any) -> float:
    """The time of a round from halt to halt, its turns at no more than full stops [s]."""
    route, pace = asked.route, Pace.of(asked.robot)
    ends = [route.start, *order, route.start if route.goal is None else route.goal]
    at = np.array([point.at for point in ends])
    steps = np.diff(at, axis=0)
    headings = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    total, run = 0.0, 0.0
    for k, step in enumerate(np.hypot(*steps.T).tolist()):
        run += step
        if k == len(steps) - 1 or order[k].dwell_s > 0.0:
            total, run = total + straight_time(run, pace), 0.0
        else:
            total += float(pace.corner_times(headings[k + 1 : k + 2] - headings[k])[0])
    return total


@settings(max_examples=20)
@given(seeds, st.integers(1, 5), st.booleans())
def test_where_time_counts_few_via_points_come_in_the_soonest_order(
    seed: int, count: int, closed: bool
) -> None:
    asked = timed(seed, count, closed=closed)
    found = reckoned(asked, in_order(asked).route.via)
    best = min(reckoned(asked, order) for order in permutations(asked.route.via))
    assert found == pytest.approx(best, abs=0.15 * count)  # turns are looked up by whole degrees


@pytest.mark.parametrize(
    ("zone", "first"),
    [([[1, -2], [9, -2], [9, 2], [1, 2]], "west"), ([[-2, 1], [2, 1], [2, 9], [-2, 9]], "south")],
)
def test_an_order_whose_ways_miss_a_slow_zone_is_sooner(zone: list[Any], first: str) -> None:
    """Either order is as long and turns as much: one begins along the south, one along the west."""
    via = [{"at": [10, 0], "name": "south"}, {"at": [0, 10], "name": "west"}]
    asked = vs.Mission.model_validate(
        {
            "world": {"speed_zones": [{"polygon": zone, "max_speed_mps": 0.5}]},
            "robot": {"max_speed_mps": 4.0, "max_accel_mps2": 1.0},
            "route": {"start": [0, 0], "via": via, "goal": [10, 10], "order": "shortest"},
        }
    )
    assert in_order(asked).route.via[0].name == first


def test_a_longer_round_is_taken_that_turns_less() -> None:
    places = [[5, 54], [38, 54], [3, 4], [14, 78], [24, 47], [79, 56]]
    robot = {"max_speed_mps": 4.0, "max_accel_mps2": 1.0}
    plans = {}
    for optimise in ("length", "time"):
        route = {"start": places[0], "via": places[1:-1], "goal": places[-1]}
        route |= {"order": "shortest", "optimise": optimise}
        data = {"robot": robot, "route": route}
        plans[optimise] = in_order(vs.Mission.model_validate(data)).route
    taken = {name: [via.name for via in route.via] for name, route in plans.items()}
    assert taken["length"] != taken["time"]
    given = [
        vs.plan(vs.Mission.model_validate({
            "robot": robot,
            "route": route.model_dump(exclude_none=True) | {"optimise": "time"},
        }))
        for route in plans.values()
    ]  # fmt: skip
    assert given[1].trajectory.duration < 0.998 * given[0].trajectory.duration


def test_a_turn_costs_more_the_sharper_it_is_and_no_more_than_a_halt() -> None:
    pace = Pace(speed=4.0, accel=1.0, brake=2.0, lateral=1.0)
    times = pace.corner_times(np.linspace(0.0, np.pi, 50))
    assert times[0] == pytest.approx(0.0, abs=1e-9)
    assert (np.diff(times) >= -1e-12).all()
    assert times[-1] <= 0.5 * 4.0 * (1.0 + 0.5) + 1e-12


@pytest.mark.parametrize("optimise", ["time", "length"])
@settings(max_examples=20)
@given(seeds, st.integers(2, 6), st.floats(-180.0, 180.0))
@example(0, 2, 56.0)
def test_a_closed_round_begins_the_way_that_its_start_faces_however_the_world_is_turned(
    optimise: str, seed: int, count: int, turn: float
) -> None:
    places = np.random.default_rng(seed).uniform(0, 100, (count + 1, 2))
    heading = float(np.random.default_rng(seed).uniform(-180, 180))
    cos, sin = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    image = places @ np.array([[cos, sin], [-sin, cos]]) + (3e5, 5e6)

    def served(places: Any, heading: float) -> vs.Mission:
        asked = mission(places, closed=True).model_dump(exclude_defaults=True, exclude_none=True)
        asked["route"] |= {"optimise": optimise}
        asked["route"]["start"] = {"at": tuple(places[0]), "heading_deg": heading}
        return in_order(vs.Mission.model_validate(asked))

    found, turned = served(places, heading), served(image, heading + turn)
    assert [via.name for via in turned.route.via] == [via.name for via in found.route.via]
    ways = [np.array(via.at) - places[0] for via in (found.route.via[0], found.route.via[-1])]
    off = [math.remainder(math.atan2(y, x) - math.radians(heading), math.tau) for x, y in ways]
    assert abs(off[0]) + (math.pi - abs(off[1])) <= math.pi + 1e-6
