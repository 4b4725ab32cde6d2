"""Swerves by which the robots of a fleet would wait less for each other, reckoned from samples.

Robot by robot, the one with most to wait first: where it meets another one that costs long, swerves
of several widths and lengths are tried to either side, before, at and behind the meeting. First
what that meeting costs then is reckoned alone; where that is less by more than the swerve takes,
all of the robot's meetings are. The best one is taken, and then the next.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.linked_grid import LinkedGrid, put_place, take_place
from viaspline.kernels.fleet.packed_samples import PackedSamples
from viaspline.kernels.fleet.reckoned_waits import (
    FIRST,
    LAST,
    WAIT,
    Meetings,
    new_meetings,
    reckoned_waits,
)
from viaspline.kernels.fleet.swerve_shape import (
    SampledDrive,
    copy_drive,
    sampled_drive,
    swerve,
)
from viaspline.kernels.fleet.waits_with import (
    HORIZON_S,
    MOST_MEETINGS,
    SPREAD_S,
    RestGrid,
    comes_to_rest,
    wait_of_pair,
    waits_with,
)
from viaspline.kernels.growable import new_floats, new_ints
from viaspline.kernels.jit import inner, kernel

LEAST_WAIT_S = 0.5
"""Meetings that cost less are left as they are [s]."""
LEAST_SAVED_S = 0.2
"""What a swerve has to save, beyond what it takes [s]."""
MOST_SWERVES = 5
"""Of one robot."""
WIDTHS = np.array([0.75, 1.5, 2.5, 4.0])
"""How wide swerves are, in distances that two such robots keep from each other."""
HALVES = np.array([0.8, 1.2, 1.8])
"""How long either half is, in lengths at which a straight path needn't be driven more slowly."""
OFFSETS = np.array([-0.8, -0.4, 0.0, 0.4, 0.8])
"""Where they are, from the middle of a meeting, in halves."""
X, Y, WIDE, HALF, SAVED = range(1, 6)
"""Columns of swerves, after the robot: the place that is led farthest aside and how far, to the
left [m]; the length of a half [m]; what it saves others and itself of waiting [s]."""


class Swervers(NamedTuple):
    """What robots may do.

    Attributes:
        bend: The curvature up to which each needn't slow down [1/m]; 0 where its path stays, (n,).
        kept_first: Where the kept places of each begin in ``kept``, (n + 1,).
        kept: Distances along the paths at which these must not change [m], increasing, (k,).
    """

    bend: Floats
    kept_first: Ints
    kept: Floats


@inner
def _room(swervers: Swervers, robot: int, at: float) -> tuple[float, float]:
    """From where to where along its path a robot may swerve about a place [m]."""
    low, high = -np.inf, np.inf
    for k in range(swervers.kept_first[robot], swervers.kept_first[robot + 1]):
        if swervers.kept[k] <= at:
            low = swervers.kept[k]
        else:
            high = min(high, swervers.kept[k])
    return low, high


