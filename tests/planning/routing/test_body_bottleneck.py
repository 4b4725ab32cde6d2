"""Gaps too narrow for a convex body, held against a search of all its poses by shapely."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy import ndimage

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.routing.bottleneck import body_bottleneck, gaps_for_body
from viaspline.world.world import World

SIDE_M = 12.0
CELL_M, TURNS = 0.1, 72
KEPT_M = 0.05
BODIES = {
    "car": [(-0.2, -0.5), (1.8, -0.5), (1.8, 0.5), (-0.2, 0.5)],
    "wedge": [(-0.3, -0.6), (2.0, -0.1), (2.0, 0.1), (-0.3, 0.6)],
    "sledge": [(-0.2, -1.2), (0.4, -1.0), (0.4, 1.0), (-0.2, 1.2)],
}


@dataclass(frozen=True)
class Scene:
    """A world, a body, and two places in it."""

    world: World
    things: shapely.Geometry
    body: str
    start: tuple[float, float]
    goal: tuple[float, float]

    @property
    def requirements(self) -> Requirements:
        corners = tuple(BODIES[self.body])
        radius = float(shapely.Polygon(corners).exterior.distance(shapely.Point(0, 0)))
        return Requirements(radius=radius, clearance=KEPT_M, footprint=corners)

    @property
    def is_refused(self) -> bool:
        gaps = gaps_for_body(self.world, self.requirements)
        ends = np.array(self.start), np.array(self.goal)
        return body_bottleneck(gaps, *ends, self.requirements) is not None

    def gets_there(self) -> bool:
        """Whether a chain of poses leads there whose neighbours a grown body holds as well."""
        poses = self._free_poses()
        labels = ndimage.label(poses, ndimage.generate_binary_structure(3, 1))[0]
        joined = _joined_round(labels)
        first, last = (self._rooms(labels, joined, place) for place in (self.start, self.goal))
        return bool(first & last)

    def _free_poses(self) -> np.ndarray:
        """Which poses a body may take that is grown by what it moves on the way to the next."""
        corners = np.array(BODIES[self.body])
        reach = float(np.hypot(*corners.T).max())
        grown = KEPT_M + 0.5 * CELL_M + 0.5 * reach * math.tau / TURNS
        solid = self.things.buffer(grown, quad_segs=32)
        inside = shapely.box(0, 0, SIDE_M, SIDE_M).buffer(-grown)
        shapely.prepare([solid, inside])
        at = np.arange(0.5 * CELL_M, SIDE_M, CELL_M)
        x, y = np.meshgrid(at, at)
        free = np.zeros((TURNS, *x.shape), bool)
        room = shapely.distance(self.things, shapely.points(x, y))
        for k in range(TURNS):
            c, s = math.cos(k * math.tau / TURNS), math.sin(k * math.tau / TURNS)
            turned = corners @ np.array([(c, s), (-s, c)])
            near = np.nonzero(room > 0.0)
            places = np.column_stack((x[near], y[near]))
            rings = shapely.polygons(places[:, None] + turned)
            free[(k, *near)] = ~shapely.intersects(solid, rings) & shapely.contains(inside, rings)
        return free

    def _rooms(
        self, labels: np.ndarray, joined: np.ndarray, place: tuple[float, float]
    ) -> set[int]:
        """The rooms of poses in which a body is that stands at a place, in any heading."""
        column, row = (int(value / CELL_M) for value in place)
        return set(joined[labels[:, row, column]].tolist()) - {0}


def _joined_round(labels: np.ndarray) -> np.ndarray:
    """For each label the least of those that it is joined to where the headings begin anew."""
    joined = np.arange(labels.max() + 1)
    pairs = {
        (int(a), int(b)) for a, b in zip(labels[-1].flat, labels[0].flat, strict=True) if a and b
    }
    for _ in range(len(joined)):
        before = joined.copy()
        for a, b in pairs:
            joined[a] = joined[b] = min(joined[a], joined[b])
        joined = joined[joined]
        if (joined == before).all():
            break
    return joined


def random_scene(seed: int, body: str) -> Scene:
    """Walls and discs with gaps about as wide as the body, which may begin in one of them."""
    rng = np.random.default_rng(seed)
    x, gap = rng.uniform(4, 8), rng.uniform(0.5, 2.6)
    low = rng.uniform(2, 8)
    tilt, thick = rng.uniform(-2, 2), rng.uniform(0.02, 0.6)
    known = [
        Obstacle(capsule={"from": first, "to": last, "radius": 0.5 * thick})
        for first, last in (
            ((x - tilt, -1.0), (x, low)),
            ((x, low + gap), (x + tilt, SIDE_M + 1.0)),
        )
    ]
    known += [
        Obstacle(circle={"center": centre.tolist(), "radius": rng.uniform(0.2, 1.2)})
        for centre in rng.uniform(0, SIDE_M, (int(rng.integers(0, 4)), 2))
    ]
    world = World(known, bounds=(0, 0, SIDE_M, SIDE_M))
    things = shapely.union_all(
        [o.ring.core().buffer(o.ring.radius, quad_segs=64) for o in known if o.ring is not None]
    )
    start, goal = rng.uniform(0.5, SIDE_M - 0.5, (2, 2))
    if rng.random() < 0.3:
        start = np.array([x, low + 0.5 * gap]) + rng.normal(0, 0.6, 2)
    return Scene(world, things, body, tuple(start.tolist()), tuple(goal.tolist()))


@given(seed=st.integers(0, 2**32), body=st.sampled_from(sorted(BODIES)))
@settings(deadline=None, max_examples=12)
@pytest.mark.long_without_jit
def test_what_a_body_can_be_moved_to_is_never_refused(seed: int, body: str) -> None:
    scene = random_scene(seed, body)
    room = scene.world.distance(np.array([scene.start, scene.goal]))
    assume(room.min() > scene.requirements.required)
    if scene.is_refused:
        assert not scene.gets_there()


def door(body: str, width: float) -> Scene:
    low = 6.0 - 0.5 * width
    known = [
        Obstacle(polygon=[(5.8, -1), (6.2, -1), (6.2, low), (5.8, low)]),
        Obstacle(polygon=[(5.8, low + width), (6.2, low + width), (6.2, 13), (5.8, 13)]),
    ]
    things = shapely.union_all([shapely.Polygon(one.polygon) for one in known])
    world = World(known, bounds=(0, 0, SIDE_M, SIDE_M))
    return Scene(world, things, body, (3.0, 6.0), (9.0, 6.0))


@pytest.mark.parametrize("body", sorted(BODIES))
@given(more=st.floats(1e-4, 0.5))
@settings(deadline=None, max_examples=10)
def test_a_door_is_refused_below_the_width_of_the_body_and_not_above(
    body: str, more: float
) -> None:
    corners = np.array(BODIES[body])
    angles = np.linspace(0.0, math.pi, 20_001)
    across = np.ptp(corners @ np.stack((np.cos(angles), np.sin(angles))), axis=0)
    needed = float(across.min()) + 2.0 * KEPT_M
    assert door(body, needed - more).is_refused
    assert not door(body, needed + more).is_refused


def test_a_body_that_stands_in_a_gap_may_go_on_through_it() -> None:
    """A part of it is through already: nothing is known of how wide that is."""
    wedge = door("wedge", 1.2)
    assert wedge.is_refused
    ahead = Scene(wedge.world, wedge.things, "wedge", (4.6, 6.0), wedge.goal)
    assert not ahead.is_refused


def test_a_body_that_is_not_convex_is_known_by_its_inner_disc_only() -> None:
    corners = ((-0.3, -0.3), (2.0, -0.3), (2.0, 2.0), (1.4, 2.0), (1.4, 0.3), (-0.3, 0.3))
    chair = Requirements(radius=0.3, clearance=KEPT_M, footprint=corners)
    assert chair.narrowest_gap == 2.0 * chair.required
