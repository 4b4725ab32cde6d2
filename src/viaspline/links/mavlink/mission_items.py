"""Between itineraries and the items of the mission protocol."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final, TypeAlias

from viaspline.errors import LinkError
from viaspline.formats.commands import (
    CHANGE_SPEED,
    EXCLUSION_CIRCLE,
    EXCLUSION_CORNER,
    FENCE_COMMANDS,
    INCLUSION_CIRCLE,
    INCLUSION_CORNER,
)
from viaspline.formats.fences import fence_areas
from viaspline.formats.flown_items import MISSION_FRAME, OVER_HOME, WAYPOINT
from viaspline.formats.items import FenceArea, Home, Item, Itinerary, LatLon, Place
from viaspline.links.mavlink.common_messages import MissionItemInt
from viaspline.links.mavlink.mav_words import ARDUPILOT, FENCE, MISSION, RALLY
from viaspline.links.mavlink.vehicle import Vehicle

Lists: TypeAlias = dict[int, tuple[MissionItemInt, ...]]
"""Items by their MAV_MISSION_TYPE."""

RALLY_POINT: Final = 5100
_OVER_SEA: Final = 0
"""MAV_FRAME_GLOBAL."""
_GROUND_SPEED: Final = 1.0
_UNCHANGED: Final = -1.0
_MOST_ITEMS: Final = 65535


def lists_of(itinerary: Itinerary, rally: Sequence[tuple[float, float, float]] = ()) -> Lists:
    """The items of an itinerary, by what they are; home is not among them.

    The mission begins with the speed that is asked for, unless it sets speeds itself. Rally points
    are there if any are given.

    Args:
        itinerary: Its fences, its items and its speed count.
        rally: Latitude, longitude [deg] and height above home [m] of each.

    Raises:
        LinkError: There are more items than can be numbered.
        MissionError: A fence has too few corners or no radius.
    """
    mission = [_item(one) for one in itinerary.items if one.command not in FENCE_COMMANDS]
    sets_speeds = any(item.command == CHANGE_SPEED for item in mission)
    if itinerary.speed is not None and mission and not sets_speeds:
        mission.insert(0, _speed(itinerary.speed))
    fence = [item for area in fence_areas(itinerary)[0] for item in _fence(area)]
    found = {MISSION: _numbered(mission, MISSION), FENCE: _numbered(fence, FENCE)}
    if rally:
        points = [_placed(RALLY_POINT, OVER_HOME, (at, on), up) for at, on, up in rally]
        found[RALLY] = _numbered(points, RALLY)
    return found


def addressed(
    items: Sequence[MissionItemInt], kind: int, vehicle: Vehicle, home: Home | None
) -> tuple[MissionItemInt, ...]:
    """Items as they are sent to a vehicle: to its number, its home before the mission if it so has.

    ArduPilot keeps whole seconds and whole metres of rally points: they are rounded up for it.

    Args:
        items: Of one list.
        kind: Its MAV_MISSION_TYPE.
        vehicle: Who is to have them.
        home: Where the mission's home is.
    """
    sent = list(items)
    if kind == MISSION and vehicle.item_0_is_home and sent:
        place = (0.0, 0.0) if home is None else (home.latitude, home.longitude)
        height = 0.0 if home is None or math.isnan(home.altitude) else home.altitude
        sent.insert(0, _placed(WAYPOINT, _OVER_SEA, place, height))
    to = {"target_system": vehicle.system, "target_component": vehicle.component}
    if vehicle.autopilot == ARDUPILOT:
        sent = [_rounded(item) for item in sent]
    first = {0: 1} if kind == MISSION else {}
    return tuple(
        replace(item, seq=seq, current=first.get(seq, 0), **to) for seq, item in enumerate(sent)
    )


def _rounded(item: MissionItemInt) -> MissionItemInt:
    if item.command == WAYPOINT and math.isfinite(item.param1):
        return replace(item, param1=float(math.ceil(item.param1)))
    if item.command == RALLY_POINT and math.isfinite(item.z):
        return replace(item, z=float(math.ceil(item.z)))
    return item


def itinerary_on_board(lists: Lists, vehicle: Vehicle, source: str) -> Itinerary:
    """The itinerary that a vehicle has on board.

    Args:
        lists: Its items; those of a mission begin with its home if it so has.
        vehicle: Whose they are.
        source: How the itinerary is called in messages.
    """
    items = list(lists.get(MISSION, ()))
    home = None
    if items and vehicle.item_0_is_home:
        first = items.pop(0)
        home = Home(first.x / 1e7, first.y / 1e7, first.z, Place("item 0"))
    return Itinerary(
        source=source,
        items=tuple(_read(item, number) for number, item in enumerate(items, start=1)),
        home=home,
        fences=tuple(_areas(lists.get(FENCE, ()))),
        speed=next((one.param2 for one in items if one.command == CHANGE_SPEED), None),
    )


def _numbered(items: list[MissionItemInt], kind: int) -> tuple[MissionItemInt, ...]:
    if len(items) >= _MOST_ITEMS:
        problem = f"there are {len(items)} items, and {_MOST_ITEMS - 1} are the most"
        raise LinkError("the mission", problem, "send fewer, or with a larger tolerance")
    return tuple(replace(one, seq=seq, mission_type=kind) for seq, one in enumerate(items))


def _item(item: Item) -> MissionItemInt:
    place = (item.latitude, item.longitude) if item.has_position else (0.0, 0.0)
    height = 0.0 if math.isnan(item.altitude) else item.altitude
    placed = _placed(item.command, item.frame, place, height)
    one, two, three, four = item.params
    return replace(placed, param1=_real(one), param2=_real(two), param3=_real(three), param4=four)


def _real(param: float) -> float:
    """A parameter that autopilots don't take as NaN."""
    return 0.0 if math.isnan(param) else param


