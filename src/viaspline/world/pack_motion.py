"""From motions as people write them to the arrays that kernels take.

Tested through ``world/test_moving_obstacles``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.motion import packed_motion as columns
from viaspline.kernels.motion.packed_motion import COLUMNS, PackedMotion
from viaspline.kernels.world.packed import PackedWorld
from viaspline.mission.motion_spec import Motion
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.pack import pack


def pack_motion(obstacles: Sequence[Obstacle], since: Sequence[float]) -> PackedMotion:
    """Pack obstacles that all have a motion.

    Args:
        obstacles: None of them a grid.
        since: When the place of each begins to get less certain [s].
    """
    rows, rounds, errors, reaches, speeds = [], [], [], [], []
    for obstacle, begin in zip(obstacles, since, strict=True):
        motion, ring = obstacle.motion, obstacle.ring
        assert motion is not None
        assert ring is not None
        pieces, period = _pieces(motion)
        rows.append(pieces)
        rounds.append((0.0 if period == 0.0 else pieces[0, columns.BEGINS], period))
        errors.append((begin, motion.error.position_m, motion.error.growth_mps))
        reach = float(np.hypot(*ring.vertices.T).max()) + ring.radius
        reaches.append(reach)
        straight = np.hypot(pieces[:, columns.SPEED_X], pieces[:, columns.SPEED_Y])
        turning = reach * np.abs(pieces[:, columns.TURNING])
        speeds.append(float((straight + turning).max()))
    counts = [len(pieces) for pieces in rows]
    return PackedMotion(
        pack_shapes(obstacles),
        np.concatenate(([0], np.cumsum(counts, dtype=np.int64))).astype(np.int64),
        np.concatenate(rows) if rows else np.empty((0, COLUMNS)),
        np.array(rounds, np.float64).reshape(-1, 2),
        np.array(errors, np.float64).reshape(-1, 3),
        np.array(reaches, np.float64),
        np.array(speeds, np.float64),
    )


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
    before = _standing(frames[:1], -np.inf, present=not absent)
    after = _standing(frames[-1:], frames[-1, 0], present=not vanishes)
    return np.concatenate((before, _between(frames), after)), 0.0


def _frames(keyframes: Sequence[Sequence[float]]) -> Floats:
    """Time, x, y [m] and heading [rad] of keyframes, (k, 4)."""
    frames = np.array([frame[:3] for frame in keyframes], np.float64)
    headings = np.zeros(len(frames))
    turned = np.array([k for k, frame in enumerate(keyframes) if len(frame) > 3], np.int64)
    if turned.size:
        said = np.deg2rad([keyframes[k][3] for k in turned])
        before = np.searchsorted(turned, np.arange(len(frames)), side="right") - 1
        headings = np.where(before >= 0, said[before], 0.0)
    return np.column_stack((frames, headings))


def _between(frames: Floats) -> Floats:
    """A piece from each frame to the next."""
    rates = np.diff(frames[:, 1:], axis=0) / np.diff(frames[:, 0])[:, None]
    pieces = np.ones((len(rates), COLUMNS))
    pieces[:, columns.BEGINS] = pieces[:, columns.KNOWN] = frames[:-1, 0]
    pieces[:, columns.X : columns.HEADING + 1] = frames[:-1, 1:]
    pieces[:, columns.SPEED_X : columns.TURNING + 1] = rates
    return pieces


def _standing(frame: Floats, begins: float, *, present: bool) -> Floats:
    """A piece in which it stands at a frame (1, 4), or isn't there."""
    piece = np.zeros((1, COLUMNS))
    piece[0, columns.BEGINS] = begins
    piece[0, columns.X : columns.HEADING + 1] = frame[0, 1:]
    piece[0, columns.PRESENT] = float(present)
    return piece
