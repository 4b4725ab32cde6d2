"""What may be changed of a route: legs that are there, not those of no length."""

from __future__ import annotations

import numpy as np

from viaspline.space.laying.laid_route import CurveShape, RouteLegs, lay_route
from viaspline.space.laying.otherwise_laid import changes, straight_changes


def test_a_leg_of_no_length_beside_one_led_round_is_left_as_it_is() -> None:
    """A drone that stays right where its descent begins."""
    top = [34.17, 48.64, 167.7]
    vias = np.array([[21.13, 2.12, 176.7], top, top])
    legs = RouteLegs.left_to_the_spline(vias, np.full((3, 3), np.nan), CurveShape(np.zeros(2)))
    led = legs.led_round(0, np.array([[28.0, 39.9, 169.7]]), 4.0)
    found = [change(led) for change in changes(led, 4.0, 1.0)]
    assert len(found) == 1
    assert found[0].inner[1] is None
    laid = lay_route(found[0])
    assert (laid.leg(1) == np.array(top)).all()


def test_where_no_tension_is_stated_all_legs_go_straight_at_once_and_then_each_by_itself() -> None:
    vias = np.array([[0.0, 0, 5], [90, 0, 5], [90, 30, 5], [0, 30, 5]])
    legs = RouteLegs.left_to_the_spline(vias, np.full((4, 3), np.nan), CurveShape(np.zeros(3)))
    tried = [change(legs) for change in straight_changes(legs, 4.0, 1.0)]
    straight = [[leg for leg in range(3) if one.inner[leg] is not None] for one in tried]
    assert straight == [[0, 1, 2], [0, 1, 2], [0], [0], [1], [1], [2], [2]]
    assert [one.radii[straight[k][0]].max() for k, one in enumerate(tried)] == [4.0, 1.0] * 4
    assert not list(changes(legs, 4.0, 1.0))
