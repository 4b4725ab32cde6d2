"""Robots with every drive, and a path with bends both ways."""

from __future__ import annotations

from typing import Any

import pytest

from viaspline.curve.cardinal import CardinalSpline
from viaspline.mission.robot_parts import RobotSpec

DRIVES: dict[str, dict[str, Any]] = {
    "point": {},
    "differential": {"differential": {"track_m": 0.5, "max_wheel_speed_mps": 2.5}},
    "skid-steer": {"skid_steer": {"track_m": 0.6, "slip": 0.3, "max_wheel_speed_mps": 2.5}},
    "ackermann": {"ackermann": {"wheelbase_m": 1.0, "max_steer_deg": 35,
                                "max_steer_rate_degps": 90}},
    "omnidirectional": {"omnidirectional": {"max_speed_along_mps": 2.0,
                                            "max_speed_across_mps": 1.0, "hold_heading_deg": 30}},
}  # fmt: skip
NOISE = {"speed_noise_mps": 0.05, "yaw_rate_noise_degps": 2.0}
PLACE = {"position_noise_m": 0.02, "heading_noise_deg": 0.5}


def make_robot(kind: str, *, noise: bool = True, **more: Any) -> RobotSpec:
    """A robot with a drive and 0.1 s of delay; keys of the drive end in ``_s``."""
    drive = {"delay_s": more.pop("delay_s", 0.1), "lag_s": more.pop("lag_s", 0.0)}
    data: dict[str, Any] = {"max_lateral_accel_mps2": 1.0, **more}
    if kind != "point":
        data["drive"] = {**DRIVES[kind], **drive, **(NOISE if noise else {})}
    if noise or kind == "point":
        data["localization"] = PLACE if noise else {}
    return RobotSpec.model_validate(data)


@pytest.fixture(params=list(DRIVES))
def kind(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="session")
def robot_of() -> Any:
    return make_robot


@pytest.fixture(scope="session")
def bends() -> CardinalSpline:
    return CardinalSpline([(0, 0), (15, 4), (25, -4), (40, 8), (40, 20), (20, 24)])
