"""How late a law is, beside a finer and more lenient search that knows numpy alone."""

from __future__ import annotations

import math

import numpy as np
import pytest

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Flags, Floats
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.method import Found
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.yielding.law_among import law_among
from viaspline.world.moving_obstacles import MovingObstacles

LENGTH, TOP, ACCEL, REQUIRED = 8.0, 1.0, 0.5, 0.3
STEP = 0.05
QUANTUM, PITCH = ACCEL * STEP, 0.5 * ACCEL * STEP * STEP
LEVELS, PLACES = round(TOP / QUANTUM), round(LENGTH / PITCH)
LONGEST_S = 40.0


def crossings(seed: int) -> Floats:
    """Discs that cross a line: x, y at time 0, their speeds, and a radius each, (n, 5)."""
    rng = np.random.default_rng(seed)
    count = 5
    meets = np.column_stack((rng.uniform(1.0, LENGTH - 0.5, count), np.zeros(count)))
    angle = rng.uniform(0.3, math.pi - 0.3, count) * rng.choice((-1, 1), count)
    speed = rng.uniform(0.2, 1.0, count)
    velocity = np.column_stack((np.cos(angle), np.sin(angle))) * speed[:, None]
    when = rng.uniform(2.0, 12.0, count)
    return np.column_stack((meets - velocity * when[:, None], velocity, rng.uniform(0.2, 0.5, 5)))


def blocked(discs: Floats, time: float) -> Flags:
    """Which places are nearer than required at an instant, and at that instant alone."""
    places = PITCH * np.arange(PLACES + 1)
    found = np.zeros(PLACES + 1, np.bool_)
    for x, y, vx, vy, radius in discs:
        gap = np.hypot(places - x - vx * time, y + vy * time) - radius
        found |= gap < REQUIRED
    return found


def optimum(discs: Floats) -> float:
    """The earliest arrival of a robot that is looked at every 50 ms, and nowhere between [s].

    It changes its speed by a quantum in a step, or keeps it: what is best but for that.
    """
    reached = np.zeros((LEVELS + 1, PLACES + 1), np.bool_)
    reached[0, 0] = not blocked(discs, 0.0)[0]
    for n in range(round(LONGEST_S / STEP)):
        if reached[0, PLACES]:
            return n * STEP
        following = np.zeros_like(reached)
        for k in range(LEVELS + 1):
            for before in range(max(k - 1, 0), min(k + 1, LEVELS) + 1):
                gone = k + before
                following[k, gone:] |= reached[before, : PLACES + 1 - gone]
        reached = following & ~blocked(discs, (n + 1) * STEP)
    return math.inf


@pytest.mark.parametrize("seed", range(5))
def test_a_law_is_late_by_a_hundredth_at_most(seed: int) -> None:
    discs = crossings(seed)
    moving = MovingObstacles(
        Obstacle(
            circle={"center": (0, 0), "radius": radius},
            motion={"from": (x, y), "velocity_mps": (vx, vy)},
        )
        for x, y, vx, vy, radius in discs.tolist()
    )
    line = Path([np.linspace((0.0, 0.0), (LENGTH, 0.0), 4)], vias=[])
    limits = Limits(max_speed=TOP, max_accel=ACCEL)
    outcome = law_among(line, limits, moving=moving, required=REQUIRED)
    best = optimum(discs)
    if not isinstance(outcome, Found):
        assert best == math.inf
        return
    assert best - STEP <= outcome.value.duration <= 1.01 * best + STEP
