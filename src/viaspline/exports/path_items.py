"""A path as MAVLink mission items: way points, speeds, take-off and landing.

Tested through ``exports/test_plan_of_path``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from viaspline.exports.path_table import PathTable
from viaspline.formats.commands import CHANGE_SPEED
from viaspline.formats.flown_items import LAND, MISSION_FRAME, OVER_HOME, TAKEOFF, WAYPOINT
from viaspline.formats.items import FenceArea, Home, Item, Itinerary, Place
from viaspline.formats.known_heights import check_known_home
from viaspline.mission.space.ground_spec import GroundSpec

GROUND_SPEED = 1.0
"""MAV_CMD_DO_CHANGE_SPEED's kind of speed."""

KEEP_THROTTLE = -1.0


def path_itinerary(table: PathTable, fences: tuple[FenceArea, ...]) -> Itinerary:
    """Home and the items of a path.

    Take-off and landing are one item each. Way points carry dwells as hold times, the acceptance
    radius, and headings where the mission asks for others than along the path. Before each line
    whose speed is another one than before stands a change of the speed over ground. Heights are
    above home.

    Args:
        table: The path.
        fences: What stands beside it.

    Raises:
        OutputError: Nobody knows how high home is.
    """
    check_known_home(table.home)
    items = tuple(
        Item(number, *rest)  # one after the other
        for number, rest in enumerate(_items(table), start=1)
    )
    latitude, longitude = table.places[0].tolist()
    home = Home(latitude, longitude, _sea(table), Place("plannedHomePosition"))
    return Itinerary(
        source=table.name,
        items=items,
        home=home,
        fences=fences,
        speed=table.mission.robot.max_speed_mps,
        origin=table.origin,
        is_flat=not table.has_heights,
    )


_Rest = tuple[int, int, tuple[float, float, float, float], float, float, float, Place]


def _items(table: PathTable) -> Iterator[_Rest]:
    speed = math.nan
    end = len(table.points) - 1
    first, last = table.airborne or (0, end)
    route = table.mission.route
    for k in range(len(table.points)):
        if 0 < k < first or last < k < end:
            continue  # on an upright leg, which is one item whatever corners it has
        if k > 0 and _level_share(table, k - 1) > 1e-6:
            wanted = _set_speed(table, k - 1)
            if wanted != speed:
                speed = wanted
                params = (GROUND_SPEED, speed, KEEP_THROTTLE, 0.0)
                yield CHANGE_SPEED, MISSION_FRAME, params, 0.0, 0.0, 0.0, Place("speed")
        if route.takeoff is not None and k < first:
            yield _placed(table, k, TAKEOFF, height=first)
        elif route.takeoff is not None and k == first and table.dwells[k] == 0.0:
            continue  # the take-off leads there
        elif route.land is not None and k > last:
            yield _placed(table, k, LAND, height=k)
        else:
            yield _placed(table, k, WAYPOINT, height=k)


def _placed(table: PathTable, k: int, command: int, *, height: int) -> _Rest:
    latitude, longitude = table.places[k].tolist()
    altitude = float(table.heights[height] - table.home)
    params = (0.0, 0.0, 0.0, math.nan)
    if command == WAYPOINT:
        params = (float(table.dwells[k]), table.proof.acceptance or 0.0, 0.0, _yaw(table, k))
    elif command == LAND:
        # It comes down to the ground, which is below the body's reference point.
        ground = table.mission.world.ground
        altitude = _ground_under(table, k, ground) - table.home
    return command, OVER_HOME, params, latitude, longitude, altitude, Place(f"point {k}")


def _ground_under(table: PathTable, k: int, ground: GroundSpec | None) -> float:
    x, y = table.points[k, :2].tolist()
    return 0.0 if ground is None else float(ground.heights_at((x, y)))


def _yaw(table: PathTable, k: int) -> float:
    """The heading as a compass has it [deg], NaN where the vehicle looks along its path."""
    if not table.looks_elsewhere:
        return math.nan
    return round((90.0 - math.degrees(float(table.headings[k]))) % 360.0, 3)


def _level_share(table: PathTable, k: int) -> float:
    """Of the length of a line, how much of it is over ground."""
    step = table.points[k + 1] - table.points[k]
    length = float(np.linalg.norm(step))
    return float(np.hypot(step[0], step[1])) / length if length > 0.0 else 0.0


def _set_speed(table: PathTable, k: int) -> float:
    """The speed over ground that is set for a line [m/s]: centimetres, never more than may be."""
    speed = float(table.line_speeds[k]) * _level_share(table, k)
    return max(math.floor(100.0 * speed + 1e-6) / 100.0, 0.01)


def _sea(table: PathTable) -> float:
    """How high home is above sea level [m]; 0 if nobody knows."""
    return table.home
