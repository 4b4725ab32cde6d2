"""What the body comes too close to on its way, and the proof that it doesn't."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.curve import footprint_conflicts
from viaspline.curve.certificate import Certificate, certify
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.alternatives.fit import CLEAR, too_close
from viaspline.planning.problem.requirements import LEAST, Brief
from viaspline.world.outline import outline
from viaspline.world.world import World

Floats = NDArray[np.float64]


def body_conflicts(world: World, spans: Floats, brief: Brief) -> NDArray[np.int64]:
    """What the body comes nearer to than it may on each span: as ``fit.too_close``, (m,)."""
    return conflicts_within(brief.required, world, spans, brief)


def is_clear(world: World, spans: Floats, brief: Brief) -> bool:
    """Whether the body keeps clear on planar spans (m, 4, 2) [m]."""
    return bool((body_conflicts(world, spans, brief) == CLEAR).all())


def conflicts_within(
    required: float, world: World, spans: Floats, brief: Brief
) -> NDArray[np.int64]:
    """The same for another distance that the path itself is to keep [m]."""
    if brief.footprint is None:
        return too_close(world, spans, required)
    least = max(required - brief.radius, LEAST)
    return footprint_conflicts.body_conflicts(world.packed, spans, outline(brief.footprint), least)


def proven(curve: PiecewiseCubic, world: World, brief: Brief) -> Certificate:
    """The certificate of a curve that the body drives."""
    if brief.footprint is None:
        return certify(curve, world, brief.kept, radius=brief.radius)
    return certify(curve, world, brief.kept, footprint=brief.footprint)
