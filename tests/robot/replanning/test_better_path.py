"""A way that has opened is taken when it is clearly shorter."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from viaspline.mission.model import Mission
from viaspline.robot.navigator import Navigator

Make = Callable[..., Mission]
Shape = Callable[..., dict[str, Any]]
Drive = Callable[..., tuple[Navigator, list[Navigator]]]
LIDAR = {"range_m": 6.0, "fov_deg": 270.0, "beams": 541}
ROBOT = {"radius_m": 0.3, "clearance_m": 0.1, "sensor": {"lidar": LIDAR}}


def test_a_door_that_opens_is_used_when_that_is_clearly_better(
    drive: Drive, mission_of: Make, box_at: Shape
) -> None:
    wall = box_at(10, -20, 10.3, 20, "wall")
    mission = mission_of([0, 0], [20, 0], unseen=[wall], **ROBOT)
    nav, _ = drive(mission, lambda time: mission.world.unseen if time < 6.0 else ())
    assert nav.reached, nav.reason
    assert nav.path.length < 30
