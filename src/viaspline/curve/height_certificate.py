"""What is proven of a curve's heights: how high it is, above ground too, within which limits."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.handed_in import check_answers, check_kind
from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.ground_clearance import least_height
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.world.space.spatial_world import SpatialWorld

HEIGHT_TOLERANCE_M = 0.05  # between the proven height above ground and the true one [m]
HEIGHT_SLACK_M = 1e-6  # what a proof may lack of a limit: a curve that flies along it [m]

HeightLimit = Literal["lowest", "highest", "least_above_ground", "most_above_ground"]
"""A limit of a ``HeightBand``, by the name of its attribute."""


@dataclass(frozen=True, slots=True)
class HeightBound:
    """A proven bound of a curve's heights.

    Attributes:
        height: The bound [m]: the least height that there may be, or the greatest.
        at: Where the curve has that height, but for the tolerance [m], x, y, z.
        u: That place as a parameter of the curve.
    """

    height: float
    at: tuple[float, float, float]
    u: float


@told_in_lines
@dataclass(frozen=True, slots=True)
class HeightCertificate:
    """What is proven of a curve's heights, as a whole.

    Attributes:
        least: Its lowest place; exact.
        greatest: Its highest place; exact.
        least_above_ground: A lower bound of its height above bilinear ground, within 5 cm of the
            true one. -inf where the curve comes over ground that isn't known and blocks, inf where
            it comes over no ground that is known, or there is none.
        greatest_above_ground: An upper bound of it, within 5 cm; -inf where the curve comes over no
            ground that is known, inf where there is none.
        margins: By how much each limit that there is is kept at least [m]; negative if it isn't.
    """

    least: HeightBound
    greatest: HeightBound
    least_above_ground: HeightBound
    greatest_above_ground: HeightBound
    margins: dict[HeightLimit, float]

    @property
    def tightest(self) -> HeightLimit | None:
        """The limit that is kept by least; None where there is no limit."""
        return min(self.margins, key=self.margins.__getitem__, default=None)

    @property
    def tightest_at(self) -> HeightBound | None:
        """Where that is."""
        return None if self.tightest is None else self._bounds[self.tightest]

    @property
    def holds(self) -> bool:
        """Whether all limits are kept, to a micrometre."""
        return all(margin >= -HEIGHT_SLACK_M for margin in self.margins.values())

    @property
    def _bounds(self) -> dict[HeightLimit, HeightBound]:
        return {
            "lowest": self.least,
            "highest": self.greatest,
            "least_above_ground": self.least_above_ground,
            "most_above_ground": self.greatest_above_ground,
        }


def certify_heights(curve: PiecewiseCubic, world: SpatialWorld) -> HeightCertificate:
    """Prove how high the whole continuous curve is, and whether it keeps a world's height band.

    Args:
        curve: A piecewise cubic in space.
        world: Its ground, and the limits of its band.

    Returns:
        A certificate, whether it holds or not: see ``HeightCertificate.holds``.

    Raises:
        GeometryError: When the curve isn't in space.

    Example:
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> from viaspline.maps.terrain import Terrain
        >>> from viaspline.world.space.height_band import HeightBand
        >>> hill = Terrain([[0, 0, 0], [0, 8, 0], [0, 0, 0]], cell=50.0)
        >>> world = SpatialWorld.of(ground=hill, band=HeightBand(least_above_ground=5.0))
        >>> found = certify_heights(CardinalSpline([(0, 50, 20), (100, 50, 20)]), world)
        >>> round(found.least_above_ground.height, 1), found.least_above_ground.at, found.holds
        (12.0, (50.0, 50.0, 20.0), True)
        >>> found.tightest
        'least_above_ground'
    """
    check_answers("curve", curve, "dimension", "give a CardinalSpline, or the path of a plan")
    check_kind("world", world, SpatialWorld, "give SpatialWorld.of(solids, ground=terrain)")
    if curve.dimension != 3:
        raise GeometryError(f"a curve of dimension {curve.dimension} has no heights; give it z")
    spans = np.array(curve.spans)  # numba compiles read-only arrays once more
    band = world.band
    least, greatest, low, high = _placed(
        curve,
        (
            *_extremes(spans),
            _above_ground(world.packed, spans, 1.0, band.least_above_ground),
            _above_ground(world.packed, spans, -1.0, band.most_above_ground),
        ),
    )
    margins: dict[HeightLimit, float] = {}
    if band.lowest > -math.inf:
        margins["lowest"] = least.height - band.lowest
    if band.highest < math.inf:
        margins["highest"] = band.highest - greatest.height
    if band.least_above_ground > -math.inf:
        margins["least_above_ground"] = low.height - band.least_above_ground
    if band.most_above_ground < math.inf:
        margins["most_above_ground"] = band.most_above_ground - high.height
    return HeightCertificate(least, greatest, low, high, margins)


def _placed(curve: PiecewiseCubic, found: Iterable[tuple[float, float]]) -> Iterator[HeightBound]:
    """Heights, each with the parameter where it is, and with its place."""
    heights, parameters = zip(*found, strict=True)
    places = np.asarray(curve.evaluate(np.array(parameters))).tolist()
    for height, (x, y, z), u in zip(heights, places, parameters, strict=True):
        yield HeightBound(height, (x, y, z), u)


def _extremes(spans: Floats) -> Iterator[tuple[float, float]]:
    """The least and the greatest height of a curve, from where that turns, and their parameters."""
    z = spans[:, :, 2]
    parameters = _turning(z)
    u = 1.0 - parameters
    heights = u**3 * z[:, :1] + 3.0 * u * u * parameters * z[:, 1:2]
    heights += 3.0 * u * parameters**2 * z[:, 2:3] + parameters**3 * z[:, 3:]
    for found in (int(heights.argmin()), int(heights.argmax())):
        span, k = divmod(found, heights.shape[1])
        yield float(heights[span, k]), float(span) + float(parameters[span, k])


def _turning(z: Floats) -> Floats:
    """Parameters of the ends of spans and of the places where heights (m, 4) turn, (m, 4)."""
    first, second, third = np.diff(z, axis=1).T
    a, b, c = first - 2.0 * second + third, second - first, first
    found = np.zeros((len(z), 4))
    found[:, 1] = 1.0
    root = np.sqrt(np.maximum(b * b - a * c, 0.0))
    far = -(b + np.copysign(root, b))  # the root that doesn't cancel
    with np.errstate(divide="ignore", invalid="ignore"):
        found[:, 2], found[:, 3] = far / a, c / far
    return np.clip(np.nan_to_num(found, nan=0.0, posinf=1.0, neginf=0.0), 0.0, 1.0)


_FINER: Final = (0.1 * HEIGHT_TOLERANCE_M, 0.01 * HEIGHT_TOLERANCE_M, 0.1 * HEIGHT_SLACK_M)


def _above_ground(
    space: PackedSpace, spans: Floats, sign: float, limit: float
) -> tuple[float, float]:
    """A bound of the height above ground, and the parameter where it is about so high.

    It is so tight that it tells whether a limit is kept.
    """
    required = sign * limit - HEIGHT_SLACK_M
    lower, upper, span, w = least_height(space, spans, sign, HEIGHT_TOLERANCE_M)
    for tolerance in _FINER if math.isfinite(limit) else ():
        if lower >= required or upper < required:
            break
        lower = max(lower, least_height(space, spans, sign, tolerance)[0])
    return sign * lower, float(span + w)
