"""How a robot turns where it stands, and how long that takes it."""

from __future__ import annotations

import math
from typing import NamedTuple

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.mission.robot_parts import RobotSpec

PERIOD_S = 0.05
"""Time between two commands, if nothing else is said [s]."""

SPOT_RATE_RADPS = 1.0
"""Yaw rate of a turn on the spot, if the robot has no limit of its own [rad/s]."""

LAGS_PER_LOOP = 4.0
"""A control loop is so many times slower than its lag: then it is damped well."""

HEADING_GAIN_PER_S = 2.0
"""Of an error of the heading on the spot [1/s]."""

SETTLING_TIMES = 3.0
"""Time constants until a heading, or a direction of travel, is right."""


def is_driven(robot: RobotSpec) -> bool:
    """Whether a robot moves by a drive's laws, or doesn't know where it is exactly."""
    return robot.drive is not None or robot.localization is not None


def actuators_of(robot: RobotSpec) -> Actuators:
    """Those of its drive; without one they have no limits."""
    return Actuators() if robot.drive is None else robot.drive.kind.actuators()


def spot_rate_of(robot: RobotSpec) -> float:
    """The yaw rate with which a robot turns on the spot [rad/s].

    No faster than with both wheels at full speed, one backwards.
    """
    actuators, wheels = actuators_of(robot), math.inf
    if actuators.track > 0.0:
        wheels = 2.0 * actuators.max_wheel_speed * actuators.grip / actuators.track
    return min(SPOT_RATE_RADPS, math.radians(robot.max_yaw_rate_degps or math.inf), wheels)


def lag_of(robot: RobotSpec) -> float:
    """Time constant with which its velocity and its yaw rate follow [s]."""
    return 0.0 if robot.drive is None else robot.drive.lag_s


def heading_gain_of(robot: RobotSpec, period: float = PERIOD_S) -> float:
    """From an error of the heading to a yaw rate, on the spot [1/s].

    Args:
        robot: Of the mission.
        period: Time between two commands [s].
    """
    return min(HEADING_GAIN_PER_S, 1.0 / (LAGS_PER_LOOP * (lag_of(robot) + 0.5 * period)))


class SpotTurning(NamedTuple):
    """How a robot turns where it stands.

    Attributes:
        rate: [rad/s]; inf where turning takes no time, or nothing turns.
        settling: Until it goes on [s].
    """

    rate: float = math.inf
    settling: float = 0.0

    @classmethod
    def of(cls, robot: RobotSpec) -> SpotTurning:
        """That of a mission's robot; one without a drive keeps its yaw rate, if it has one.

        >>> round(SpotTurning.of(RobotSpec(max_yaw_rate_degps=90)).time(math.pi), 6)
        2.0
        """
        if not is_driven(robot):
            return cls(math.radians(robot.max_yaw_rate_degps or math.inf))
        return cls._of(
            actuators_of(robot), spot_rate_of(robot), heading_gain_of(robot), lag_of(robot)
        )

    @classmethod
    def of_model(cls, model: DriveModel) -> SpotTurning:
        """That of a drive. Steered wheels make no turns; a held heading only comes to rest."""
        return cls._of(model.actuators, model.spot_rate, model.heading_gain, model.lag)

    @classmethod
    def _of(cls, actuators: Actuators, rate: float, gain: float, lag: float) -> SpotTurning:
        if actuators.wheelbase > 0.0:
            return cls()
        if not math.isnan(actuators.held_heading):
            return cls(settling=SETTLING_TIMES * lag)
        return cls(rate, SETTLING_TIMES / gain + lag)

    def time(self, angle: float) -> float:
        """How long a turn takes [s], angle [rad]."""
        return abs(angle) / self.rate + self.settling


def foreseen_turning(robot: RobotSpec) -> SpotTurning:
    """How a robot is foreseen to turn at its stations, where paths are chosen.

    Its time law has no time for turns of one without a drive that isn't said to turn slowly. All
    the same it turns before it sets off, no faster than it is told to.

    >>> foreseen_turning(RobotSpec()).time(math.pi) == math.pi
    True
    """
    turning = SpotTurning.of(robot)
    return turning if is_driven(robot) else turning._replace(rate=told_rate_of(robot))


def told_rate_of(robot: RobotSpec) -> float:
    """How fast a robot without a drive is told to turn where it stands, at most [rad/s].

    >>> told_rate_of(RobotSpec()), round(told_rate_of(RobotSpec(max_yaw_rate_degps=90)), 3)
    (1.0, 1.571)
    >>> told_rate_of(RobotSpec(turn_on_spot="never"))
    0.0
    """
    if robot.max_yaw_rate_degps is not None:
        return math.radians(robot.max_yaw_rate_degps)
    return 0.0 if robot.turns_on_spot == "never" else SPOT_RATE_RADPS
