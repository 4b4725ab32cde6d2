"""A swerve of a path: to one side and back, as far as samples of the path show it.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_samples import PackedSamples
from viaspline.kernels.fleet.shape_aside import share_aside
from viaspline.kernels.jit import inlined, inner, uncounted

SHARPEST = 2.0
"""A path isn't bent by a swerve more sharply than this, in curvatures that cost no speed."""
LEAST_STEP = 0.3
"""Nor are its inner sides made shorter than this share."""


class SampledDrive(NamedTuple):
    """The samples of one robot's path: see ``PackedSamples``.

    Attributes:
        distance: [m], (m,).
        place: [m], (m, 2).
        comes: [s], (m,).
        goes: [s], (m,).
        step: How far it is to the next sample [m], (m,); 0 at the last one.
        bends: About the curvature there [1/m], (m,); 0 at both ends.
    """

    distance: Floats
    place: Floats
    comes: Floats
    goes: Floats
    step: Floats
    bends: Floats


@inlined
def _step(place: Floats, i: int) -> float:
    """How far it is from a sample to the next [m]."""
    dx, dy = place[i + 1, 0] - place[i, 0], place[i + 1, 1] - place[i, 1]
    return math.sqrt(dx * dx + dy * dy)


@inlined
def _curvature(place: Floats, i: int, before: float, after: float) -> float:
    """About the curvature at a sample between two steps [1/m]."""
    ax, ay = place[i, 0] - place[i - 1, 0], place[i, 1] - place[i - 1, 1]
    bx, by = place[i + 1, 0] - place[i, 0], place[i + 1, 1] - place[i, 1]
    if ax * bx + ay * by <= 0.0:
        return np.inf  # it turns back
    return 2.0 * abs(ax * by - ay * bx) / (before * after * (before + after))


@inner
def sampled_drive(samples: PackedSamples, robot: int) -> SampledDrive:
    """Those of one robot, as if it were alone, to write to."""
    begin, end = samples.first[robot], samples.first[robot + 1]
    drive = SampledDrive(
        samples.distance[begin:end].copy(), samples.place[begin:end].copy(),
        samples.alone[begin:end, 0].copy(), samples.alone[begin:end, 1].copy(),
        np.zeros(end - begin), np.zeros(end - begin),
    )  # fmt: skip
    measure_drive(drive)
    return drive


@uncounted
def measure_drive(drive: SampledDrive) -> None:
    """Write how far its samples are apart, and how it bends."""
    last = drive.distance.size - 1
    for i in range(last):
        drive.step[i] = _step(drive.place, i)
    for i in range(1, last):
        drive.bends[i] = _curvature(drive.place, i, drive.step[i - 1], drive.step[i])


@uncounted
def copy_drive(drive: SampledDrive, to: SampledDrive, begin: int, end: int) -> None:
    """Copy the samples from one on, up to another one."""
    for i in range(begin, min(end + 1, drive.distance.size)):
        to.place[i, 0], to.place[i, 1] = drive.place[i, 0], drive.place[i, 1]
        to.comes[i], to.goes[i] = drive.comes[i], drive.goes[i]


@uncounted
def delay_drive(drive: SampledDrive, begin: int, longer: float) -> None:
    """Let a robot come later to all samples from one on, by so much [s]."""
    for i in range(begin, drive.distance.size):
        drive.comes[i] += longer
        drive.goes[i] += longer


@uncounted
def swerve(
    drive: SampledDrive, apex: int, wide: float, half: float, room: tuple[float, float],
    bend: float, most: float, out: SampledDrive,
) -> tuple[int, int, float]:  # fmt: skip
    """Swerve, in samples.

    Args:
        drive: As it is.
        apex: The sample that is to be farthest aside.
        wide: How far, to the left [m].
        half: Length of either half of the swerve [m].
        room: From where to where along the path there is [m].
        bend: The curvature up to which the robot needn't slow down [1/m].
        most: It isn't looked further where it takes more [s].
        out: The same drive; the samples that are moved are written to, and the one behind them.

    Returns:
        (the first sample that is moved, the first behind that isn't, how much later the robot comes
        there [s]); infinitely late where there is no room, or it bends too sharply, or takes more.
    """
    middle, last = drive.distance[apex], drive.distance.size - 1
    if min(middle - room[0], room[1] - middle) < half:
        return apex, apex, np.inf
    begin, end = apex, apex + 1
    while begin > 1 and drive.distance[begin - 1] > middle - half:
        begin -= 1
    while end < last and drive.distance[end] < middle + half:
        end += 1
    for i in range(begin, end):
        share = share_aside(abs(drive.distance[i] - middle), half, -1.0)[0]
        along_x = drive.place[i + 1, 0] - drive.place[i - 1, 0]
        along_y = drive.place[i + 1, 1] - drive.place[i - 1, 1]
        aside = wide * share / max(math.sqrt(along_x * along_x + along_y * along_y), 1e-9)
        out.place[i, 0] = drive.place[i, 0] - aside * along_y
        out.place[i, 1] = drive.place[i, 1] + aside * along_x
    longer, before = 0.0, drive.step[begin - 2] if begin > 1 else 0.0
    for i in range(begin - 1, end):
        slower, after = 1.0, _step(out.place, i)
        if i > 0:
            curvature, had = _curvature(out.place, i, before, after), drive.bends[i]
            if curvature > max(SHARPEST * bend, had):
                return begin, end, np.inf
            if curvature > bend or had > bend:
                slower = math.sqrt(max(curvature / bend, 1.0) / max(had / bend, 1.0))
        stretch = after / max(drive.step[i], 1e-9)
        if stretch < LEAST_STEP:
            return begin, end, np.inf
        longer += (drive.comes[i + 1] - drive.goes[i]) * (stretch * slower - 1.0)
        if longer > most:
            return begin, end, np.inf
        out.comes[i + 1] = drive.comes[i + 1] + longer
        out.goes[i + 1] = drive.goes[i + 1] + longer
        before = after
    return begin, end, longer
