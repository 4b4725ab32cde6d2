"""What ROS, Nav2, autopilots and other planners call what a mission's keys say.

Someone who comes from there writes their word, and is told ours. Each table goes with one class
(``KeyRules.foreign``); a remedy that says more than a key has the key before a colon.

Tested through ``mission/test_key_words``.
"""

from __future__ import annotations

from typing import Final

_PLACE: Final = "at: [x, y] in metres"
_ON_EARTH: Final = (
    "at: [x, y], in metres east and north of origin_deg; .plan and .waypoints files have latitudes"
)
_DIRECTION: Final = "heading_deg: in degrees, anticlockwise from x; it is the start's or the goal's"


def _all(ours: str, *theirs: str) -> dict[str, str]:
    return dict.fromkeys(theirs, ours)


MISSION: Final = {
    **_all("route", "mission", "waypoints", "via_points", "path"),
    **_all("robot", "vehicle", "agent"),
    **_all("world: {known: [...]}", "obstacles", "environment"),
}
ROUTE: Final = {
    **_all("via", "waypoints", "via_points", "viapoints", "points", "poses", "stops"),
    **_all("goal", "end", "target", "finish"),
    **_all("closed", "loop", "cyclic"),
    **_all("laps", "loops", "repeat", "repeats", "rounds"),
}
POINT: Final = {
    **_all(_PLACE, "x", "y", "z", "pos", "position", "pose", "point", "xy", "xyz", "center"),
    **_all(_ON_EARTH, "lat", "lon", "lng", "latitude", "longitude"),
    **_all(_DIRECTION, "yaw", "yaw_deg", "theta", "heading"),
    **_all("dwell_s", "wait", "wait_s", "hold", "hold_s", "pause", "pause_s", "stop", "duration"),
}
ROBOT: Final = {
    **_all("radius_m", "robot_radius"),
    **_all("footprint: the corners [[x, y], ...] about the axle", "size", "width", "length"),
    **_all("clearance_m", "inflation_radius", "inflation", "margin", "safety_margin", "padding"),
    **_all("max_speed_mps", "speed", "speed_mps", "max_vel_x", "max_velocity", "max_vel"),
    **_all("max_accel_mps2", "acceleration", "acc_lim_x", "max_acc"),
    **_all("max_yaw_rate_degps", "max_yaw_rate", "max_vel_theta", "max_rotational_vel"),
    **_all("min_turn_radius_m", "turn_radius", "turning_radius", "minimum_turning_radius"),
    **_all("drive", "kinematics", "motion_model", "type", "model"),
    **_all("sensor: {range_m: 8}", "sensor_range", "range", "obstacle_max_range"),
}
WORLD: Final = {
    **_all("known", "obstacles", "static_obstacles", "no_go", "keepout", "exclusion"),
    **_all("unseen", "unknown", "hidden", "dynamic_obstacles"),
    **_all("fences", "fence", "geofence", "inclusion"),
    **_all("bounds: [x_min, y_min, x_max, y_max] in metres", "size", "width", "limits", "extent"),
    **_all("origin_deg", "origin", "home", "datum"),
    **_all("known: [{map: a.yaml}]", "image", "grid", "occupancy_grid", "costmap"),
}
OBSTACLE: Final = {
    **_all("polygon: [[x, y], ...] in metres", "rect", "rectangle", "vertices", "points"),
    **_all("circle: {center: [x, y], radius: 5}", "cylinder", "center", "radius", "disc"),
    **_all("height_m", "heights", "z"),
    **_all("ball", "sphere"),
}
CIRCLE: Final = {
    **_all("center: [x, y] in metres", "x", "y", "pos", "position", "at"),
    **_all("radius: half of the diameter, in metres", "diameter"),
}
