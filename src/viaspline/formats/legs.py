"""From mission items to stops: where the vehicle goes, how high, and how long it stays.

Tested through ``formats/test_qgc_plan``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Final

from viaspline.formats.commands import (
    CHANGE_SPEED,
    DELAYS,
    DWELLING,
    FENCE_COMMANDS,
    HEADED,
    HOME_RETURN,
    LANDINGS,
    LOOKS_AHEAD,
    LOOKS_AT,
    PLACES,
    TAKEOFFS,
    UNLIMITED_LOITER,
    command_name,
)
from viaspline.formats.first_speed import first_speed
from viaspline.formats.items import ABSOLUTE, GLOBAL, RELATIVE, TERRAIN, Item, Itinerary, Place

OVER_TERRAIN: Final = "altitude above terrain, and no terrain is given: heights are left out"

OVER_SEA: Final = "altitude above terrain, taken by the altitude above sea level that it has there"

NO_HOME_ALTITUDE: Final = "altitude above sea level without a home altitude, taken from the first"


@dataclass(frozen=True)
class Stop:
    """A place on the way.

    Attributes:
        latitude: [deg].
        longitude: [deg].
        height: Above home or the first point [m]; NaN if it isn't known.
        dwell: How long to stay [s].
        place: Where it stands in the file.
        is_landing: Whether the height is reached on the spot after the way has ended.
        is_takeoff: Whether the height is reached on the spot before the way begins.
        altitude: Above mean sea level [m]; NaN if the file says another one.
        over_terrain: Above the terrain [m]; NaN if the file says another one.
        look_at: What the vehicle looks at from there on; None: nothing.
        is_home: Whether it is the home position, which no item goes to.
    """

    latitude: float
    longitude: float
    height: float
    dwell: float
    place: Place
    is_landing: bool = False
    is_takeoff: bool = False
    altitude: float = math.nan
    over_terrain: float = math.nan
    look_at: Item | None = None
    is_home: bool = False


@dataclass
class _Log:
    """What can't be represented: kind, and the numbers of the items."""

    kinds: dict[str, list[int]] = field(default_factory=dict)

    def note(self, kind: str, item: Item) -> None:
        self.kinds.setdefault(kind, []).append(item.number)

    def notes(self) -> tuple[tuple[str, str], ...]:
        return tuple((kind, _numbered(numbers)) for kind, numbers in self.kinds.items())


def _numbered(numbers: list[int]) -> str:
    """Item numbers in words.

    >>> _numbered([3]), _numbered([3, 5])
    ('item 3', 'items 3, 5')
    """
    shown = ", ".join(map(str, numbers[:12])) + (
        f" and {len(numbers) - 12} more" if len(numbers) > 12 else ""
    )
    return f"item {shown}" if len(numbers) == 1 else f"items {shown}"


def stops_of(itinerary: Itinerary) -> tuple[tuple[Stop, ...], tuple[tuple[str, str], ...]]:
    """The stops of an itinerary in order, and what of it can't be represented.

    The first stop is the home position if the file has a plausible one, else the first item with
    a position. Return to launch and unlimited loiter end the way.
    """
    log = _Log()
    ground, speed = _ground(itinerary, log), first_speed(itinerary)
    stops: list[Stop] = []
    home = itinerary.home
    if home is not None and home.is_plausible:
        stops.append(Stop(home.latitude, home.longitude, 0.0, 0.0, home.place, is_home=True))
    waiting = 0.0
    looked_at: Item | None = None
    for i, item in enumerate(itinerary.items):
        if item.command in FENCE_COMMANDS or item is speed:
            continue
        if item.command in DELAYS:
            waiting += _delay(item, log)
        elif item.command == HOME_RETURN:
            if stops:
                # No height is given; the vehicle comes back as high as it is and then descends.
                height, over_terrain = stops[-1].height, stops[-1].over_terrain
                back = replace(stops[0], dwell=0.0, place=item.place, is_home=False)
                back = replace(back, height=height, over_terrain=over_terrain, is_landing=True)
                stops.append(back)
            _rest(itinerary.items[i + 1 :], "after the return to launch", log)
            break
        elif item.command in PLACES:
            here = _stop(item, stops, ground, log)
            if here is not None:
                stops.append(replace(here, look_at=looked_at))
            if item.command == UNLIMITED_LOITER:
                _rest(itinerary.items[i + 1 :], "after the unlimited loiter", log)
                break
        else:
            if item.command in LOOKS_AT:
                looked_at = item if item.has_position else None
            elif item.command == LOOKS_AHEAD:
                looked_at = None
            log.note(_kind(item), item)
        if waiting and stops:
            stops[-1] = replace(stops[-1], dwell=stops[-1].dwell + waiting)
            waiting = 0.0
    return tuple(stops), log.notes()


