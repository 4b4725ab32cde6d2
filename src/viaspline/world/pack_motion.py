"""From motions as people write them to the arrays that kernels take.

Tested through ``world/test_moving_obstacles``.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.motion import packed_motion as columns
from viaspline.kernels.motion.packed_motion import COLUMNS, PackedMotion
from viaspline.kernels.world.packed import PackedWorld
from viaspline.mission.motion_spec import Motion
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.world.pack import pack


def pack_motion(obstacles: Sequence[Obstacle], since: Sequence[float]) -> PackedMotion:
    """Pack obstacles that all have a motion.

    Args:
        obstacles: None of them a grid.
        since: When the place of each begins to get less certain [s].
    """
    rows, rounds, errors, rings = [], [], [], []
    for obstacle, begin in zip(obstacles, since, strict=True):
        motion, ring = obstacle.motion, obstacle.ring
        assert motion is not None
        assert ring is not None
        pieces, period = _pieces(motion)
        rows.append(pieces)
        rings.append(ring)
        rounds.append((0.0 if period == 0.0 else pieces[0, columns.BEGINS], period))
        errors.append((begin, motion.error.position_m, motion.error.growth_mps))
    first = np.array([0, *accumulate(map(len, rows))], np.int64)
    pieces = np.concatenate(rows) if rows else np.empty((0, COLUMNS))
    reaches = _reaches(rings)
    straight = np.hypot(pieces[:, columns.SPEED_X], pieces[:, columns.SPEED_Y])
    turning = np.repeat(reaches, np.diff(first)) * np.abs(pieces[:, columns.TURNING])
    return PackedMotion(
        pack_shapes(obstacles),
        first,
        pieces,
        np.array(rounds, np.float64).reshape(-1, 2),
        np.array(errors, np.float64).reshape(-1, 3),
        reaches,
        np.maximum.reduceat(straight + turning, first[:-1]) if rows else np.empty(0),
    )


def _reaches(rings: Sequence[RoundedRing]) -> Floats:
    """From each frame's origin to the farthest point of the shape in it [m], shape (n,)."""
    corners = [[corner for loop in ring.loops for corner in loop] for ring in rings]
    if not corners:
        return np.empty(0)
    begins = [0, *accumulate(map(len, corners))][:-1]
    away = np.hypot(*np.array([corner for one in corners for corner in one], np.float64).T)
    reaches: Floats = np.maximum.reduceat(away, begins) + [ring.radius for ring in rings]
    return reaches


def pack_shapes(obstacles: Sequence[Obstacle]) -> PackedWorld:
    """Pack the shapes of obstacles, each in its own frame."""
    return pack(obstacles, None, ())


def joined_motion(one: PackedMotion, other: PackedMotion, shapes: PackedWorld) -> PackedMotion:
    """Some that move and then others.

    Args:
        one: The first.
        other: Those that follow.
        shapes: Of all of them.
    """
    return PackedMotion(
        shapes,
        np.concatenate((one.first_piece, other.first_piece[1:] + one.first_piece[-1])),
        np.concatenate((one.pieces, other.pieces)),
        np.concatenate((one.rounds, other.rounds)),
        np.concatenate((one.errors, other.errors)),
        np.concatenate((one.reaches, other.reaches)),
        np.concatenate((one.speeds, other.speeds)),
    )


def part_of_motion(whole: PackedMotion, begin: int, end: int, shapes: PackedWorld) -> PackedMotion:
    """Some of what moves, from one to before another.

    Args:
        whole: All of it.
        begin: The first of them.
        end: The one after the last.
        shapes: Of them.
    """
    counted = whole.first_piece[begin : end + 1]
    return PackedMotion(
        shapes, counted - counted[0], whole.pieces[counted[0] : counted[-1]],
        whole.rounds[begin:end], whole.errors[begin:end], whole.reaches[begin:end],
        whole.speeds[begin:end],
    )  # fmt: skip


def _pieces(motion: Motion) -> tuple[Floats, float]:
    """The pieces of a motion (k, COLUMNS), and its period [s]; 0 if it has none."""
    if motion.keyframes is None:
        assert motion.from_ is not None
        assert motion.velocity_mps is not None
        whole = np.zeros((1, COLUMNS))
        whole[0, columns.BEGINS] = -np.inf
        whole[0, columns.X : columns.Y + 1] = motion.from_[:2]
        whole[0, columns.SPEED_X : columns.SPEED_Y + 1] = motion.velocity_mps[:2]
        whole[0, columns.PRESENT] = 1.0
        return whole, 0.0
    frames = _frames(motion.keyframes)
    if motion.after == "bounce":
        back = frames[-2::-1].copy()
        back[:, 0] = 2.0 * frames[-1, 0] - back[:, 0]
        frames = np.concatenate((frames, back))
    if motion.after in ("loop", "bounce"):
        return _between(frames), float(frames[-1, 0] - frames[0, 0])
    vanishes = motion.after == "vanish"
    absent = vanishes if motion.before is None else motion.before == "absent"
    pieces = np.zeros((len(frames) + 1, COLUMNS))
    pieces[1:-1] = _between(frames)
    for row, frame, begins, present in (
        (0, frames[0], -np.inf, not absent), (-1, frames[-1], frames[-1, 0], not vanishes)
    ):  # fmt: skip
        pieces[row, columns.BEGINS] = begins
        pieces[row, columns.X : columns.HEADING + 1] = frame[1:]
        pieces[row, columns.PRESENT] = float(present)
    return pieces, 0.0


def _frames(keyframes: Sequence[Sequence[float]]) -> Floats:
    """Time, x, y [m] and heading [rad] of keyframes, (k, 4)."""
    frames = np.zeros((len(keyframes), 4))
    frames[:, :3] = [frame[:3] for frame in keyframes]
    turned = [k for k, frame in enumerate(keyframes) if len(frame) > 3]
    if turned:
        said = np.deg2rad([keyframes[k][3] for k in turned])
        before = np.searchsorted(turned, np.arange(len(frames)), side="right") - 1
        frames[:, 3] = np.where(before >= 0, said[before], 0.0)
    return frames


def _between(frames: Floats) -> Floats:
    """A piece from each frame to the next."""
    steps = frames[1:] - frames[:-1]
    rates = steps[:, 1:] / steps[:, :1]
    pieces = np.ones((len(rates), COLUMNS))
    pieces[:, columns.BEGINS] = pieces[:, columns.KNOWN] = frames[:-1, 0]
    pieces[:, columns.X : columns.HEADING + 1] = frames[:-1, 1:]
    pieces[:, columns.SPEED_X : columns.TURNING + 1] = rates
    return pieces
