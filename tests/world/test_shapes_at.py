"""Shapes at an instant are the obstacles' shapes, moved and turned."""

from __future__ import annotations

import numpy as np
import shapely
import shapely.affinity
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.sensing.raycast import cast
from viaspline.kernels.world.distance import obstacle_distances
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.shapes_at import shapes_at

SHAPES = (
    {"circle": {"center": (0.3, -0.2), "radius": 0.7}},
    {"capsule": {"from": (-1.0, 0.0), "to": (1.5, 0.5), "radius": 0.3}},
    {"polygon": ((-1.0, -0.5), (1.0, -0.5), (1.5, 0.0), (1.0, 0.5), (-1.0, 0.5))},
)
places = st.tuples(st.floats(-8, 8), st.floats(-8, 8))
motions = st.tuples(st.integers(0, 2), places, places, st.floats(-400, 400), st.floats(-400, 400))


def obstacle(kind: int, at: tuple[float, float], to: tuple[float, float], *turned: float
             ) -> Obstacle:  # fmt: skip
    frames = [[0.0, *at, turned[0]], [10.0, *to, turned[1]]]
    motion = {"keyframes": frames, "after": "vanish", "before": "stay"}
    return Obstacle.model_validate({**SHAPES[kind], "motion": motion})


def as_shapely(kind: int, at: tuple[float, float], to: tuple[float, float], first: float,
               last: float, time: float) -> shapely.Geometry:  # fmt: skip
    part = min(max(time, 0.0), 10.0) / 10.0
    x, y = (1.0 - part) * np.array(at) + part * np.array(to)
    ring = Obstacle.model_validate(SHAPES[kind]).ring
    assert ring is not None
    angle = first + part * (last - first)
    turned = shapely.affinity.rotate(ring.outline(), angle, origin=(0, 0))
    return shapely.affinity.translate(turned, x, y)


@given(st.lists(motions, min_size=1, max_size=5), st.floats(-3, 9.9), places)
@settings(max_examples=60, deadline=None)
def test_distances_and_rays_are_those_of_the_moved_shapes(
    rows: list[tuple[int, tuple[float, float], tuple[float, float], float, float]],
    time: float,
    eye: tuple[float, float],
) -> None:
    packed = shapes_at(MovingObstacles(obstacle(*row) for row in rows), time)
    truth = [as_shapely(*row, time) for row in rows]
    for i, shape in enumerate(truth):
        distance = float(obstacle_distances(packed, i, np.array([eye]))[0])
        assert abs(max(distance, 0.0) - shapely.distance(shape, shapely.Point(eye))) < 1e-3
    if shapely.distance(shapely.union_all(truth), shapely.Point(eye)) < 1e-3:
        return
    ranges = cast(packed, *eye, 0.1, 0.7, 9, 20.0)
    for beam, measured in enumerate(ranges.tolist()):
        angle = 0.1 + 0.7 * beam
        ray = np.array(eye) + np.array([[0.0, 0.0], [20 * np.cos(angle), 20 * np.sin(angle)]])
        near = shapely.intersection(shapely.LineString(ray), shapely.union_all(truth))
        grazing = shapely.intersection(shapely.LineString(ray), truth[0].buffer(-2e-3))
        if near.is_empty:
            assert measured > 20.0 or grazing.is_empty
        elif len(rows) == 1 and not grazing.is_empty:
            assert abs(measured - shapely.distance(near, shapely.Point(eye))) < 0.1


def test_what_has_gone_is_hit_by_no_ray() -> None:
    rows = [(0, (3.0, 0.0), (3.0, 0.0), 0.0, 0.0), (0, (5.0, 0.0), (5.0, 0.0), 0.0, 0.0)]
    moving = MovingObstacles(obstacle(*row) for row in rows)
    assert np.isfinite(cast(shapes_at(moving, 10.0 - 1e-9), 0.0, 0.0, 0.0, 1.0, 1, 9.0)).all()
    assert np.isinf(cast(shapes_at(moving, 10.1), 0.0, 0.0, 0.0, 1.0, 1, 9.0)).all()


def test_nothing_that_moves_is_an_empty_world() -> None:
    assert np.isinf(cast(shapes_at(MovingObstacles(), 1.0), 0.0, 0.0, 0.0, 1.0, 3, 9.0)).all()