def _speed(speed: float) -> MissionItemInt:
    item = _placed(CHANGE_SPEED, MISSION_FRAME, (0.0, 0.0), 0.0)
    return replace(item, param1=_GROUND_SPEED, param2=speed, param3=_UNCHANGED)


def _placed(command: int, frame: int, place: LatLon, height: float) -> MissionItemInt:
    return MissionItemInt(
        param1=0.0, param2=0.0, param3=0.0, param4=0.0,
        x=round(place[0] * 1e7), y=round(place[1] * 1e7), z=height, seq=0, command=command,
        target_system=0, target_component=0, frame=frame, current=0, autocontinue=1,
        mission_type=MISSION,
    )  # fmt: skip


def _fence(area: FenceArea) -> Iterator[MissionItemInt]:
    if area.center is not None:
        command = INCLUSION_CIRCLE if area.inclusion else EXCLUSION_CIRCLE
        yield replace(_placed(command, _OVER_SEA, area.center, 0.0), param1=area.radius)
        return
    command = INCLUSION_CORNER if area.inclusion else EXCLUSION_CORNER
    for corner in area.corners:
        yield replace(_placed(command, _OVER_SEA, corner, 0.0), param1=float(len(area.corners)))


def _read(item: MissionItemInt, number: int) -> Item:
    params = (item.param1, item.param2, item.param3, item.param4)
    frame = {5: 0, 6: 3, 11: 10}.get(item.frame, item.frame)
    over = item.z if frame == 10 else math.nan
    place = Place(f"item {number}")
    return Item(
        number, item.command, frame, params, item.x / 1e7, item.y / 1e7, item.z, place, over
    )


def _areas(items: Iterable[MissionItemInt]) -> Iterator[FenceArea]:
    left = list(items)
    while left:
        first = left[0]
        inclusion = first.command in (INCLUSION_CORNER, INCLUSION_CIRCLE)
        place = Place(f"fence item {first.seq}")
        if first.command in (INCLUSION_CIRCLE, EXCLUSION_CIRCLE):
            yield FenceArea(inclusion, (), (first.x / 1e7, first.y / 1e7), first.param1, place)
            left = left[1:]
            continue
        count = max(int(first.param1), 1) if first.command in FENCE_COMMANDS else 1
        if first.command in FENCE_COMMANDS:
            corners = tuple((one.x / 1e7, one.y / 1e7) for one in left[:count])
            yield FenceArea(inclusion, corners, None, 0.0, place)
        left = left[count:]
