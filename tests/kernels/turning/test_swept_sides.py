"""What a body reaches beside its path, beside its outline put down along it closely."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

import viaspline as vs
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.strip_places import strip_normals
from viaspline.kernels.turning.strip_spans import strip_spans
from viaspline.kernels.turning.swept_sides import swept_sides
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.turning.strip_body import strip_bodies

KEPT = 0.2
TRUCK = ((-0.4, -0.5), (1.6, -0.5), (1.6, 0.5), (-0.4, 0.5))
KITE = ((-0.7, 0.1), (0.2, -0.4), (1.1, -0.1), (0.1, 0.6))
HOLDS_ALL = vs.Obstacle(circle={"center": (7.0, 0.0), "radius": 20.0})

Outline = tuple[tuple[float, float], ...]


def reached(
    outline: Outline | None,
    places: Floats,
    known: Sequence[vs.Obstacle] = (HOLDS_ALL,),
    closed: bool = False,
) -> tuple[Floats, Floats, Floats]:
    """How far to the left and to the right of each place, by the kernel [m]; the curve's spans."""
    body = strip_bodies(Requirements(radius=0.3, clearance=KEPT, footprint=outline), 0.0)[0]
    normals = strip_normals(places, closed)
    spans = strip_spans(places, normals, np.full((2, 2), np.nan), closed)
    beside, half = np.empty(len(places)), np.empty(len(places))
    swept_sides(vs.World(known).packed, body, closed, places, normals, spans, beside, half)
    return half - KEPT + beside, half - KEPT - beside, spans


def put_down(outline: Outline, spans: Floats) -> Floats:
    """Places on the outline of a body along a curve, close together [m], (n, 2)."""
    curve = PiecewiseCubic(spans)
    at = np.linspace(*curve.domain, 4001)
    corners = np.array(outline)
    w = np.linspace(0.0, 1.0, 41)[:, None, None]
    ahead, left = ((1.0 - w) * corners + w * np.roll(corners, -1, axis=0)).reshape(-1, 2).T
    along = curve.tangent(at)[:, None]
    across = np.stack((-along[..., 1], along[..., 0]), axis=-1)
    places = curve.evaluate(at)[:, None] + ahead[:, None] * along + left[:, None] * across
    return np.asarray(places.reshape(-1, 2))


@pytest.mark.parametrize("outline", [TRUCK, KITE], ids=["truck", "kite"])
@pytest.mark.parametrize("bend", [0.1, 0.6, -0.6])
def test_a_body_reaches_as_far_as_its_outline_goes(outline: Outline, bend: float) -> None:
    headings = bend * np.sin(0.1 * np.arange(61))
    steps = 0.25 * np.column_stack((np.cos(headings), np.sin(headings)))
    places = np.vstack((np.zeros(2), np.cumsum(steps, axis=0)))
    left, right, spans = reached(outline, places)
    put, normals = put_down(outline, spans), strip_normals(places, False)
    for j in range(10, 51):  # its ends are nowhere near there
        off, normal = put - places[j], normals[j]
        beside = np.abs(off[:, 0] * normal[1] - off[:, 1] * normal[0]) < 3e-3
        across = off[beside] @ normal
        across = across[np.abs(across) < 2.0]
        assert left[j] == pytest.approx(across.max(), abs=5e-3)
        assert right[j] == pytest.approx(-across.min(), abs=5e-3)


def test_on_a_line_a_body_is_as_wide_as_it_is() -> None:
    places = np.column_stack((np.linspace(0.0, 20.0, 21), np.zeros(21)))
    left, right, _ = reached(KITE, places)
    np.testing.assert_allclose(left[3:-3], 0.6, atol=1e-9)
    np.testing.assert_allclose(right[3:-3], 0.4, atol=1e-9)


def test_round_a_circle_a_body_reaches_as_far_everywhere() -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 121)
    places = 5.0 * np.column_stack((np.cos(angles), np.sin(angles)))
    left, right, _ = reached(TRUCK, places, closed=True)
    np.testing.assert_allclose(left, 0.5, atol=1e-5)
    np.testing.assert_allclose(right, np.hypot(5.5, 1.6) - 5.0, atol=1e-4)


def test_far_from_everything_a_body_is_the_disc_about_it_and_a_disc_is_one_anywhere() -> None:
    places = np.column_stack((np.linspace(0.0, 20.0, 21), np.sin(np.arange(21.0))))
    left, right, _ = reached(TRUCK, places, known=())
    np.testing.assert_allclose([left, right], np.hypot(1.6, 0.5))
    left, right, _ = reached(None, places)
    np.testing.assert_allclose([left, right], 0.3)
