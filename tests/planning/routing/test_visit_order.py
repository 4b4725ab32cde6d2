from itertools import pairwise, permutations
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.planning.routing.visit_order import is_surely_shortest, lengths_between, ordered
from viaspline.world.world import World

seeds = st.integers(0, 100_000)


def mission(places: Any, *, closed: bool = False, **world: Any) -> vs.Mission:
    start, *via = np.asarray(places).tolist()
    route: dict[str, Any] = {"start": start, "via": via, "order": "shortest", "closed": closed}
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
    lengths = lengths_between(asked, World.known(asked))
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
    lengths = lengths_between(asked, World.known(asked))
    assert abs(lengths[0, 1] - lengths[1, 0]) > 0.5
