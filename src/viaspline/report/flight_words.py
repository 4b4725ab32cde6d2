"""A mission in space in a few words."""

from __future__ import annotations

import math
from itertools import pairwise

from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.space.flight_places import flight_places
from viaspline.mission.world_spec import WorldSpec
from viaspline.report.units import metres


def flown_places(parts: MissionParts) -> list[tuple[float, float, float]]:
    """The places of a flight in order [m]: from the ground, if it takes off, to where it lands."""
    found = flight_places(parts)
    ends = [found.goal, found.landing]
    begin = [found.start, *([found.takeoff] if found.takeoff is not None else [])]
    if parts.route.closed:
        ends.append(begin[-1])
    return [*begin, *found.via, *(place for place in ends if place is not None)]


def flight_words(parts: MissionParts) -> list[str]:
    """How far and how high it goes.

    >>> route = {"start": [0, 0], "takeoff": {"to_agl_m": 9}, "goal": [40, 0, 39]}
    >>> flight_words(MissionParts.model_validate({"route": route}))
    ['58.5 m from point to point', 'z 0.5 m to 39 m', 'takes off']
    """
    places = flown_places(parts)
    straight = sum(math.dist(a, b) for a, b in pairwise(places))
    heights = [z for _, _, z in places]
    words = [
        f"{metres(straight, 1)} from point to point",
        f"z {min(heights):g} m to {max(heights):g} m",
    ]
    words += ["takes off"] if parts.route.takeoff is not None else []
    return words + (["lands"] if parts.route.land is not None else [])


def height_words(world: WorldSpec) -> list[str]:
    """Ground and altitude band of a world.

    >>> height_words(WorldSpec(altitude={"max_m": 120}, ground={"flat_m": 0}))
    ['flat ground at 0 m', 'altitude up to 120 m above home']
    """
    words = []
    if world.ground is not None and world.ground.terrain is not None:
        terrain = world.ground.terrain
        words.append(f"terrain of {terrain.lowest:g} m to {terrain.highest:g} m")
    elif world.ground is not None:
        words.append(f"flat ground at {world.ground.flat_m:g} m")
    if world.altitude is not None:
        low, high = world.altitude.min_m, world.altitude.max_m
        least = "" if low is None else f"from {low:g} m "
        most = "" if high is None else f"up to {high:g} m "
        above = {"home": "above home", "ground": "above ground", "amsl": "above sea level"}
        words.append(f"altitude {least}{most}{above[world.altitude.above]}")
    return words
