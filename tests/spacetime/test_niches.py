"""Corridors with doors: who comes along one has to be let past, at a door or before it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest

import viaspline as vs


def corridor(half: float, ends: float, doors: Sequence[float]) -> list[dict[str, Any]]:
    """Its walls [m], with gaps of 1.6 m about some places along it."""
    edges = [-3.0, *(door + side for door in doors for side in (-0.8, 0.8)), ends]
    return [
        {"polygon": [[a, low], [b, low], [b, low + 0.5], [a, low + 0.5]]}
        for a, b in zip(edges[::2], edges[1::2], strict=True)
        for low in (half, -half - 0.5)
    ]


def body(front: float, back: float, half: float, **limits: float) -> dict[str, Any]:
    return {"footprint": [[-back, -half], [front, -half], [front, half], [-back, half]], **limits}


def mover(name: str, radius: float, *keyframes: Sequence[float], **motion: Any) -> dict[str, Any]:
    motion = {"keyframes": keyframes, "after": "vanish", **motion}
    return {"name": name, "circle": {"center": [0, 0], "radius": radius}, "motion": motion}


OBLONG = {
    "name": "oncoming",
    "polygon": [[-0.382, -0.306], [0.382, -0.306], [0.382, 0.306], [-0.382, 0.306]],
    "motion": {"keyframes": [[0, 24.184, 0], [26.857, -6, 0]], "after": "vanish"},
}
HARD_TO_LAY = (
    corridor(0.999, 19.131, (8.085, 10.744)),
    [
        mover("crossing", 0.228, (2.981, 8.085, -3.999), (11.799, 8.07, 3.999), after="bounce"),
        mover(
            "oncoming", 0.267, (0, 18.069, 0), (21.342, -6, 0),
            error={"position_m": 0.113, "growth_mps": 0.014},
        ),
    ],
    body(
        0.425, 0.156, 0.273, max_speed_mps=1.811, max_accel_mps2=0.717, clearance_m=0.018,
        max_lateral_accel_mps2=0.553,
    ),
    16.131,
)  # fmt: skip
SAME_AGAIN = (
    corridor(1.251, 21.619, (4.256, 12.234, 14.994)),
    [
        mover("late", 0.166, (3.034, 12.234, -4.251), (15.037, 12.087, 4.251), after="stay"),
        mover(
            "soon", 0.315, (0.923, 4.256, -4.251), (9.071, 4.295, 4.251), after="stay",
            error={"position_m": 0.035, "growth_mps": 0.019},
        ),
        OBLONG,
    ],
    body(
        0.284, 0.186, 0.246, max_speed_mps=1.37, max_accel_mps2=1.183, max_brake_mps2=2.036,
        max_lateral_accel_mps2=0.355, clearance_m=0.112, tracking_error_m=0.038,
    ),
    18.619,
)  # fmt: skip


@pytest.mark.parametrize("case", [HARD_TO_LAY, SAME_AGAIN])
def test_one_way_that_is_hard_to_lay_or_laid_again_keeps_no_other_from_being_tried(
    case: tuple[list[Any], list[Any], dict[str, Any], float],
) -> None:
    walls, moving, robot, goal = case
    world = {"known": [*walls, *moving]}
    route = {"start": [0, 0], "goal": [goal, 0]}
    plan = vs.plan(vs.Mission.model_validate({"world": world, "robot": robot, "route": route}))
    assert plan.moving_certificate is not None
    assert plan.moving_certificate.holds
    assert plan.trajectory.duration < 20.0  # who comes along it is gone after 21 s and 27 s
