"""What a plan keeps clear of, asked of the straight lines that its path is exported as."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from viaspline.curve.certificate import Certificate, certify
from viaspline.curve.height_certificate import certify_heights
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats, Ints
from viaspline.planner import Plan
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.without_ground import without_ground
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld
from viaspline.world.world import World

_STEP_M = 1e-4  # between the places by which the way out is felt for


class LineProof(NamedTuple):
    """What is proven of one line.

    Attributes:
        clearance: A lower bound of the distance between the body and everything [m]; -inf where it
            leaves the heights that it has to keep.
        at: Where that is [m], shape (d,).
        part: That place as a part of the line, 0 to 1.
        nearest: The name of what is nearest there; None if there is nothing.
        away: The direction that leads away from it, a unit vector, shape (d,); None: none is known.
    """

    clearance: float
    at: tuple[float, ...]
    part: float
    nearest: str | None
    away: Floats | None


@dataclass(frozen=True, eq=False)
class LineProver:
    """What lines are proven against.

    Attributes:
        worlds: What counts up to which distance along the path [m], in order.
        required: Free space that the body keeps [m].
        radius: Of the body [m].
        footprint: The body, if it is a polygon [m].
        outer: Distance of a polygon's farthest corner from its reference point [m]; 0 for a disc.
    """

    worlds: tuple[tuple[float, World | SpatialWorld], ...]
    required: float
    radius: float
    footprint: tuple[tuple[float, float], ...] | None
    outer: float

    @classmethod
    def of(cls, plan: Plan | SpatialPlan) -> LineProver:
        """What the plan's own path was proven against."""
        robot, required = plan.mission.robot, plan.certificate.required
        if isinstance(plan, Plan):
            outer = 0.0 if robot.footprint is None else robot.outer_radius
            radius = robot.radius_m if robot.footprint is None else 0.0
            return cls(((np.inf, plan.world),), required, radius, robot.footprint, outer)
        first, last = plan.airborne
        upright = without_ground(plan.world)
        worlds = ((first, upright), (last, plan.world), (np.inf, upright))
        radius = robot.radius_m if robot.half_height_m is None else 0.0
        return cls(worlds, required, radius, None, 0.0)

    def part_at(self, distances: Floats) -> Ints:
        """Which of the worlds counts at distances along the path [m]."""
        ends = np.array([until for until, _ in self.worlds])
        return np.asarray(np.searchsorted(ends, distances))

    def proof(self, corners: Floats, distance: float) -> LineProof:
        """What is proven of all lines of a row but the last one, of that where it begins.

        Args:
            corners: The row [m], shape (n, d), n >= 2. A polygonal body turns at the last but one
                corner to go on to the last one; at the end of a path there is none to go on to,
                and the last line counts.
            distance: Of a place on the lines along the path [m]; none of them leads out of the
                part of the path in which the same things count.
        """
        world = self.worlds[int(self.part_at(np.array(distance)))][1]
        curve = polyline_curve(corners)
        proof: Certificate
        if self.footprint is not None:
            proof = certify(curve, world, self.required, footprint=self.footprint)
        else:
            proof = certify(curve, world, self.required, radius=self.radius)
        low = proof.clearance
        if isinstance(world, SpatialWorld) and world.band != HeightBand():
            low = low if certify_heights(curve, world).holds else -np.inf
        away = None if proof.obstacle is None else _away(world, proof)
        part = min(proof.tightest_u, 1.0)
        return LineProof(low, proof.tightest_at, part, proof.obstacle, away)


def polyline_curve(points: Sequence[Any] | Floats) -> PiecewiseCubic:
    """Straight lines as a piecewise cubic.

    Args:
        points: [m], shape (n, d), n >= 2.

    >>> polyline_curve([(0, 0), (3, 4), (3, 9)]).length
    10.0
    """
    places = np.asarray(points, np.float64)
    parts = np.array([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0])[None, :, None]
    spans = places[:-1, None] * (1.0 - parts) + places[1:, None] * parts
    spans[:, 0], spans[:, 3] = places[:-1], places[1:]
    return PiecewiseCubic(spans)


def _away(world: World | SpatialWorld, proof: Certificate) -> Floats | None:
    """The way out of what is nearest, from how the distance changes about the place."""
    axes = 3 if isinstance(world, SpatialWorld) else 2
    at = np.array(proof.tightest_at if proof.contact is None else proof.contact)
    steps = _STEP_M * np.eye(at.size)[:axes]
    rise = world.distance(at + steps) - world.distance(at - steps)
    size = float(np.linalg.norm(rise))
    if not 0.0 < size < np.inf:
        return None
    away = np.zeros(len(proof.tightest_at))
    away[:axes] = rise / size
    return away
