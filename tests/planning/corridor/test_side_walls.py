"""Obstacles in a corridor are passed on the side that is asked for, seen along the corridor."""

from __future__ import annotations

import math

import numpy as np
import pytest

import viaspline as vs
from viaspline.mission.strip import strip_of
from viaspline.planning.corridor.side_walls import with_side_walls

LANE = [[x, 0.0, 5.0, 5.0] for x in range(0, 61, 5)]
ANGLES = np.linspace(0, math.tau, 60, endpoint=False)
ROUND = [[30 * math.cos(a), 30 * math.sin(a), 5.0, 5.0] for a in ANGLES]


def asked(line: list, buoy: dict, **route) -> vs.Mission:
    return vs.Mission.model_validate({
        "robot": {"radius_m": 0.5, "clearance_m": 0.25},
        "world": {"known": [{"name": "buoy"} | buoy]},
        "route": {"start": line[0][:2], "corridor": {"line": line}} | route,
    })  # fmt: skip


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("y", [-3.5, -1.0, 0.2, 3.5])
def test_a_buoy_in_a_lane_is_left_on_the_other_side(side: str, y: float) -> None:
    buoy = {"circle": {"center": [30, y], "radius": 0.4}, "pass_on": side}
    mission = asked(LANE, buoy, goal=[60, 0])
    if abs(y) == 3.5 and (y > 0) == (side == "left"):
        with pytest.raises(vs.NoPathError, match="corridor"):
            vs.plan(mission)  # 1.1 m to the edge, 1.5 m are needed
        return
    path = vs.plan(mission).path
    points = path.evaluate(np.linspace(*path.domain, 5001))
    there = float(np.interp(30.0, points[:, 0], points[:, 1]))
    assert (there > y) == (side == "left")


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("radius", [28.5, 30.2, 32.0])
def test_sides_turn_with_the_corridor(side: str, radius: float) -> None:
    buoy = {"circle": {"center": [0, -radius], "radius": 0.4}, "never_pass_on": side}
    path = vs.plan(asked(ROUND, buoy, closed=True)).path
    points = path.evaluate(np.linspace(*path.domain, 5001))
    south = points[points[:, 1] < 0]
    there = -float(np.interp(0.0, south[:, 0], south[:, 1]))
    assert (there > radius) == (side == "left")  # anticlockwise: the left is inside


def test_what_has_no_side_gets_no_wall() -> None:
    mission = asked(LANE, {"circle": {"center": [30, 0], "radius": 0.4}}, goal=[60, 0])
    world, strip = vs.World.known(mission), strip_of(mission.route)
    assert strip is not None
    assert with_side_walls(world, strip) is world
