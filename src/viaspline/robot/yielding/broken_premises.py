"""What was seen to do what nothing does by the mission: then nothing that was proven by it holds.

Tested through ``robot/yielding/test_broken_premises``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.perception.moving.object_track import ObjectTrack
from viaspline.robot.perception.moving.track_sightings import SightedTrack
from viaspline.robot.run import Event

SIGMAS = 3.0
"""Something is too fast if it is even with an error of so many standard deviations."""


def broken_premises(
    task: DriveTask, progress: Progress, before: Knowledge, now: Knowledge, schedule: Schedule
) -> tuple[Event, ...]:
    """What a look has shown to jump, or to be faster than the mission says anything is.

    A thing is told of when it begins to be too fast, and not again until it has been slower.

    Args:
        task: With the mission that says how fast things may be; if it doesn't, nothing is told.
        progress: When the look was, and how far the robot had come.
        before: What was known before the look.
        now: What is known after it.
        schedule: Where the robot is driving.
    """
    premise = task.mission.robot.moving
    if premise is None:
        return ()
    top, here = premise.max_speed_mps, schedule.place(progress.distance)
    fast = {key for key, track in _tracks(before) if _is_faster(track, top)}
    found = []
    for key, track in _tracks(now):
        name, data = key[1], {"name": key[1]}
        if isinstance(track, SightedTrack) and track.jumped:
            words = f"the premise is broken: '{name}' jumped"
            found.append(Event("premise", progress.time, here, words, data))
        if _is_faster(track, top) and key not in fast:
            speed = math.hypot(*track.estimate.velocity.tolist())
            words = f"the premise is broken: '{name}' goes {speed:.2f} m/s, and not {top:g} at most"
            found.append(Event("premise", progress.time, here, words, data))
    return tuple(found)


def _tracks(known: Knowledge) -> Iterator[tuple[tuple[int, str], ObjectTrack | SightedTrack]]:
    """All that is followed, each with what it is known by."""
    for sighted in known.tracked.tracks if known.tracked is not None else ():
        seen = sighted.sighting
        yield (seen.index, seen.obstacle.name or f"moving obstacle {seen.index + 1}"), sighted
    for track in known.hits.tracks if known.hits is not None else ():
        yield (track.number, f"moving thing {track.number}"), track


def _is_faster(track: ObjectTrack | SightedTrack, top: float) -> bool:
    estimate = track.estimate
    speed = math.hypot(*estimate.velocity.tolist())
    return speed - SIGMAS * estimate.velocity_error > top
