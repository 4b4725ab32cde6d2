"""From a mission in space to mission items: the way back of ``flights``.

Tested through ``formats/test_flights``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final, NamedTuple

from viaspline.formats.items import Item, Place
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import ViaPoint
from viaspline.mission.shapes.solids import Place as Place3
from viaspline.mission.space.flight_places import flight_places, place_of

WAYPOINT: Final = 16
LAND: Final = 21
TAKEOFF: Final = 22
LOOK_AT: Final = 195
LOOK_AHEAD: Final = 197
OVER_HOME: Final = 3
"""MAV_FRAME_GLOBAL_RELATIVE_ALT."""
OVER_TERRAIN_FRAME: Final = 10
"""MAV_FRAME_GLOBAL_TERRAIN_ALT."""
MISSION_FRAME: Final = 2
"""MAV_FRAME_MISSION: the item names no place."""


class FlownItem(NamedTuple):
    """An item whose place is still in metres.

    Attributes:
        command: Its MAV_CMD.
        frame: Its MAV_FRAME.
        params: Parameters 1 to 4.
        at: x, y [m]; None where it names no place.
        altitude: In its frame [m].
        key: What of the mission it is.
    """

    command: int
    frame: int
    params: tuple[float, float, float, float]
    at: tuple[float, float] | None
    altitude: float
    key: str

    def item(self, number: int, latitude: float, longitude: float) -> Item:
        """The item with its place in degrees."""
        over = self.altitude if self.frame == OVER_TERRAIN_FRAME else math.nan
        return Item(
            number, self.command, self.frame, self.params, latitude, longitude, self.altitude,
            Place(f"item {number}"), over,
        )  # fmt: skip


def flown_items(mission: Mission) -> Iterator[FlownItem]:
    """The items of a mission in space, home left out.

    Heights above ground are altitudes above terrain, all others are above home.
    """
    route, ground = mission.route, mission.world.ground
    places = flight_places(mission)
    x, y, _ = places.start
    looked_at: Place3 | None = None
    for key, point in route.points():
        if point.look_at != looked_at:
            looked_at = point.look_at
            yield _look(looked_at, places.home, key)
        if route.takeoff is not None and key == "route.start":
            height = route.takeoff.to_agl_m
            params = (0.0, 0.0, 0.0, math.nan)
            yield FlownItem(TAKEOFF, OVER_HOME, params, (x, y), height, "route.takeoff")
            if point.dwell_s:
                # It stays where its climb ends.
                params = (point.dwell_s, 0.0, 0.0, math.nan)
                yield FlownItem(WAYPOINT, OVER_HOME, params, (x, y), height, key)
            continue
        yield _way_point(point, place_of(point, ground), places.home, key)
    if route.closed:
        start = place_of(route.start, ground)
        end = places.takeoff if places.takeoff is not None else start
        params = (0.0, 0.0, 0.0, math.nan)
        height = end[2] - places.home
        yield FlownItem(WAYPOINT, OVER_HOME, params, (x, y), height, "route.start")
    if places.landing is not None and route.land is not None:
        u, v = route.land.at
        low = 0.0 if ground is None else float(ground.heights_at((u, v))) - places.home
        params = (0.0, 0.0, 0.0, math.nan)
        yield FlownItem(LAND, OVER_HOME, params, (u, v), low, "route.land")


def _look(at: Place3 | None, home: float, key: str) -> FlownItem:
    params = (0.0, 0.0, 0.0, 0.0)
    if at is None:
        return FlownItem(LOOK_AHEAD, MISSION_FRAME, params, None, 0.0, key)
    return FlownItem(LOOK_AT, OVER_HOME, params, at[:2], at[2] - home, key)


def _way_point(point: ViaPoint, place: Place3, home: float, key: str) -> FlownItem:
    params = (point.dwell_s, 0.0, 0.0, math.nan)
    at = (point.at[0], point.at[1])
    if point.agl_m is not None:
        return FlownItem(WAYPOINT, OVER_TERRAIN_FRAME, params, at, point.agl_m, key)
    return FlownItem(WAYPOINT, OVER_HOME, params, at, place[2] - home, key)
