"""Does every motion say all that it takes, and does time go forward in it?

Tested through ``mission/test_motion``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.greatest_speed import gone_too_fast, turned_too_fast
from viaspline.mission.motion_spec import Motion
from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number

MIN_PERIOD_S = 1e-3
"""The shortest round of a motion that goes on and on."""

JUMP_M = 1e-3
"""A loop whose end is so near to its beginning doesn't jump."""


def motion_faults(partial: PartialMission) -> list[UnplacedFault]:
    """What is wrong with how obstacles move."""
    return [
        fault
        for path, obstacle in partial.known + partial.unseen
        if obstacle.motion is not None
        for fault in faults_of_one(path, obstacle, obstacle.motion)
    ]


def faults_of_one(path: Path, obstacle: Obstacle, motion: Motion) -> Iterator[UnplacedFault]:
    """What is wrong with how one obstacle moves."""
    yield from _of_shape(path, obstacle)
    yield from _of_motion((*path, "motion"), motion)


def _of_shape(path: Path, obstacle: Obstacle) -> Iterator[UnplacedFault]:
    if obstacle.voxels is not None:
        yield UnplacedFault((*path, "motion"), "voxels can't move", "give a box", at_key=True)
    if obstacle.grid is not None:
        yield UnplacedFault(
            (*path, "motion"), "a map of squares can't move", "give it a polygon", at_key=True
        )
    if obstacle.holes:
        problem = "a polygon that moves can't have holes"
        yield UnplacedFault((*path, "holes"), problem, "leave them out", at_key=True)
    for key in ("pass_on", "never_pass_on"):
        if getattr(obstacle, key) is not None:
            problem = "what moves has no side to be passed on"
            yield UnplacedFault((*path, key), problem, "leave it out", at_key=True)


def _of_motion(path: Path, motion: Motion) -> Iterator[UnplacedFault]:
    if motion.keyframes is None:
        if motion.velocity_mps is None:
            remedy = "give velocity_mps: [vx, vy], or leave out motion if it stands"
            yield UnplacedFault(path, "motion doesn't say how fast it goes", remedy)
        return
    if motion.after is None:
        problem = "it isn't said what it does when the keyframes are over"
        yield UnplacedFault(path, problem, "give after: loop, bounce, stay or vanish")
    yield from _of_keyframes((*path, "keyframes"), motion)


def _of_keyframes(path: Path, motion: Motion) -> Iterator[UnplacedFault]:
    frames = motion.keyframes or ()
    times = np.array([frame[0] for frame in frames])
    steps = np.flatnonzero(np.diff(times) <= 0.0)
    if steps.size:
        i = int(steps[0]) + 1
        problem = f"is at {number(times[i])} s, not after the one before"
        yield UnplacedFault((*path, i), problem, "times of keyframes increase; leave one out")
    elif motion.after in ("loop", "bounce") and _is_short(times):
        problem = f"last {times[-1] - times[0]:g} s, too short a time to go on and on"
        remedy = f"give keyframes over {MIN_PERIOD_S:g} s at least, or after: stay"
        yield UnplacedFault(path, problem, remedy)
    else:
        yield from _of_speeds(path, motion, times)
    if motion.after in ("loop", "bounce") and motion.before is not None:
        problem = f"what goes on and on (after: {motion.after}) has no before"
        yield UnplacedFault((*path[:-1], "before"), problem, "leave it out", at_key=True)


def _is_short(times: Floats) -> bool:
    return bool(times[-1] - times[0] < MIN_PERIOD_S)


def _of_speeds(path: Path, motion: Motion, times: Floats) -> Iterator[UnplacedFault]:
    """What is wrong with how fast it goes and turns from one keyframe to the next."""
    frames = motion.keyframes or ()
    flat = np.array([frame[1:3] for frame in frames])
    heights = _held([frame[4] if len(frame) > 4 else math.nan for frame in frames])
    headings = _held([frame[3] if len(frame) > 3 else math.nan for frame in frames])
    found = (
        gone_too_fast(times, np.column_stack((flat, heights))), turned_too_fast(times, headings)
    )  # fmt: skip
    for one in found:
        if one is not None:
            i, problem, remedy = one
            yield UnplacedFault((*path, i), problem, remedy)


def _held(numbers: list[float]) -> Floats:
    """Numbers of which each that isn't said is that of the one before, at first 0.

    >>> _held([math.nan, 3.0, math.nan]).tolist()
    [0.0, 3.0, 3.0]
    """
    said = np.isfinite(numbers)
    return np.nan_to_num(numbers)[np.maximum.accumulate(np.where(said, np.arange(len(said)), 0))]


def jumps_in_words(obstacles: Iterable[Obstacle]) -> str | None:
    """What jumps where it begins again, in one sentence; None if nothing does.

    >>> from viaspline.mission.shapes.obstacle import Obstacle
    >>> there = {"keyframes": [(0, 1, 2), (4, 5, 2)], "after": "loop"}
    >>> disc = {"center": (0, 0), "radius": 1}
    >>> jumps_in_words([Obstacle(circle=disc, name="cart", motion=there)])
    "'cart' jumps by 4 m where its loop begins again"
    """
    found = []
    for i, obstacle in enumerate(obstacles):
        motion = obstacle.motion
        if motion is None or motion.after != "loop" or motion.keyframes is None:
            continue
        first, last = motion.keyframes[0], motion.keyframes[-1]
        far = math.dist(first[1:3], last[1:3])
        if far > JUMP_M:
            found.append((far, obstacle.name or f"obstacle {i + 1}"))
    if not found:
        return None
    far, name = max(found)
    if len(found) == 1:
        return f"'{name}' jumps by {number(far)} m where its loop begins again"
    return f"{len(found)} loops jump where they begin again, '{name}' the farthest: {number(far)} m"
