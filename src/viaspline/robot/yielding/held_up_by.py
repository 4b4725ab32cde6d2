"""Why a robot knows no way on, in words: what stands or moves where its path leads.

Tested through ``robot/yielding/test_held_up``.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule, vias_after
from viaspline.robot.yielding.closed_gap import help_past

MAX_PLACES = 500
"""Places of the path that are looked at for what is on it."""

MAX_NAMED = 3
"""So many that are in the way are named."""


class _InTheWay(NamedTuple):
    """Something that is nearer to the path ahead than the robot is to be.

    Attributes:
        along: Which of the places of the path it is first near to.
        name: What it is called.
        at: Where it is [m].
        since: Since when it stands there [s]; None: it moves.
        on: The point of the route that it stands on; None if it stands on none.
        which: Of all that moves, as in ``knowledge.moving``.
    """

    along: int
    name: str
    at: tuple[float, float]
    since: float | None
    on: str | None
    which: int


def held_up_by(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule, stood: float
) -> str:
    """Why a robot gives up that has known no way on for some time, and what would help.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known.
        schedule: What it means to do.
        stood: For how long [s].
    """
    waited = f"for {stood:.0f} s no way on was found past"
    met = sorted(_in_the_way(task, progress, knowledge, schedule))
    if not met:
        return f"{waited} what moves there; another way, or another time, would help"
    words = [_words(one, progress.time) for one in met[:MAX_NAMED]]
    if len(met) > MAX_NAMED:
        words.append(f"{len(met) - MAX_NAMED} more")
    if any(one.on is not None for one in met):
        helps = "move it off, or leave that point out of the route"
    elif any(one.since is not None for one in met):
        standing = tuple(one.which for one in met if one.since is not None)
        helps = help_past(task, progress, knowledge, schedule, standing)
    else:
        helps = "another way, or another time, would help"
    sight = _sight_in_words(task)
    return f"{waited} {', '.join(words)}; {helps}{sight}"


def _words(one: _InTheWay, now: float) -> str:
    x, y = one.at
    if one.since is None:
        return f"'{one.name}', which moves"
    where = "" if one.on is None else f", on '{one.on}',"
    return f"'{one.name}', which has stood at ({x:.2f}, {y:.2f}){where} for {now - one.since:.0f} s"


def _sight_in_words(task: DriveTask) -> str:
    """That the robot sees no farther than it is to keep, if that is so."""
    sensor, kept = task.mission.robot.sensor, task.kept_to_moving
    if sensor is None or sensor.reach > kept:
        return ""
    return (
        f"; it sees {sensor.reach:g} m (robot.sensor.range_m) and is to keep {kept:g} m from its "
        "middle: it can't stop in what it sees"
    )


def _in_the_way(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule
) -> Iterator[_InTheWay]:
    """What is in the way."""
    path, moving, now = schedule.path, knowledge.moving, progress.time
    along = np.linspace(min(progress.distance, path.length), path.length, MAX_PLACES)
    ahead = np.asarray(path.at_distance(along))[:, :2]
    points = [via for via, _ in vias_after(path, progress.last_via)]
    told = knowledge.tracked.tracks
    frames = moving.frames(now)
    for i in range(len(moving)):
        alone = moving.alone(i)
        near = np.flatnonzero(alone.distance(ahead, now) < task.kept_to_moving)
        if not near.size:
            continue
        seen = i - knowledge.charted
        track = told[seen] if 0 <= seen < len(told) else None
        since = track.still.since if track is not None and track.stays else None
        on = [
            via.name for via in points if alone.distance(via.at[:2], now)[0] < task.kept_to_moving
        ]
        x, y, _ = frames[i].tolist()
        yield _InTheWay(int(near[0]), moving.name(i), (x, y), since, on[0] if on else None, i)