@inner
def _best_swerve(
    samples: PackedSamples, grid: LinkedGrid, rests: RestGrid, swervers: Swervers, robot: int,
    drives: tuple[SampledDrive, SampledDrive, SampledDrive], known: Meetings, asked: Ints,
    scratch: Meetings, found: Floats,
) -> int:  # fmt: skip
    """The swerve of a robot that saves most, if there is one that saves enough.

    Args:
        samples: Of all paths.
        grid: Of their places.
        rests: Where robots rest.
        swervers: What they may do.
        robot: Which one.
        drives: As it drives; one to write to; and the one that is found, written to.
        known: Its meetings.
        asked: See ``waits_with``.
        scratch: Written to.
        found: x, y, width, half and what it saves, (5,); written to.

    Returns:
        How many pairs of samples were looked at, about; minus that where there is none.
    """
    drive, tried, best = drives
    before = 0.0
    for g in range(known.written[0]):
        before += known.real[g, WAIT]
    least, work, last = before - LEAST_SAVED_S, 0, drive.distance.size - 1
    apart, has_found = 2.0 * samples.reach[robot], False
    for g in range(known.written[0]):
        wait, meeting = known.real[g, WAIT], known.whole[g]
        if wait < LEAST_WAIT_S:
            continue
        middle = 0.5 * (drive.distance[meeting[FIRST]] + drive.distance[meeting[LAST]])
        for k in range(2 * WIDTHS.size * HALVES.size):
            wide = apart * WIDTHS[k // (2 * HALVES.size)] * (1.0 if k % 2 == 0 else -1.0)
            half = HALVES[k // 2 % HALVES.size]
            half *= math.sqrt(12.0 * abs(wide) / swervers.bend[robot])
            for offset in OFFSETS:
                at = middle + offset * half
                apex = np.searchsorted(drive.distance, at)
                if apex < 2 or apex > last - 2:
                    continue
                room = _room(swervers, robot, drive.distance[apex])
                begin, end, longer = swerve(
                    drive, apex, wide, half, room, swervers.bend[robot], tried
                )
                work += drive.distance.size
                if longer >= wait - LEAST_SAVED_S:
                    continue
                then, looks = wait_of_pair(samples, robot, tried, meeting, begin, end)
                work += looks
                if then + longer >= wait - LEAST_SAVED_S:
                    continue
                if comes_to_rest(rests, robot, samples.reach[robot], tried, begin, end):
                    continue
                work += 50 * (end - begin)
                waits = waits_with(
                    samples, grid, robot, tried, known, (begin, end, longer), asked,
                    least - longer, scratch,
                )  # fmt: skip
                if waits + longer < least:
                    least, has_found = waits + longer, True
                    found[0], found[1] = drive.place[apex, 0], drive.place[apex, 1]
                    found[2], found[3], found[4] = wide, half, before - waits
                    copy_drive(tried, best)
    return work if has_found else -work


@kernel
def swerves_sought(
    samples: PackedSamples, grid: LinkedGrid, rests: RestGrid, swervers: Swervers, order: Ints,
    work: int,
) -> tuple[Floats, int]:  # fmt: skip
    """Swerves of a fleet by which less is waited, by what is reckoned from samples.

    Args:
        samples: Of all paths; written to.
        grid: Of their places; written to.
        rests: Where robots rest.
        swervers: What they may do.
        order: The robots to begin with, (m,).
        work: So many pairs of samples may be looked at, about.

    Returns:
        The robot of each swerve, x, y, how wide it is, its half, and what it saves: see ``SAVED``,
        (k, 6). Those of one robot follow each other, and are to be made in that order. And how many
        pairs may still be looked at; none: not all robots were.
    """
    robots = samples.reach.size
    known, scratch = new_meetings(robots, MOST_MEETINGS), new_meetings(robots, MOST_MEETINGS)
    asked, found = new_ints(robots, 2), new_floats(order.size * MOST_SWERVES, 6)
    count = 0
    for robot in order:
        drive = sampled_drive(samples, robot)
        size = drive.distance.size
        if swervers.bend[robot] <= 0.0 or size < 5:
            continue
        if work <= 0:
            break
        for k in range(robots):
            asked[k, 0], asked[k, 1] = size, -1
        drives = drive, sampled_drive(samples, robot), sampled_drive(samples, robot)
        for _ in range(MOST_SWERVES):
            reckoned_waits(
                samples, grid, robot, drive, (0, size), (0, size), asked, SPREAD_S, HORIZON_S,
                np.inf, known,
            )  # fmt: skip
            spent = _best_swerve(
                samples, grid, rests, swervers, robot, drives, known, asked, scratch,
                found[count, 1:],
            )  # fmt: skip
            work -= 50 * size + abs(spent)
            if spent <= 0:
                break
            found[count, 0] = robot
            count += 1
            copy_drive(drives[2], drive)
        first = samples.first[robot]
        for i in range(size):
            x, y = drive.place[i, 0], drive.place[i, 1]
            samples.comes[first + i], samples.goes[first + i] = drive.comes[i], drive.goes[i]
            if x != samples.place[first + i, 0] or y != samples.place[first + i, 1]:
                take_place(grid, first + i)
                samples.place[first + i, 0], samples.place[first + i, 1] = x, y
                put_place(grid, first + i, x, y)
    return found[:count].copy(), max(work, 0)
