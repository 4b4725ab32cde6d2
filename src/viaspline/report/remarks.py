"""What is sound in a mission, but may not be what was meant."""

from __future__ import annotations

from viaspline.mission.model import Mission


def remarks(mission: Mission) -> list[str]:
    """Sentences about limits that leave others without effect; none if all agree.

    >>> remarks(Mission.model_validate({
    ...     "robot": {"min_turn_radius_m": 2, "max_lateral_accel_mps2": 0.5, "max_speed_mps": 3},
    ...     "route": {"start": [0, 0], "goal": [9, 0]},
    ... }))
    ['max_speed 3 m/s is never reached on a turn of 2 m: max_lateral_accel 0.5 m/s² allows 1 m/s
      there; a radius of 18 m would allow it']
    """
    robot = mission.robot
    top = robot.max_speed_mps
    found = [
        f"speed zone {zone.name or i + 1!r} allows {zone.max_speed_mps:g} m/s, more than the "
        f"robot's max_speed_mps {top:g}"
        for i, zone in enumerate(mission.world.speed_zones)
        if zone.max_speed_mps > top
    ]
    if robot.turn_radius is not None:
        from viaspline.machine.machine_limits import limits_of

        found += limits_of(robot).conflicts(robot.turn_radius)
    return found
