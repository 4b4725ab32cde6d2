"""What is asked of a drive, the same from its start to its end.

Tested through ``robot/navigation/test_arrivals``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.mission.model import Mission
from viaspline.mission.spot_turning import PERIOD_S, SpotTurning
from viaspline.planning.problem.requirements import Requirements
from viaspline.robot.perception.belief import MIN_SURFACE_DISTANCE_M
from viaspline.trajectory.limits import Limits


@dataclass(frozen=True)
class DriveTask:
    """What a robot is to do, and what every path and every trajectory of it has to keep.

    Attributes:
        mission: What was asked for.
        requirements: Of every path: the clearance, the body, the turning circle.
        limits: Of every trajectory: speeds and accelerations, with what the sensor allows.
        reaction: Longest time between two steps [s].
        model: The drive; None if the robot follows its path exactly.
        apart: What it keeps to what moves beyond what is required [m].
        period: Usual time between two steps [s].
    """

    mission: Mission
    requirements: Requirements
    limits: Limits
    reaction: float
    model: DriveModel | None = None
    apart: float = 0.0
    period: float = PERIOD_S

    @property
    def kept_to_moving(self) -> float:
        """Distance from the robot's middle to everything that moves [m]."""
        return self.requirements.around + self.apart

    @property
    def kept_by_body(self) -> tuple[float, ...]:
        """Less than that, for a body that is no disc [m]."""
        return tuple(distance + self.apart for distance in self.requirements.within_around)

    @property
    def spot_turning(self) -> SpotTurning:
        """How the robot turns where it stands."""
        if self.model is None:
            return SpotTurning.of(self.mission.robot)
        return SpotTurning.of_model(self.model)


def requirements_under_way(mission: Mission, tracking_error: float) -> Requirements:
    """What every path of a drive has to keep; with a lidar that is never nothing.

    Args:
        mission: What is asked for.
        tracking_error: How far beside its path the robot may get [m].
    """
    requirements = Requirements.of(mission, tracking_error)
    sensor = mission.robot.sensor
    if sensor is None or sensor.lidar is None:
        return requirements
    least = MIN_SURFACE_DISTANCE_M - requirements.radius
    return replace(requirements, clearance=max(requirements.clearance, least))
