"""What was seen to do what nothing does by the mission: then nothing that was proven by it holds.

Tested through ``robot/yielding/test_broken_premises``.
"""

from __future__ import annotations

from collections.abc import Iterator

from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.perception.moving.object_track import ObjectTrack
from viaspline.robot.perception.moving.track_sightings import SightedTrack
from viaspline.robot.run import Event
from viaspline.tracks.premise import is_faster, jumped_words, too_fast_words


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
    sensor = task.mission.robot.sensor
    noise = 0.0 if sensor is None else sensor.velocity_noise_mps
    fast = {key for key, track in _tracks(before) if is_faster(track.estimate, top, noise)}
    found = []
    for key, track in _tracks(now):
        name, data = key[1], {"name": key[1]}
        if isinstance(track, SightedTrack) and track.jumped:
            words = jumped_words(name)
            found.append(Event("premise", progress.time, here, words, data))
        if is_faster(track.estimate, top, noise) and key not in fast:
            words = too_fast_words(name, track.estimate, top)
            found.append(Event("premise", progress.time, here, words, data))
    return tuple(found)


def _tracks(known: Knowledge) -> Iterator[tuple[tuple[int, str], ObjectTrack | SightedTrack]]:
    """All that is followed, each with what it is known by."""
    for sighted in known.tracked.tracks:
        seen = sighted.sighting
        yield (seen.index, seen.obstacle.name or f"moving obstacle {seen.index + 1}"), sighted
    for track in known.hits.tracks if known.hits is not None else ():
        yield (track.number, f"moving thing {track.number}"), track
