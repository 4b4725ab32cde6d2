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

    def lying_at(self, origin: tuple[float, float]) -> Mission:
        """It, with its 0, 0 somewhere on earth.

        Args:
            origin: Latitude and longitude [deg].
        """
        world = self.world.model_copy(update={"origin_deg": origin})
        return self.model_copy(update={"world": world})

    @model_validator(mode="wrap")
    @classmethod
    def _sound(
        cls, data: Any, handler: ModelWrapValidatorHandler[Mission], info: ValidationInfo
    ) -> Mission:
        return sound_mission(data, handler, info.context)
