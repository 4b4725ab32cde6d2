"""What it costs a robot that it sees no farther than it does where unseen things may come."""

from __future__ import annotations

from viaspline.mission.model import Mission
from viaspline.trajectory.limits import REACTION_S
from viaspline.trajectory.passive_speed import passive_speed, room_for


def sight_remarks(mission: Mission) -> list[str]:
    """That passive safety holds a robot back or fast, and what would help; none if it doesn't.

    >>> robot = {"radius_m": 0.25, "max_speed_mps": 1, "moving": {"max_speed_mps": 1.5}}
    >>> route = {"start": [0, 0], "goal": [9, 0]}
    >>> robot["sensor"] = {"range_m": 0.5}
    >>> sight_remarks(Mission.model_validate({"robot": robot, "route": route}))
    ['max_speed_mps 1 is never reached on a straight line: seeing 0.5 m, the robot stands in time
      for what may come at 1.5 m/s (robot.moving) from 0.158 m/s at most; sensor.range_m 2.5 would
      allow it, and safety: none relies on what is foreseen instead']
    """
    robot = mission.robot
    things, sensor = robot.moving, robot.sensor
    if things is None or things.safety == "none" or mission.is_spatial:
        return []
    if sensor is None:
        return [
            "under passive safety (robot.moving) the robot never sets off: without a sensor it "
            "doesn't see that nothing comes; give robot.sensor, or safety: none"
        ]
    top, brake = robot.max_speed_mps, robot.max_brake_mps2 or robot.max_accel_mps2
    body = robot.outer_radius + (robot.tracking_error_m or 0.0)
    slow = passive_speed(sensor.reach - body, things.max_speed_mps, brake)
    if slow >= top:
        return []
    needed = body + room_for(top, things.max_speed_mps, brake, REACTION_S)
    key = "sensor.range_m" if sensor.lidar is None else "sensor.lidar.range_m"
    return [
        f"max_speed_mps {top:g} is never reached on a straight line: seeing {sensor.reach:g} m, "
        f"the robot stands in time for what may come at {things.max_speed_mps:g} m/s "
        f"(robot.moving) from {slow:.3g} m/s at most; {key} {needed:.3g} would allow it, and "
        "safety: none relies on what is foreseen instead"
    ]
