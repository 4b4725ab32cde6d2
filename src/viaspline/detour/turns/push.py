"""Pushing a swing away from what it comes too close to."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.detour.body import body_conflicts
from viaspline.detour.brief import Brief
from viaspline.detour.fit import CLEAR
from viaspline.detour.turns.bends import DETOUR, KEPT, SIDE, Bends, bend
from viaspline.detour.turns.swing import NoSwing, Swing, swing_round
from viaspline.world.world import World

Floats = NDArray[np.float64]
ROUNDS = 24
SAMPLES = 9  # of a span, to find its tightest place
EPS = 1e-6  # step of the gradient of the distance [m]
EXTRA = 2e-3  # what a bend keeps beyond what is required [m]
SAME = 0.25  # bends nearer to each other than this, in required distances, are one


def pushed_clear(bends: Bends, rho: float, world: World, brief: Brief) -> Swing | NoSwing:
    """A swing that keeps clear, by new bends round whatever it comes too close to.

    Returns:
        A swing, clear or not, the last that there was; or why there is none.
    """
    last = swing_round(bends, rho)
    for _ in range(ROUNDS):
        if isinstance(last, NoSwing):
            return last
        close = body_conflicts(world, last.spans, brief)
        if (close == CLEAR).all():
            return last
        moved = _pushed(last, close, world, brief)
        tried = swing_round(moved, rho)
        if isinstance(tried, NoSwing):
            return last
        last = tried
    return last


def _pushed(swing: Swing, close: NDArray[np.int64], world: World, brief: Brief) -> Bends:
    """The bends with one more, or a wider one, for every run of spans that is too close."""
    bends = swing.bends
    hit = np.flatnonzero(close != CLEAR)
    runs = np.split(hit, np.flatnonzero(np.diff(hit) > 1) + 1)
    curve = PiecewiseCubic(swing.spans)
    for run in reversed(runs):  # from the end, so that the earlier indices stay
        bends = _push(bends, swing, curve, run, world, brief)
    return bends


def _push(
    bends: Bends, swing: Swing, curve: PiecewiseCubic, run: NDArray[np.int64], world: World,
    brief: Brief,
) -> Bends:  # fmt: skip
    u = np.linspace(run[0], run[-1] + 1, SAMPLES * len(run))
    places = np.asarray(curve.evaluate(u))
    gaps = world.distance(places)
    k = int(gaps.argmin())
    place, gap, heading = places[k], float(gaps[k]), float(curve.heading(u[k]))
    away = _gradient(world, place)
    wall = place - gap * away
    left = np.array([-np.sin(heading), np.cos(heading)])
    side = 1.0 if -away @ left > 0.0 else -1.0
    kept = brief.required + EXTRA
    row = int(np.searchsorted(swing.begins[: len(swing.bends.rows)], u[k], side="right"))
    for near in (row - 1, row % len(bends.rows)):
        if bends.vias[near] == DETOUR and bends.rows[near, SIDE] == side:
            off = float(np.linalg.norm(bends.rows[near, :2] - wall))
            if off < max(SAME * brief.required, bends.rows[near, KEPT] - SAME * brief.required):
                more = max(brief.required - gap, 0.0)
                return bends.widened(near, 1.1 * more + EXTRA)
    return bends.with_bend(row, bend(float(wall[0]), float(wall[1]), kept, side))


def _gradient(world: World, place: Floats) -> Floats:
    """The direction in which the distance grows, a unit vector (2,)."""
    steps = place + EPS * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
    d = world.distance(steps)
    slope = np.array([d[0] - d[1], d[2] - d[3]])
    size = float(np.linalg.norm(slope))
    return slope / size if size > 0.0 else np.array([1.0, 0.0])
