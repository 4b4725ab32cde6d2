"""What the body comes too close to on its way, and the proof that it doesn't."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.curve import footprint_conflicts
from viaspline.curve.certificate import Certificate, certify
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.fit import CLEAR, too_close
from viaspline.planning.problem.requirements import LEAST, Requirements
from viaspline.world.outline import outline
from viaspline.world.world import World


def body_conflicts(world: World, spans: Floats, requirements: Requirements) -> NDArray[np.int64]:
    """What the body comes nearer to than it may on each span: as ``fit.too_close``, (m,)."""
    return conflicts_within(requirements.required, world, spans, requirements)


def is_clear(world: World, spans: Floats, requirements: Requirements) -> bool:
    """Whether the body keeps clear on planar spans (m, 4, 2) [m]."""
    return bool((body_conflicts(world, spans, requirements) == CLEAR).all())


def conflicts_within(
    required: float, world: World, spans: Floats, requirements: Requirements
) -> NDArray[np.int64]:
    """The same for another distance that the path itself is to keep [m]."""
    if requirements.footprint is None:
        return too_close(world, spans, required)
    least = max(required - requirements.radius, LEAST)
    return footprint_conflicts.body_conflicts(
        world.packed, spans, outline(requirements.footprint), least
    )


def proven(curve: PiecewiseCubic, world: World, requirements: Requirements) -> Certificate:
    """The certificate of a curve that the body drives."""
    if requirements.footprint is None:
        return certify(curve, world, requirements.kept, radius=requirements.radius)
    return certify(curve, world, requirements.kept, footprint=requirements.footprint)
