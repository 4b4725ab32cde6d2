"""Which obstacles' sides bind a leg, and what a path of it may not cross."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.planning.problem.via_sequence import WholeLeg
from viaspline.planning.routing.asked_sides import AskedSides, sided

LEG = WholeLeg(np.array([0.0, 0.0]), np.array([40.0, 0.0]))
REQUIRED_M = 1.0


def sides_of(*obstacles: dict[str, Any], leg: WholeLeg = LEG) -> AskedSides:
    world = vs.World([vs.Obstacle(**obstacle) for obstacle in obstacles])
    groups = np.arange(len(obstacles))
    if len(obstacles) > 1:
        from viaspline.kernels.world.clusters import group_labels

        groups = group_labels(world.packed, 2 * REQUIRED_M)
    return AskedSides.of(leg, sided(world), world, REQUIRED_M, lambda: groups)


def buoy(y: float, side: str | None = None, x: float = 20.0) -> dict[str, Any]:
    return {"circle": {"center": (x, y), "radius": 1.0}} | ({"pass_on": side} if side else {})


@pytest.mark.parametrize(
    ("y", "side", "binds"),
    [
        (0.0, "left", True),
        (0.0, "right", True),
        (2.9, "left", True),  # nearer to the line than twice what is required
        (3.1, "left", False),  # beside the way, and may stay there
        (3.1, "right", True),  # passed as asked by the straight line: none goes round it
        (-3.1, "left", True),
        (-3.1, "right", False),
        (25.0, "left", False),
    ],
)
def test_sides_bind_in_the_way_and_where_the_straight_line_keeps_them(
    y: float, side: str, binds: bool
) -> None:
    assert sides_of(buoy(y, side)).binding.tolist() == [binds]


def test_what_stands_too_close_to_something_in_the_way_is_in_the_way() -> None:
    assert sides_of(buoy(0.5), buoy(4.0, "left")).binding.tolist() == [True]
    assert sides_of(buoy(0.5), buoy(6.0, "left")).binding.tolist() == [False]


def test_the_barrier_is_square_to_the_leg_on_the_forbidden_side() -> None:
    (barrier,) = sides_of(buoy(0.0, "left")).closed
    assert barrier[:3].tolist() == [20.0, 0.0, 20.0]
    assert barrier[3] < -100.0


def test_a_curve_on_the_wrong_side_is_named() -> None:
    sides = sides_of(buoy(0.0, "left"), buoy(0.5, "right", x=30.0))
    below = np.array([[[0, 0], [10, -6], [30, -6], [40, 0]]], np.float64)
    assert sides.wrong(below).tolist() == [0]
    assert sides.wrong(below * (1.0, -1.0)).tolist() == [1]


def test_a_curve_that_comes_near_on_the_wrong_side_is_found() -> None:
    world = vs.World([vs.Obstacle(**buoy(6.0, "left"))])
    sides = AskedSides.of(LEG, sided(world), world, REQUIRED_M, lambda: np.zeros(1, np.int64))
    assert not sides.binding.any()
    near, far = (np.array([[[0, 0], [13, y], [27, y], [40, 0]]], np.float64) for y in (4.5, 2.0))
    assert sides.overlooked(near, world, REQUIRED_M).tolist() == [0]
    assert not sides.overlooked(far, world, REQUIRED_M).size
    kept = WholeLeg(LEG.start, LEG.goal, np.array([[[0, 0], [13, 11], [27, 11], [40, 0]]], float))
    again = AskedSides.of(kept, sided(world), world, REQUIRED_M, lambda: np.zeros(1, np.int64))
    assert again.binding.all()  # what the path so far goes round as asked, the next one does too


@pytest.mark.parametrize(
    ("radius", "kind"), [(None, vs.NoPathError), (5.0, (vs.NoPathError, vs.GaveUpError))]
)
def test_a_refusal_names_the_obstacle_the_side_and_the_key_to_drop(radius: Any, kind: Any) -> None:
    mission = vs.Mission.model_validate({
        "world": {
            "known": [
                {"name": "buoy", "never_pass_on": "right"} | {
                    "circle": {"center": [20, 0], "radius": 1}
                },
                {"name": "quay", "polygon": [[0, 2.5], [40, 2.5], [40, 9], [0, 9]]},
            ],
            "bounds": [-5, -20, 45, 9],
        },
        "robot": {"radius_m": 0.5, "clearance_m": 0.5, "min_turn_radius_m": radius},
        "route": {"start": [0, 0], "goal": [40, 0]},
    })  # fmt: skip
    with pytest.raises(kind, match="'buoy' on the left") as caught:
        vs.plan(mission)
    error = caught.value
    assert error.obstacles == ("buoy",)
    assert "drop never_pass_on of 'buoy'" in error.remedy
    assert [(c.key, c.value) for c in error.changes] == [("world.known[0].never_pass_on", None)]
    freed = mission.world.known[0].model_copy(update={"never_pass_on": None})
    world = mission.world.model_copy(update={"known": (freed, mission.world.known[1])})
    assert vs.plan(mission.model_copy(update={"world": world})).certificate.holds
