"""Swerves by which the robots of a fleet would wait less for each other, reckoned from samples.

Robot by robot, the one that waits most first: where it waits long among others that drive by their
laws, swerves of several widths and lengths are tried to either side, before, at and behind the
meeting. First what that meeting costs then is reckoned alone; where that is less by more than the
swerve takes, all that the robot waits is. The best one is taken, and then the next; all others see
that it drives so, and how late it is then.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.linked_grid import LinkedGrid, put_place, take_place
from viaspline.kernels.fleet.packed_samples import PackedSamples
from viaspline.kernels.fleet.sampled_meetings import (
    FIRST,
    LAST,
    WAIT,
    Meetings,
    find_meetings,
    new_meetings,
)
from viaspline.kernels.fleet.swerve_shape import (
    SampledDrive,
    copy_drive,
    delay_drive,
    measure_drive,
    sampled_drive,
    swerve,
)
from viaspline.kernels.fleet.waits_with import (
    RestGrid,
    comes_to_rest,
    shift_behind,
    wait_in_turn,
    wait_of_pair,
    waits_with,
)
from viaspline.kernels.growable import new_floats, new_ints
from viaspline.kernels.jit import inner, kernel, uncounted

LEAST_WAIT_S = 0.3
"""Meetings that cost less are left as they are [s]."""
LEAST_SAVED_S = 0.15
"""What a swerve has to save, beyond what it takes [s]."""
MOST_SWERVES = 5
"""Of one robot."""
WIDTHS = np.array([0.25, 0.5, 0.75, 1.1, 1.5, 2.5, 4.0])
"""How wide swerves are, in distances that two such robots keep from each other."""
HALVES = np.array([1.2, 0.8, 1.8])
"""How long either half is, in lengths at which a straight path needn't be driven more slowly: the
first one of all widths and sides, the others of the one that saves most so."""
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


@uncounted
def _room(swervers: Swervers, robot: int, at: float) -> tuple[float, float]:
    """From where to where along its path a robot may swerve about a place [m]."""
    begin, end = swervers.kept_first[robot], swervers.kept_first[robot + 1]
    k, behind = begin, end
    while k < behind:  # the first one behind the place
        middle = (k + behind) // 2
        if swervers.kept[middle] <= at:
            k = middle + 1
        else:
            behind = middle
    low = swervers.kept[k - 1] if k > begin else -np.inf
    return low, swervers.kept[k] if k < end else np.inf


class SwerveScene(NamedTuple):
    """Among what a robot may swerve.

    Attributes:
        samples: Of all paths.
        grid: Of their places.
        rests: Where robots rest.
        swervers: What they may do.
        spread: See ``wait_in_turn`` [s].
        known: The meetings of the robot that is looked at, and what it waits there; written to,
        scratch: and those of what it tries; written to.
        asked: See ``waits_with``.
    """

    samples: PackedSamples
    grid: LinkedGrid
    rests: RestGrid
    swervers: Swervers
    spread: float
    known: Meetings
    scratch: Meetings
    asked: Ints


@uncounted
def _try_swerve(
    scene: SwerveScene, robot: int, g: int, swerving: tuple[int, float, float],
    drive: SampledDrive, tried: SampledDrive,
) -> tuple[float, float, int]:  # fmt: skip
    """What is waited by a swerve, as far as that is less than it costs at a meeting.

    Args:
        scene: SwerveScene.
        robot: Which one swerves.
        g: The meeting.
        swerving: At which sample, how wide and how long a half of it [m].
        drive: As the robot drives.
        tried: The same; written to, but left as it is where no less is waited.

    Returns:
        (what is waited, infinite where that is no less, how much longer it drives [s], how many
        pairs of samples were looked at, about).
    """
    samples, known, (apex, wide, half) = scene.samples, scene.known, swerving
    bend, most = scene.swervers.bend[robot], known.real[g, WAIT] - LEAST_SAVED_S
    room = _room(scene.swervers, robot, drive.distance[apex])
    begin, end, longer = swerve(drive, apex, wide, half, room, bend, most, tried)
    work, moved = end - begin, (begin, end, longer)
    is_less = longer < most
    if is_less:
        then, looks = wait_of_pair(
            samples, robot, tried, known, g, moved, scene.spread, most - longer
        )
        work += looks
        is_less = then < most - longer and not comes_to_rest(
            scene.rests, robot, samples.reach[robot], tried, begin, end
        )
    if not is_less:
        copy_drive(drive, tried, begin, end)
        return np.inf, longer, work
    delay_drive(tried, end + 1, longer)
    waits = waits_with(
        samples, scene.grid, robot, tried, known, moved, scene.asked, scene.spread, scene.scratch
    )
    return waits, longer, work + 50 * (end - begin)


@inner
def _best_swerve(
    scene: SwerveScene, robot: int, drives: tuple[SampledDrive, SampledDrive, SampledDrive],
    found: Floats,
) -> int:  # fmt: skip
    """The swerve of a robot that saves most, if there is one that saves enough.

    Args:
        scene: SwerveScene.
        robot: Which one.
        drives: As it drives; the same, to write to; and the one that is found, written to.
        found: x, y, width, half and what it saves, (5,); written to.

    Returns:
        How many pairs of samples were looked at, about; minus that where there is none.
    """
    drive, tried, best = drives
    known, size, work, before = scene.known, drive.distance.size, 0, 0.0
    for g in range(known.written[0]):
        before += known.real[g, WAIT]
    least, has_found = before - LEAST_SAVED_S, False
    gentle = 12.0 * 2.0 * scene.samples.reach[robot] / scene.swervers.bend[robot]
    for g in range(known.written[0]):
        if known.real[g, WAIT] < LEAST_WAIT_S:
            continue
        first, last = known.whole[g, FIRST], known.whole[g, LAST]
        middle, finest = 0.5 * (drive.distance[first] + drive.distance[last]), -1
        for k in range(2 * WIDTHS.size * HALVES.size):
            row = k % (2 * WIDTHS.size)
            if k >= 2 * WIDTHS.size and row != finest:
                continue
            half = HALVES[k // (2 * WIDTHS.size)] * math.sqrt(gentle * WIDTHS[row // 2])
            wide = 2.0 * scene.samples.reach[robot] * WIDTHS[row // 2]
            wide = wide if row % 2 == 0 else -wide
            for offset in OFFSETS:
                apex = np.searchsorted(drive.distance, middle + offset * half)
                if apex < 2 or apex > size - 3:
                    continue
                waits, longer, looks = _try_swerve(
                    scene, robot, g, (apex, wide, half), drive, tried
                )
                work += looks
                if waits + longer < least:
                    least, has_found, finest = waits + longer, True, row
                    found[0], found[1] = drive.place[apex, 0], drive.place[apex, 1]
                    found[2], found[3], found[4] = wide, half, before - waits
                    copy_drive(tried, best, 0, size)
                if waits < np.inf:
                    copy_drive(drive, tried, 0, size)
    return work if has_found else -work


@uncounted
def _show_drive(
    samples: PackedSamples, grid: LinkedGrid, robot: int, drive: SampledDrive, known: Meetings
) -> None:
    """Let the others see a robot where it drives now, as late as it is by what it waits."""
    first, g, shift = samples.first[robot], 0, 0.0
    for i in range(drive.distance.size):
        while g < known.written[0] and known.whole[g, FIRST] <= i:
            shift = shift_behind(known, g)
            g += 1
        x, y = drive.place[i, 0], drive.place[i, 1]
        samples.comes[first + i] = drive.comes[i] + shift
        samples.goes[first + i] = drive.goes[i] + shift
        samples.alone[first + i, 0], samples.alone[first + i, 1] = drive.comes[i], drive.goes[i]
        if x != samples.place[first + i, 0] or y != samples.place[first + i, 1]:
            take_place(grid, first + i)
            samples.place[first + i, 0], samples.place[first + i, 1] = x, y
            put_place(grid, first + i, x, y)


@kernel
def swerves_sought(
    samples: PackedSamples, grid: LinkedGrid, rests: RestGrid, swervers: Swervers, order: Ints,
    spread: float, work: int,
) -> tuple[Floats, int]:  # fmt: skip
    """Swerves of a fleet by which less is waited, by what is reckoned from samples.

    Args:
        samples: Of all paths; written to.
        grid: Of their places; written to.
        rests: Where robots rest.
        swervers: What they may do.
        order: The robots to begin with, (m,).
        spread: See ``wait_in_turn`` [s].
        work: So many pairs of samples may be looked at, about.

    Returns:
        The robot of each swerve, x, y, how wide it is, its half, and what it saves: see ``SAVED``,
        (k, 6). Those of one robot follow each other, and are to be made in that order. And how many
        pairs may still be looked at; none: not all robots were.
    """
    robots = samples.reach.size
    known, asked = new_meetings(robots), new_ints(robots, 2)
    scene = SwerveScene(samples, grid, rests, swervers, spread, known, new_meetings(robots), asked)
    found, count = new_floats(order.size * MOST_SWERVES, 6), 0
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
        for turn in range(MOST_SWERVES + 1):
            known.written[0] = 0
            find_meetings(samples, grid, robot, drive, (0, size), (0, size), asked, known)
            wait_in_turn(known, spread)
            work -= 50 * size
            if turn == MOST_SWERVES:
                break
            spent = _best_swerve(scene, robot, drives, found[count, 1:])
            work -= abs(spent)
            if spent <= 0:
                break
            found[count, 0] = robot
            count += 1
            copy_drive(drives[2], drive, 0, size)
            measure_drive(drive)
            copy_drive(drive, drives[1], 0, size)
        _show_drive(samples, grid, robot, drive, known)
    return found[:count].copy(), max(work, 0)
