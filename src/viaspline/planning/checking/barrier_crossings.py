"""Whether curves cross barriers: decided by control polygons, for the whole of a curve.

A cubic lies within the hull of its control polygon. Where that is beside a barrier, so is the
curve; else it is halved, until a piece is seen to cross, or is so small that it counts as crossing.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats

MAX_HALVINGS = 40  # of a span, after which what isn't seen to be beside a barrier touches it
MAX_PIECES = 64  # of a span that stay open at once: it runs along the barrier


def crossings(spans: Floats, barriers: Floats) -> NDArray[np.bool_]:
    """Which spans meet which barriers.

    Args:
        spans: Bézier control polygons [m], (m, 4, d); their first two coordinates count.
        barriers: Segments x0, y0, x1, y1 [m], (b, 4).

    Returns:
        (m, b). Where it is False, that is proven.

    Example:
        >>> line = np.array([[[0, 0], [1, 0], [2, 0], [3, 0]]], np.float64)
        >>> crossings(line, np.array([[1.5, -1, 1.5, 1], [1.5, 1, 1.5, 2]], np.float64))
        array([[ True, False]])
    """
    met = np.zeros((len(spans), len(barriers)), np.bool_)
    if not met.size:
        return met
    foot, along = barriers[:, :2], barriers[:, 2:] - barriers[:, :2]
    away = spans[:, None, :, :2] - foot[None, :, None]
    size = np.maximum((along**2).sum(axis=1), 1e-300)[None, :, None]
    share = (away * along[None, :, None]).sum(axis=3) / size  # along the barrier, 0 to 1
    across = along[None, :, None, 0] * away[..., 1] - along[None, :, None, 1] * away[..., 0]
    open_ = np.argwhere(~_is_beside(share, across))
    if not len(open_):
        return met
    share, across = share[open_[:, 0], open_[:, 1]], across[open_[:, 0], open_[:, 1]]
    for _ in range(MAX_HALVINGS):
        sure = _is_across(share, across)
        met[tuple(open_[sure].T)] = True
        left = ~met[tuple(open_.T)]
        open_, share, across = open_[left], _halves(share[left]), _halves(across[left])
        open_ = np.concatenate((open_, open_))
        left = ~_is_beside(share, across)
        open_, share, across = open_[left], share[left], across[left]
        pairs, count = np.unique(open_, axis=0, return_counts=True)
        met[tuple(pairs[count > MAX_PIECES].T)] = True
        if not len(open_):
            return met
    met[tuple(open_.T)] = True
    return met


def _is_beside(share: Floats, across: Floats) -> NDArray[np.bool_]:
    """Whether control polygons (..., 4) are surely beside their barriers."""
    low, high = across.min(axis=-1), across.max(axis=-1)
    found: NDArray[np.bool_] = (
        (low > 0.0) | (high < 0.0) | (share.max(axis=-1) < 0.0) | (share.min(axis=-1) > 1.0)
    )
    return found


def _is_across(share: Floats, across: Floats) -> NDArray[np.bool_]:
    """Whether curves (n, 4) surely cross their barriers: they end on different sides of them."""
    within = (share.min(axis=1) >= 0.0) & (share.max(axis=1) <= 1.0)
    found: NDArray[np.bool_] = within & ((across[:, 0] > 0.0) != (across[:, 3] > 0.0))
    return found


def _halves(values: Floats) -> Floats:
    """The first halves of cubics (n, 4), then the second ones, (2 n, 4)."""
    a, b, c, d = values.T
    ab, bc, cd = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + d)
    abc, bcd = 0.5 * (ab + bc), 0.5 * (bc + cd)
    middle = 0.5 * (abc + bcd)
    first, second = np.stack((a, ab, abc, middle)), np.stack((middle, bcd, cd, d))
    return np.ascontiguousarray(np.concatenate((first, second), axis=1).T)
