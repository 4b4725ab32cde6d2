"""What the body on its way comes too close to."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.detour.brief import Brief
from viaspline.detour.fit import too_close
from viaspline.world.world import World

Floats = NDArray[np.float64]


def body_conflicts(world: World, spans: Floats, brief: Brief) -> NDArray[np.int64]:
    """What the body comes nearer to than it may on each span: as ``fit.too_close``, (m,)."""
    return too_close(world, spans, brief.required)