def _ground(itinerary: Itinerary, log: _Log) -> float:
    """The altitude above sea level that counts as height 0 [m]."""
    home = itinerary.home
    absolute = [item for item in itinerary.items if _is_absolute(item)]
    if home is not None and home.is_plausible and math.isfinite(home.altitude):
        return home.altitude
    if not absolute:
        return 0.0
    if any(item.command in PLACES and item.frame in RELATIVE for item in itinerary.items):
        for item in absolute:
            log.note(NO_HOME_ALTITUDE, item)
    return absolute[0].altitude


def _is_absolute(item: Item) -> bool:
    return item.command in PLACES and item.frame in ABSOLUTE and math.isfinite(item.altitude)


def _stop(item: Item, stops: list[Stop], ground: float, log: _Log) -> Stop | None:
    """Where an item sends the vehicle; None if that can't be said."""
    if item.frame not in GLOBAL and _names_a_place(item):
        log.note(f"{command_name(item.command)} in frame {item.frame}, which isn't global", item)
        return None
    if math.isnan(item.latitude) != math.isnan(item.longitude):
        log.note(f"{command_name(item.command)} with half a position: left out", item)
        return None
    if item.command in HEADED and math.isfinite(item.params[3]) and item.params[3] != 0.0:
        log.note(f"{command_name(item.command)} with a heading", item)
    dwell = _dwell(item, log)
    if item.command in (18, 31, 94):
        log.note(f"{command_name(item.command)}: driven to, not carried out", item)
    height = item.altitude - ground if item.frame in ABSOLUTE else item.altitude
    height = math.nan if item.frame in TERRAIN else height
    if math.isfinite(item.over_terrain):
        log.note(OVER_TERRAIN if math.isnan(height) else OVER_SEA, item)
    if item.has_position:
        latitude, longitude = item.latitude, item.longitude
    elif stops:
        latitude, longitude = stops[-1].latitude, stops[-1].longitude
    else:
        log.note(f"{command_name(item.command)} here, before any position", item)
        return None
    return Stop(
        latitude,
        longitude,
        height,
        dwell,
        item.place,
        is_landing=item.command in LANDINGS,
        is_takeoff=item.command in TAKEOFFS,
        altitude=item.altitude if item.frame in ABSOLUTE else math.nan,
        over_terrain=item.over_terrain,
    )


def _names_a_place(item: Item) -> bool:
    """Whether there are coordinates, in whatever frame."""
    return any(math.isfinite(x) and x != 0 for x in (item.latitude, item.longitude))


def _dwell(item: Item, log: _Log) -> float:
    time = item.params[0]
    if item.command not in DWELLING or not math.isfinite(time):
        return 0.0
    if time < 0:
        log.note("negative hold time, taken as 0", item)
        return 0.0
    return time


def _delay(item: Item, log: _Log) -> float:
    """The seconds of a delay; one until a time of day can't be represented."""
    time = item.params[0]
    if math.isfinite(time) and time >= 0:
        return time
    log.note("delay until a time of day", item)
    return 0.0


def _kind(item: Item) -> str:
    name = command_name(item.command)
    if item.command == 177:
        return "jump: the way is driven once"
    if item.command in LOOKS_AT and not item.has_position:
        return f"{name} without a place on earth: looks ahead from there on"
    if item.command == CHANGE_SPEED:
        return "change of speed: robot.max_speed_mps holds for the whole way"
    return name


def _rest(items: tuple[Item, ...], when: str, log: _Log) -> None:
    for item in items:
        if item.command not in FENCE_COMMANDS:
            log.note(f"{command_name(item.command)} {when}", item)
