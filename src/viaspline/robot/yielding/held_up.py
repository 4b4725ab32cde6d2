"""A robot that stands because it knows no way on: how often it looks again, and when it gives up.

What stands in its way may go, so it waits for that. While nothing there changes it looks more and
more seldom, for a look costs as much as it did in vain before; and when it has stood so for a
minute it ends its drive and says what stands there.
"""

from __future__ import annotations

import math
from dataclasses import replace

from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import SAME_PLACE_M, Progress
from viaspline.robot.navigation.schedule import HeldUp, Schedule
from viaspline.robot.yielding.held_up_by import held_up_by
from viaspline.tracks.patience import MAX_HELD_UP_S, MAX_PAUSE_S, PAUSE_SHARE
from viaspline.trajectory.retime import braking

LEAST_PAUSE_S = 0.3
"""From one look to the next, at least [s]."""

ALERT_S = 5.0
"""Where something moves it looks in every step for so long [s], and then after the least pause."""


def rests(knowledge: Knowledge, schedule: Schedule, time: float) -> bool:
    """Whether a robot that stands has no reason to look for a way on in this step.

    Args:
        knowledge: All that is known, with what was just seen.
        schedule: What it means to do.
        time: Now [s].
    """
    held = schedule.held_up
    if held is None or time >= held.again or schedule.frozen_since < math.inf:
        return False
    return held.seen == _seen(knowledge)


def held_up(
    task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule
) -> Schedule:
    """The schedule with how long the robot has known no way on; after a minute of that it gives up.

    Args:
        task: What is asked of the drive.
        progress: How far it has come.
        knowledge: All that is known.
        schedule: What it means to do, after this step's look.
    """
    now, before = progress.time, schedule.held_up
    if not _knows_no_way_on(progress, knowledge, schedule):
        return schedule if before is None else replace(schedule, held_up=None)
    since = now if before is None else before.since
    if now - since >= MAX_HELD_UP_S:
        reason = held_up_by(task, progress, knowledge, schedule, now - since)
        stop = braking(progress.distance, 0.0, task.limits.brake, now)
        return replace(schedule, trajectory=stop, giving_up=reason, held_up=None)
    if rests(knowledge, schedule, now):
        return schedule
    seen = _seen(knowledge)
    pause = min(max(PAUSE_SHARE * (now - since), LEAST_PAUSE_S), MAX_PAUSE_S)
    if any(moves for _, _, moves in seen):
        pause = LEAST_PAUSE_S if now - since >= ALERT_S else 0.0
    return replace(schedule, held_up=HeldUp(since, now + pause, seen))


def _knows_no_way_on(progress: Progress, knowledge: Knowledge, schedule: Schedule) -> bool:
    """Whether the robot stands where its law ends, short of its path's end, for what moves."""
    law, now = schedule.trajectory, progress.time
    searches = schedule.pending is not None or schedule.wait is not None
    is_over = progress.finished or schedule.giving_up is not None or progress.dwell is not None
    if searches or is_over or schedule.waits_for_gap or not len(knowledge.moving):
        return False
    ends = float(law.distances[-1])
    is_short = schedule.is_round or ends < schedule.path.length - SAME_PLACE_M
    return is_short and now >= law.end_time and float(law.state_at(now)[1]) == 0.0


def _seen(knowledge: Knowledge) -> tuple[tuple[int, float, bool], ...]:
    """What is in sight that was seen to move: which, since when it is there, and whether it moves.

    Of what moves it isn't said where it is: who stands looks at it again soon anyway.
    """
    told = knowledge.tracked.tracks
    hits = knowledge.hits.tracks if knowledge.hits is not None else ()
    standing = tuple(
        (one.sighting.index, one.still.since if one.stays else 0.0, not one.stays) for one in told
    )
    return (*standing, *((one.number, 0.0, True) for one in hits))
