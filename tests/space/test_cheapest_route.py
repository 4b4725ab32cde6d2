from __future__ import annotations

from contextlib import suppress
from itertools import product
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from cities import city
from viaspline.mission.model import Mission
from viaspline.space.cheapest_route import CheapestRoute
from viaspline.space.laying.clear_route import StuckLegError
from viaspline.space.laying.laid_route import RouteLegs
from viaspline.space.laying.sooner_corners import with_fewer
from viaspline.space.laying.via_turns import ROOMY
from viaspline.space.led_route import RouteLayer
from viaspline.space.leg_check import LegCheck
from viaspline.space.leg_router import LegRouter
from viaspline.space.route_law import cost_of
from viaspline.space.spatial_request import spatial_problem_of
from viaspline.space.weighed_ways import NO_CHEAPER, least_radius


def through_a_via_point(seed: int) -> tuple[Mission, RouteLayer, RouteLegs]:
    """A city with a via point, what lays its routes, and its legs before they are led round."""
    data = city(seed)
    data["route"]["via"] = [[90, 70, 20]]  # type: ignore[index]
    mission = Mission.model_validate(data)
    asked = spatial_problem_of(mission)
    router = LegRouter(asked, mission)
    layer = RouteLayer(asked, router, LegCheck(asked, router.gates))
    free = np.full((3, 3), np.nan)
    close = ROOMY * least_radius(asked)
    legs = RouteLegs.left_to_the_spline(asked.places, free, asked.shape, close)
    return mission, layer, legs


@pytest.mark.parametrize("seed", [56, 63, 70])
def test_a_leg_takes_the_way_with_which_the_whole_route_is_the_soonest(seed: int) -> None:
    """With its neighbour another way is better than the one that is the best alone."""
    mission, layer, legs = through_a_via_point(seed)
    together, *_, alone = CheapestRoute(layer).routes(legs)
    cost = cost_of(layer.problem)
    assert cost(together.laid) < cost(alone.laid)
    plan = vs.plan(mission)
    assert plan.trajectory.duration == pytest.approx(cost(together.laid), rel=1e-4)
    better_alone = [one for entry in plan.ledger for one in entry.candidates if one.passed_over]
    assert NO_CHEAPER in {one.passed_over for one in better_alone}


def past_things(
    known: list[dict[str, Any]], start: float, via: list[float], goal: list[float], across: float
) -> dict[str, Any]:
    """A flight through one via point, past what stands before it."""
    robot = {
        "radius_m": 0.4, "max_speed_mps": 10, "max_climb_mps": 2.5, "max_descent_mps": 1.5,
        "max_accel_mps2": 3, "max_lateral_accel_mps2": across,
    }  # fmt: skip
    return {
        "world": {"ground": {"flat_m": 0}, "known": known},
        "robot": robot,
        "route": {"start": [0, 0, start], "via": [via], "goal": goal},
    }


PASSED_BY = {
    # asked to pass on the left, it took 21.6 s; left to itself 21.8 s, and 19.2 s since
    "the cheapest way first": past_things(
        [
            {"polygon": [[13.1, -1.2], [18.6, -1.2], [18.6, 9], [13.1, 9]], "height_m": [0, 27.2]},
            {"box": {"min": [38.2, 4.3, 0], "max": [43.1, 7.6, 24.3], "yaw_deg": 83.2}},
        ],
        19.9, [65, 3.6, 18.7], [80, 1.8, 5.8], across=1,
    ),
    # the right one has corners too close together: 13.65 s without some, 13.93 on the left
    "corners left out of dear ways": past_things(
        [{"box": {"min": [12.5, -6, 0], "max": [18.5, -0.2, 24.8], "yaw_deg": 8.2}}],
        9.4, [40, -5.9, 16.5], [55, 7.7, 15.9], across=1,
    ),
}  # fmt: skip


@pytest.mark.parametrize("mission", PASSED_BY.values(), ids=PASSED_BY)
def test_no_side_that_is_asked_for_is_sooner_past_a_via_point_than_the_one_that_is_chosen(
    mission: dict[str, Any],
) -> None:
    def takes(known: list[dict[str, Any]]) -> float:
        asked = {**mission, "world": {**mission["world"], "known": known}}
        return vs.plan(vs.Mission.model_validate(asked)).trajectory.duration

    standing = mission["world"]["known"]
    free = takes(standing)
    for k, side in product(range(len(standing)), ("left", "right", "over")):
        known = list(standing)
        known[k] = {**known[k], "pass_on": side}
        assert free <= takes(known) + 1e-6


@pytest.mark.parametrize("seed", [39, 73])
def test_no_corner_is_left_out_of_a_route_that_makes_it_sooner(seed: int) -> None:
    """Alone, from rest to rest, the leg has that corner: it costs no time there."""
    _, layer, legs = through_a_via_point(seed)
    best, cost = CheapestRoute(layer).routes(legs)[0], cost_of(layer.problem)
    for leg, way in best.ways.items():
        points = np.concatenate((legs.vias[leg][None], way.inner, legs.vias[leg + 1][None]))
        for fewer in with_fewer(points, layer.radius):
            led = legs
            for k, other in best.ways.items():
                led = led.led_round(k, fewer[1:-1] if k == leg else other.inner, layer.radius)
            with suppress(StuckLegError):
                assert cost(layer.lay(led, best.ways).laid) >= cost(best.laid) * (1 - 1e-3)
