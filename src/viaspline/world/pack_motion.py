"""From motions as people write them to the arrays that kernels take.

Tested through ``world/test_moving_obstacles``.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.motion import packed_motion as columns
from viaspline.kernels.motion.packed_motion import COLUMNS, PackedMotion
from viaspline.kernels.world.packed import PackedWorld
from viaspline.mission.motion_spec import Motion
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.world.pack import pack, pack_discs


def pack_motion(obstacles: Sequence[Obstacle], since: Sequence[float]) -> PackedMotion:
    """Pack obstacles that all have a motion.

    Args:
        obstacles: None of them a grid.
        since: When the place of each begins to get less certain [s].
    """
    motions, rings = [], []
    for obstacle in obstacles:
        assert obstacle.motion is not None
        assert obstacle.ring is not None
        motions.append(obstacle.motion)
        rings.append(obstacle.ring)
    pieces, first, rounds = _pieces(motions)
    errors = [
        (begin, motion.error.position_m, motion.error.growth_mps)
        for begin, motion in zip(since, motions, strict=True)
    ]
    reaches = _reaches(rings)
    straight = np.hypot(pieces[:, columns.SPEED_X], pieces[:, columns.SPEED_Y])
    turning = np.repeat(reaches, np.diff(first)) * np.abs(pieces[:, columns.TURNING])
    return PackedMotion(
        pack_shapes(obstacles),
        first,
        pieces,
        rounds,
        np.array(errors, np.float64).reshape(-1, 3),
        reaches,
        np.maximum.reduceat(straight + turning, first[:-1]) if motions else np.empty(0),
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
    circles = [obstacle.circle for obstacle in obstacles if obstacle.circle is not None]
    if len(circles) < len(obstacles) or not circles:
        return pack(obstacles, None, ())
    return pack_discs(np.array([(*circle.center[:2], circle.radius) for circle in circles]))


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


def _pieces(motions: Sequence[Motion]) -> tuple[Floats, Ints, Floats]:
    """The pieces of motions: from each frame to the next, and before and after all of them.

    Returns:
        (pieces (p, COLUMNS), which of them are whose (n + 1,), rounds (n, 2)); see PackedMotion.
    """
    ways = [_frames(motion) for motion in motions]
    frames = np.concatenate(ways) if ways else np.empty((0, 4))
    ends = np.cumsum([len(way) for way in ways], dtype=np.int64) - 1
    begins = np.append(0, ends[:-1] + 1)[: len(ways)]
    pieces = np.ones((len(frames), COLUMNS))
    pieces[:, columns.BEGINS] = pieces[:, columns.KNOWN] = frames[:, 0]
    pieces[:, columns.X : columns.HEADING + 1] = frames[:, 1:]
    rates = pieces[:, columns.SPEED_X : columns.TURNING + 1]
    steps = frames[1:] - frames[:-1]
    steps[ends[:-1], 0] = 1.0  # from the last frame of one to the first of the next goes nothing
    rates[:-1] = steps[:, 1:] / steps[:, :1]
    rates[ends] = [(*(motion.velocity_mps or (0.0, 0.0))[:2], 0.0) for motion in motions] or 0.0
    pieces[ends, columns.PRESENT] = [motion.after != "vanish" for motion in motions]
    return _with_ends(pieces, begins, ends, motions)


def _with_ends(
    pieces: Floats, begins: Ints, ends: Ints, motions: Sequence[Motion]
) -> tuple[Floats, Ints, Floats]:
    """What there is before the first frames, and after the last ones; see ``_pieces``.

    Args:
        pieces: One from each frame on, (f, COLUMNS).
        begins: The first of each motion, (n,).
        ends: The last of each motion, (n,).
        motions: Of which they are.
    """
    goes_on = np.array([motion.after in ("loop", "bounce") for motion in motions], np.bool_)
    is_straight = np.array([motion.keyframes is None for motion in motions], np.bool_)
    is_ended = ~(goes_on | is_straight)
    periods = pieces[ends, columns.BEGINS] - pieces[begins, columns.BEGINS]
    rounds = np.column_stack((pieces[begins, columns.BEGINS], periods))
    rounds[~goes_on] = 0.0
    pieces[begins[is_straight], columns.BEGINS] = -np.inf
    before = pieces[begins[is_ended]]
    before[:, columns.BEGINS] = -np.inf
    before[:, columns.SPEED_X : columns.TURNING + 1] = 0.0
    before[:, columns.PRESENT] = [
        not _is_absent_before(motion)
        for motion, ended in zip(motions, is_ended.tolist(), strict=True)
        if ended
    ]
    kept = np.ones(len(pieces), np.bool_)
    kept[ends[goes_on]] = False  # there the round begins again
    at: Ints = (np.cumsum(kept) - kept)[begins[is_ended]]
    counts = ends - begins + 1 + is_ended - goes_on
    return np.insert(pieces[kept], at, before, axis=0), np.append(0, np.cumsum(counts)), rounds


def _is_absent_before(motion: Motion) -> bool:
    """Whether it isn't there before its first keyframe."""
    return motion.after == "vanish" if motion.before is None else motion.before == "absent"


def _frames(motion: Motion) -> Floats:
    """Time, x, y [m] and heading [rad] of keyframes, (k, 4), those of the way back as well.

    A motion that goes straight on has one, of time 0.
    """
    if motion.keyframes is None:
        assert motion.from_ is not None
        return np.array(((0.0, *motion.from_[:2], 0.0),))
    keyframes = motion.keyframes
    frames = np.zeros((len(keyframes), 4))
    frames[:, :3] = [frame[:3] for frame in keyframes]
    turned = [k for k, frame in enumerate(keyframes) if len(frame) > 3]
    if turned:
        said = np.deg2rad([keyframes[k][3] for k in turned])
        before = np.searchsorted(turned, np.arange(len(frames)), side="right") - 1
        frames[:, 3] = np.where(before >= 0, said[before], 0.0)
    if motion.after != "bounce":
        return frames
    back = frames[-2::-1].copy()
    back[:, 0] = 2.0 * frames[-1, 0] - back[:, 0]
    return np.concatenate((frames, back))
