"""The static law with waits where it rests anyway: what keeps every limit whatever it is.

Tested through ``trajectory/yielding/test_waiting_at_rests``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from viaspline.planning.problem.method import Found, GaveUp, Outcome
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.road import Road
from viaspline.trajectory.yielding.traffic import EvenPieces, Traffic

DELAY_S = 0.1
"""From one delay that is tried to the next [s]."""
LONGEST_WAIT_S = 120.0
"""At one rest [s]."""


def waiting_at_rests(road: Road, traffic: Traffic, static: Trajectory) -> Outcome[Trajectory]:
    """The static law with the least waits at its rests, from one to the next.

    Args:
        road: The path.
        traffic: What moves.
        static: The fastest law where nothing does.

    Returns:
        The law, which needn't be the fastest; or that none was found.
    """
    law = static
    for i in _rests(static):
        later = _begun_later(road, traffic, law, i)
        if later is None:
            return GaveUp(
                ("waiting at the start and at stops",),
                "a path without moving obstacles, or limits of the speed and the acceleration "
                "alone: then it is sought where to slow down as well",
                reason="the limits of the robot couple speed and acceleration, and no wait at a "
                "stop lets what moves pass",
            )
        law = later
    if traffic.conflict(road, law) is not None:
        return GaveUp(
            ("waiting at the start and at stops",),
            "a slower start",
            reason="something comes too near before the robot can stop, or after it has arrived",
        )
    return Found(law, law.end_time, is_settled=False)


def _rests(law: Trajectory) -> Iterator[int]:
    """The last point of each rest before the end."""
    for i in range(len(law.times) - 1):
        if law.speeds[i] == 0.0 and law.distances[i + 1] > law.distances[i]:
            yield i


def _begun_later(road: Road, traffic: Traffic, law: Trajectory, i: int) -> Trajectory | None:
    """The law that waits at a rest until the way to the next one is clear."""
    rests = np.flatnonzero(law.speeds[i + 1 :] == 0.0)
    end = i + 1 + int(rests[0])
    while end + 1 < len(law.times) and law.distances[end + 1] == law.distances[end]:
        end += 1  # the stay at the next rest is a part of it
    begin = float(law.times[i])
    free = traffic.free_until(road, float(law.distances[i]), begin, begin + LONGEST_WAIT_S)
    is_last = end == len(law.times) - 1
    part = EvenPieces.of(_part(law, i, end))
    asked = traffic if is_last else replace(traffic, hold=0.0)
    for k in range(1 + int((min(free, begin + LONGEST_WAIT_S) - begin) / DELAY_S)):
        if asked.conflict_later(road, part, k * DELAY_S) is None:
            return law.waiting_after(i, k * DELAY_S) if k else law
    return None


def _part(law: Trajectory, first: int, last: int) -> Trajectory:
    points, pieces = slice(first, last + 1), slice(first, last)
    return replace(
        law,
        distances=law.distances[points],
        speeds=law.speeds[points],
        times=law.times[points],
        accelerations=law.accelerations[pieces],
        changes=None if law.changes is None else law.changes[pieces],
        jerks=None if law.jerks is None else law.jerks[pieces],
        stations=(),
    )
