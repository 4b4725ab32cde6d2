"""What the body comes too close to on its way, and the proof that it doesn't.

Tested through ``test_promises``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.curve import footprint_conflicts
from viaspline.curve.certificate import PROOF_SLACK_M, Certificate, certified
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.disc import conflicts
from viaspline.planning.problem.requirements import LEAST_KEPT_M, Requirements
from viaspline.planning.problem.work_budget import (
    CONFLICTS_BODY_OBSTACLE_S,
    CONFLICTS_BODY_OBSTACLES,
    CONFLICTS_BODY_SPAN_S,
    CONFLICTS_S,
    CONFLICTS_SPAN_S,
    PROOF_BODY_S,
    PROOF_S,
    PROOF_SPAN_S,
)
from viaspline.world.outline import outline
from viaspline.world.world import World

CLEAR = -1  # the index of what a span comes too close to, where it is nothing


def too_close(world: World, spans: Floats, required: float) -> NDArray[np.int64]:
    """What each span comes nearer to than ``required``: indices as in ``World.nearest``, or -1.

    A little stricter than the certificate, which is never quite at the true distance.

    Args:
        world: What to keep clear of.
        spans: Bézier control polygons [m], (m, 4, d).
        required: [m].

    Returns:
        (m,).
    """
    writable = spans if spans.flags.writeable else spans.copy()  # numba compiles for one kind
    found: NDArray[np.int64] = conflicts(world.packed, writable, required - 0.8 * PROOF_SLACK_M)[0]
    return found


def body_conflicts(world: World, spans: Floats, requirements: Requirements) -> NDArray[np.int64]:
    """What the body comes nearer to than it may on each span: as ``too_close``, (m,)."""
    return conflicts_within(requirements.required, world, spans, requirements)


def is_clear(world: World, spans: Floats, requirements: Requirements) -> bool:
    """Whether the body keeps clear on planar spans (m, 4, 2) [m]."""
    return bool((body_conflicts(world, spans, requirements) == CLEAR).all())


def conflicts_within(
    required: float, world: World, spans: Floats, requirements: Requirements
) -> NDArray[np.int64]:
    """What the body comes too close to if the path itself is to keep ``required`` [m], (m,)."""
    if requirements.footprint is None:
        requirements.spend(CONFLICTS_S + CONFLICTS_SPAN_S * len(spans))
        return too_close(world, spans, required)
    near = CONFLICTS_BODY_OBSTACLE_S * min(len(world), CONFLICTS_BODY_OBSTACLES)
    requirements.spend(CONFLICTS_S + (CONFLICTS_BODY_SPAN_S + near) * len(spans))
    least = max(required - requirements.radius, LEAST_KEPT_M)
    return footprint_conflicts.body_conflicts(
        world.packed, spans, outline(requirements.footprint), least
    )


def turn_conflict(world: World, arrival: float, span: Floats, requirements: Requirements) -> int:
    """What a polygonal body comes too close to while it turns on the spot: its index, or -1.

    Args:
        world: What to keep clear of.
        arrival: Heading before the turn [rad].
        span: On which the body goes on after it [m], (4, 2); it is looked at as well.
        requirements: The body, and what it keeps. A disc is too close to nothing by turning.
    """
    if requirements.footprint is None:
        return CLEAR
    requirements.spend(CONFLICTS_S + CONFLICTS_BODY_SPAN_S)
    return int(
        footprint_conflicts.body_conflicts(
            world.packed, span[None], outline(requirements.footprint),
            max(requirements.required - requirements.radius, LEAST_KEPT_M), arrival=arrival,
        )[0]
    )  # fmt: skip


def proven(curve: PiecewiseCubic, world: World, requirements: Requirements) -> Certificate:
    """The certificate of a curve that the body drives."""
    cost = PROOF_S + PROOF_SPAN_S * len(curve.spans)
    requirements.spend(cost if requirements.footprint is None else cost + PROOF_BODY_S)
    radius = requirements.radius if requirements.footprint is None else 0.0
    return certified(curve, world, requirements.kept, radius, requirements.footprint)
