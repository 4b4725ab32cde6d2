"""Keys that mean something in the plane only, and what to do about them in space.

Tested through ``mission/space/test_spatial_checks``.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, Final

from viaspline.mission.unplaced_faults import Path, UnplacedFault, children

_FLIES_EXACTLY: Final = "a robot in space follows its path as it is; leave it out"
_REMEDIES: Final[dict[Path, str]] = {
    ("robot", "drive"): _FLIES_EXACTLY,
    ("robot", "localization"): _FLIES_EXACTLY,
    ("robot", "footprint"): "give radius_m, and half_height_m if the body is flatter than a ball",
    ("robot", "min_turn_radius_m"): "leave it out: max_lateral_accel_mps2 says how fast it turns",
    ("robot", "turn_on_spot"): "leave it out: a robot in space turns where it hovers",
    ("robot", "prefer_clearance_m"): "give clearance_m, which is kept everywhere",
    ("robot", "sensor", "lidar"): "give sensor: {range_m: 40}",
    ("route", "corridor"): "give gates or via points instead",
    ("route", "detours"): "leave it out",
    ("route", "start", "heading_deg"): "leave it out: route.yaw says where the robot looks",
    ("route", "goal", "heading_deg"): "leave it out: route.yaw says where the robot looks",
}


def planar_keys_of(mission: Any) -> Iterator[Path]:
    """Those that are given in a mission, or in its data, sound or not.

    >>> list(planar_keys_of({"robot": {"sensor": {"lidar": {"range_m": 5}}}}))
    [('robot', 'sensor', 'lidar')]
    """
    seen: dict[Path, Any] = {(): children(mission) or {}}  # what lies at each part of a path
    for path in _REMEDIES:
        for k in range(1, len(path)):
            if path[:k] not in seen:
                seen[path[:k]] = children(seen[path[: k - 1]].get(path[k - 1])) or {}
        value = seen[path[:-1]].get(path[-1])
        is_default = path[-1] == "prefer_clearance_m" and value == 0
        if value is not None and not is_default:
            yield path


def planar_key_faults(paths: Iterable[Path]) -> Iterator[UnplacedFault]:
    """A fault for each that is given in a mission in space."""
    for path in paths:
        yield UnplacedFault(path, "is for missions in the plane", _REMEDIES[path], at_key=True)
