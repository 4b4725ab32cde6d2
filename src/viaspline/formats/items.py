"""What the MAVLink mission formats have in common: a list of items, a home, fences.

Tested through ``formats/test_qgc_plan``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, TypeAlias

if TYPE_CHECKING:
    from viaspline.mission.space.ground_spec import GroundSpec

LatLon: TypeAlias = tuple[float, float]

ABSOLUTE: Final = frozenset({0, 5})
"""MAV_FRAMEs whose altitude is above mean sea level."""

RELATIVE: Final = frozenset({3, 6})
"""MAV_FRAMEs whose altitude is above home."""

TERRAIN: Final = frozenset({10, 11})
"""MAV_FRAMEs whose altitude is above the terrain."""

GLOBAL: Final = ABSOLUTE | RELATIVE | TERRAIN
"""MAV_FRAMEs whose first two coordinates are latitude and longitude."""


@dataclass(frozen=True)
class Place:
    """Where something stands in a file.

    Attributes:
        key: Its key, e.g. ``mission.items[3]`` or ``item 3``.
        line: Its line, from 1, if that is known.
        column: Its column, from 1.
    """

    key: str
    line: int | None = None
    column: int | None = None


@dataclass(frozen=True)
class Item:
    """One mission item, as MAVLink has it.

    Attributes:
        number: What the file calls it.
        command: Its MAV_CMD.
        frame: Its MAV_FRAME.
        params: Parameters 1 to 4; NaN where there is none.
        latitude: Parameter 5 [deg]; NaN where there is none.
        longitude: Parameter 6 [deg]; NaN where there is none.
        altitude: Parameter 7 [m]; NaN where there is none.
        place: Where it stands.
        over_terrain: Height above the terrain that is meant [m], whatever the altitude says; NaN if
            it isn't one above terrain.
    """

    number: int
    command: int
    frame: int
    params: tuple[float, float, float, float]
    latitude: float
    longitude: float
    altitude: float
    place: Place
    over_terrain: float = math.nan

    @property
    def has_position(self) -> bool:
        """Whether it names a place; 0/0 means "here"."""
        is_finite = math.isfinite(self.latitude) and math.isfinite(self.longitude)
        is_here = self.latitude == 0 and self.longitude == 0
        return self.frame in GLOBAL and is_finite and not is_here


@dataclass(frozen=True)
class Home:
    """The home position.

    Attributes:
        latitude: [deg].
        longitude: [deg].
        altitude: Above mean sea level [m]; NaN if it isn't given.
        place: Where it stands.
    """

    latitude: float
    longitude: float
    altitude: float
    place: Place

    @property
    def is_plausible(self) -> bool:
        """Whether it can be meant: there, on the globe, and not 0/0."""
        is_there = math.isfinite(self.latitude) and math.isfinite(self.longitude)
        is_zero = self.latitude == 0 and self.longitude == 0
        return is_there and not is_zero and abs(self.latitude) <= 90 and abs(self.longitude) <= 360


@dataclass(frozen=True)
class FenceArea:
    """A fence: a polygon, or a circle.

    Attributes:
        inclusion: Whether the robot stays inside of it, not outside.
        corners: The polygon's corners [deg]; empty for a circle.
        center: The circle's middle [deg].
        radius: The circle's radius [m].
        place: Where it stands.
    """

    inclusion: bool
    corners: tuple[LatLon, ...]
    center: LatLon | None
    radius: float
    place: Place


@dataclass(frozen=True)
class Itinerary:
    """A whole file.

    Attributes:
        source: The file.
        items: The mission items in order, complex ones resolved.
        home: The home position, if there is one.
        fences: Inclusion and exclusion areas.
        speed: The speed that the file asks for [m/s], if it does.
        notes: What the file holds that a mission can't, or the other way round, by kind: where.
        origin: Where the mission's 0, 0 is [deg], if the file says so; else it is at the start.
        is_flat: Whether the file says that its heights mean nothing.
        ground: The ground, as it stands in a mission or read, if the file or who reads it says so;
            with it the way is one in space.
    """

    source: str
    items: tuple[Item, ...]
    home: Home | None = None
    fences: tuple[FenceArea, ...] = ()
    speed: float | None = None
    notes: tuple[tuple[str, str], ...] = ()
    origin: LatLon | None = None
    is_flat: bool = False
    ground: Mapping[str, Any] | GroundSpec | None = None
