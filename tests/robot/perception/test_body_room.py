"""How near a body comes to things along a path, held against shapely."""

from __future__ import annotations

import math

import numpy as np
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.requirements import Requirements
from viaspline.robot.perception.body_room import clear_places, room_along
from viaspline.world.outline import outline
from viaspline.world.world import World

VAN = ((-0.3, -0.35), (1.2, -0.35), (1.2, 0.35), (-0.3, 0.35))
NEEDS = Requirements(radius=0.3, clearance=0.1, footprint=VAN)
GAP = 0.1
posts = st.lists(st.tuples(st.floats(-1, 7), st.floats(-3, 3), st.floats(0.1, 0.6)), max_size=6)


def bend(aside: float, corner: float) -> Path:
    """A bend, and behind it a straight line on which the robot goes on after a turn on the spot."""
    first = [(0, 0), (1.5, 0), (2.5, aside), (4, aside)]
    way = np.array((math.cos(corner), math.sin(corner)))
    return Path([first, [np.array((4, aside)) + k * way for k in range(4)]], vias=[])


def bodies(path: Path, along: np.ndarray) -> np.ndarray:
    """The body on places of a path, as shapely polygons."""
    u = np.asarray(path.parameter(along))
    headings, places = np.asarray(path.heading(u)), np.asarray(path.evaluate(u))
    c, s = np.cos(headings)[:, None], np.sin(headings)[:, None]
    x, y = np.array(VAN).T
    corners = np.stack((places[:, :1] + c * x - s * y, places[:, 1:] + s * x + c * y), axis=-1)
    return np.asarray(shapely.polygons(corners))


def gaps(found: list[tuple[float, float, float]], path: Path, along: np.ndarray) -> np.ndarray:
    """From the body to the nearest disc, by shapely [m]."""
    middles = shapely.points([post[:2] for post in found])
    apart = shapely.distance(bodies(path, along)[:, None], middles[None])
    return np.asarray((apart - [post[2] for post in found]).min(axis=1))


def discs(found: list[tuple[float, float, float]]) -> World:
    return World([Obstacle(circle=Circle(center=(x, y), radius=r)) for x, y, r in found])


@given(posts.filter(bool), st.floats(-1.5, 1.5), st.floats(-2, 2))
def test_the_room_of_a_polygon_is_what_lies_between_it_and_the_nearest_thing(
    found: list[tuple[float, float, float]], aside: float, corner: float
) -> None:
    path = bend(aside, corner)
    along = np.linspace(0.01, path.length - 0.01, 40)
    room = room_along(discs(found), path, along, NEEDS)
    apart = np.maximum(gaps(found, path, along), 0.0)
    np.testing.assert_allclose(room, NEEDS.radius + apart, atol=1e-9)


@given(posts, st.floats(-1.5, 1.5), st.floats(-2, 2), st.floats(0, 1.5))
@example([(4.0, 1.0, 0.5)], 0.0, 1.0, 1.5)  # a place that is looked at is where it would turn
@settings(max_examples=200)
def test_a_polygon_takes_the_places_up_to_which_it_keeps_its_distance_and_no_more(
    found: list[tuple[float, float, float]], aside: float, corner: float, start: float
) -> None:
    path = bend(aside, corner)
    along = np.append(np.arange(start + 0.05, path.length, 0.07), path.length)
    count = clear_places(discs(found), path, start, along, outline(VAN), GAP)
    if not found:
        assert count == len(along)
        return
    joint = float(path.distance(1.0))
    if count:
        last = along[count - 1]
        last -= 1e-6 if abs(last - joint) < 1e-9 else 0.0  # there it hasn't turned yet
        kept = gaps(found, path, np.linspace(start, last, 300))
        assert kept.min() >= GAP - 1e-9
    if count < len(along):
        turns = start < joint <= along[count] + 1e-9
        missed = gaps(found, path, np.linspace(start, along[count], 600))
        assert turns or missed.min() < GAP + 1e-3
