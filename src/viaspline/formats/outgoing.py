"""From a mission in metres to an itinerary in degrees: the way back of ``interpret``.

Tested through ``formats/test_waypoint_format``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from viaspline.errors import OutputError
from viaspline.formats.flown_items import OVER_HOME, WAYPOINT, flown_items
from viaspline.formats.items import FenceArea, Home, Item, Itinerary, LatLon, Place
from viaspline.formats.known_heights import check_known_home
from viaspline.formats.local_frame import MAX_REACH_M, LocalFrame
from viaspline.formats.losses import losses
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import ViaPoint
from viaspline.mission.shapes.rounded_ring import Loop, RoundedRing
from viaspline.mission.space.flight_places import ground_height


def itinerary_of(mission: Mission, origin: LatLon | None) -> Itinerary:
    """The way points, home and fences of a mission, its notes being what they can't carry.

    Home is the start. Heights are above home; those of a flat mission are 0. Obstacles are
    exclusion areas, fences and bounds inclusion areas; polygons come before circles. What is round
    without being a disc is written as a polygon around it.

    Args:
        mission: The mission.
        origin: Latitude and longitude of the mission's 0, 0 [deg].

    Raises:
        OutputError: There is no origin or it can't be meant, or the mission reaches too far from
            it for a flat frame, or nobody knows how high the ground is under the start.
    """
    frame = _frame(origin)
    if mission.is_spatial:
        return _in_space(mission, frame)
    points = list(_way(mission))
    places = _places(frame, np.array([point.at[:2] for point in points]))
    items = tuple(
        _item(number, point, place)
        for number, (point, place) in enumerate(zip(points, places, strict=True), start=1)
    )
    home = Home(*places[0], 0.0, Place("plannedHomePosition"))
    return Itinerary(
        source="<mission>",
        items=items,
        home=home,
        fences=(*_polygons(mission, frame), *_circles(mission, frame)),
        speed=mission.robot.max_speed_mps,
        notes=losses(mission),
        origin=(frame.latitude, frame.longitude),
        is_flat=len(mission.route.start.at) == 2,
    )


def _in_space(mission: Mission, frame: LocalFrame) -> Itinerary:
    """The items of a mission in space; home is on the ground under the start."""
    ground = mission.world.ground
    x, y = mission.route.start.at[:2]
    sea = 0.0 if ground is None else ground_height(ground, x, y)
    check_known_home(sea)
    flown = list(flown_items(mission))
    named = [item.at for item in flown if item.at is not None]
    (home, *places) = _places(frame, np.array([(x, y), *named]))
    left = iter(places)
    items = tuple(
        item.item(number, *(next(left) if item.at is not None else (0.0, 0.0)))
        for number, item in enumerate(flown, start=1)
    )
    return Itinerary(
        source="<mission>",
        items=items,
        home=Home(*home, sea, Place("plannedHomePosition")),
        fences=(*_polygons(mission, frame), *_circles(mission, frame)),
        speed=mission.robot.max_speed_mps,
        notes=losses(mission),
        origin=(frame.latitude, frame.longitude),
        ground=None if ground is None else ground.model_dump(exclude_defaults=True),
    )


def lost_of(itinerary: Itinerary, *more: tuple[str, str]) -> tuple[str, ...]:
    """What an itinerary can't carry, and what its file can't, in lines."""
    return tuple(f"{kind}: {where}" if where else kind for kind, where in (*itinerary.notes, *more))


def _frame(origin: LatLon | None) -> LocalFrame:
    if origin is None:
        problem = "the file holds latitudes and longitudes, but the mission has no origin"
        raise OutputError("<mission>", f"{problem}; give the latitude and longitude of its 0, 0")
    latitude, longitude = origin
    is_on_globe = abs(latitude) <= 90 and abs(longitude) <= 180
    if not is_on_globe or (latitude == 0 and longitude == 0):
        problem = f"{latitude:g}, {longitude:g} can't be the origin"
        remedy = "latitudes are -90 to 90, longitudes -180 to 180 degrees, and 0, 0 means nowhere"
        raise OutputError("<mission>", f"{problem}; {remedy}")
    return LocalFrame(latitude, longitude)


def _way(mission: Mission) -> Iterator[ViaPoint]:
    """The points in order; a closed route ends where it starts."""
    for _, point in mission.route.points():
        yield point
    if mission.route.closed:
        yield ViaPoint(at=mission.route.start.at)


def _item(number: int, point: ViaPoint, place: LatLon) -> Item:
    height = point.at[2] if len(point.at) > 2 else 0.0
    params = (point.dwell_s, 0.0, 0.0, math.nan)
    return Item(number, WAYPOINT, OVER_HOME, params, *place, height, Place(f"item {number}"))


def _polygons(mission: Mission, frame: LocalFrame) -> Iterator[FenceArea]:
    world = mission.world
    rings: list[tuple[bool, Loop]] = [(True, ring) for ring in world.fences]
    if world.bounds is not None:
        x, y, right, top = world.bounds
        rings.append((True, ((x, y), (right, y), (right, top), (x, top))))
    rings += [(False, ring.polygon_around()[0]) for ring in _exclusions(mission, discs=False)]
    for inclusion, ring in rings:
        yield FenceArea(inclusion, _places(frame, np.array(ring)), None, 0.0, Place("geoFence"))


def _circles(mission: Mission, frame: LocalFrame) -> Iterator[FenceArea]:
    for ring in _exclusions(mission, discs=True):
        (center,) = _places(frame, ring.vertices)
        yield FenceArea(False, (), center, ring.radius, Place("geoFence"))


def _exclusions(mission: Mission, *, discs: bool) -> Iterator[RoundedRing]:
    """Obstacles on the map that fence circles are for, or those that they are not for."""
    for obstacle in mission.world.standing:
        ring = obstacle.ring
        if ring is not None and ring.is_disc == discs:
            yield ring


def _places(frame: LocalFrame, local: Floats) -> tuple[LatLon, ...]:
    """Latitudes and longitudes [deg] of places in metres, shape (n, 2), to a tenth of a mm."""
    if np.hypot(local[:, 0], local[:, 1]).max() > 0.9 * MAX_REACH_M:
        problem = f"the mission reaches more than {0.9 * MAX_REACH_M / 1e3:g} km from its origin"
        raise OutputError("<mission>", f"{problem}; a file of way points has one flat frame")
    latitudes, longitudes = frame.to_geodetic(local)
    pairs = zip(latitudes.round(10).tolist(), longitudes.round(10).tolist(), strict=True)
    # Adding zero turns -0.0 into 0.0: one place, one spelling.
    return tuple((latitude + 0.0, longitude + 0.0) for latitude, longitude in pairs)
