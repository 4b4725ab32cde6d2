"""What the user asks for.

``Mission.model_validate(data)`` takes exactly what the YAML holds.
"""

from __future__ import annotations

from typing import Any

from pydantic import ModelWrapValidatorHandler, ValidationInfo, model_validator

from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.validation import sound_mission
from viaspline.presentable.shown_value import ShownValue


class Mission(ShownValue, MissionParts):
    """A world, a robot, a route and how smooth its curve is.

    Every way to make one raises `viaspline.errors.MissionError` with every fault at once.

    Attributes:
        world: The known map, and what is there but not on the map.
        robot: The robot's body, limits and sensor.
        route: The points that the path runs through.
        spline: The curve's shape.
        ros: How the robot's ROS 2 calls its topics and frames.

    >>> mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}})
    >>> mission.route.goal.at
    (9.0, 0.0)
    """

    @model_validator(mode="wrap")
    @classmethod
    def _sound(
        cls, data: Any, handler: ModelWrapValidatorHandler[Mission], info: ValidationInfo
    ) -> Mission:
        return sound_mission(data, handler, info.context)
