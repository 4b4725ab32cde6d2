"""The swept area and the outlines of a body, beside the union of dense poses."""

import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.curve.sweep import footprints_along, swept_parts
from viaspline.errors import GeometryError


def swept_area(*asked: Any, **options: Any) -> Any:
    return shapely.union_all(swept_parts(*asked, **options))


CAR = np.array([(-1, -0.5), (3, -0.5), (3, 0.5), (-1, 0.5)], float)
BOOT = np.array([(-1, -0.5), (2, -0.5), (2, -0.1), (0.5, -0.1), (0.5, 0.8), (-1, 0.8)], float)


@settings(max_examples=25)
@given(st.integers(0, 100_000))
def test_the_area_holds_every_pose_and_little_more(seed: int) -> None:
    rng = np.random.default_rng(seed)
    curve = CardinalSpline(
        rng.uniform(0, 25, (rng.integers(2, 5), 2)),
        slack=float(rng.choice([0.0, 0.3, 0.6])),
        knots="chordal",
        closed=bool(rng.random() < 0.3),
    )
    body = CAR if seed % 2 else BOOT
    area = swept_area(curve, body, 0.05)
    poses = shapely.polygons(footprints_along(curve, body, 0.05))
    assert area.buffer(1e-9).contains(shapely.union_all(poses))
    inner = area.buffer(-0.06)
    reached = shapely.union_all(poses).buffer(0.03)
    headings = np.unwrap(curve.heading(np.linspace(*curve.domain, 2000)))
    if not curve.closed and np.abs(np.diff(headings)).max() < 0.02:  # no turns between the poses
        assert inner.difference(reached).area < 0.05


def test_a_turn_on_the_spot_is_swept_the_short_way() -> None:
    corner = CardinalSpline([(0, 0), (10, 0), (10, 10)], tension=1.0)
    area = swept_area(corner, CAR, 0.01)
    ahead = 3.0 * np.array([math.cos(math.pi / 4), math.sin(math.pi / 4)])
    assert area.contains(shapely.Point(np.array([10, 0]) + ahead))
    assert not area.contains(shapely.Point(np.array([10, 0]) + ahead * [1, -1]))
    back = CardinalSpline([(0, 0), (10, 0), (0, 0)], tension=1.0)
    both = swept_area(back, CAR, 0.01)
    assert both.contains(shapely.Point(10, 3.0).buffer(0.01))
    assert both.contains(shapely.Point(10, -3.0).buffer(0.01))


def test_the_seam_of_a_closed_polyline_is_swept() -> None:
    ring = CardinalSpline([(0, 0), (20, 0), (20, 20), (0, 20)], tension=1.0, closed=True)
    area = swept_area(ring, CAR, 0.02)
    assert area.contains(shapely.Point(2.1, -2.1))
    assert len(area.interiors) == 1


def test_a_disc_sweeps_the_buffer_of_the_line() -> None:
    line = PiecewiseCubic([[(0, 0), (1, 0), (2, 0), (3, 0)]])
    area = swept_area(line, radius=1.0, tolerance=0.01)
    truth = shapely.LineString([(0, 0), (3, 0)]).buffer(1.0, quad_segs=200)
    assert area.contains(truth)
    assert truth.buffer(0.011).contains(area)


def test_outlines_stand_at_equal_distances() -> None:
    line = PiecewiseCubic([[(0, 0, 1), (1, 0, 2), (2, 0, 3), (4, 0, 4)]])
    found = footprints_along(line, CAR, 1.0)
    assert found.shape[1:] == (4, 2)
    np.testing.assert_allclose(found[0], CAR)
    np.testing.assert_allclose(found[-1], CAR + np.array([4, 0]))


@pytest.mark.parametrize(("tolerance", "radius"), [(0.0, 1.0), (math.nan, 1.0), (0.1, -1.0)])
def test_numbers_that_make_no_sense_are_refused(tolerance: float, radius: float) -> None:
    line = PiecewiseCubic([[(0, 0), (1, 0), (2, 0), (3, 0)]])
    with pytest.raises(GeometryError, match="tolerance"):
        swept_area(line, CAR, tolerance, radius=radius)
