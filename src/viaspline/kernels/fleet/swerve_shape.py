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
    """

    distance: Floats
    place: Floats
    comes: Floats
    goes: Floats


@inner
def sampled_drive(samples: PackedSamples, robot: int) -> SampledDrive:
    """Those of one robot, to write to."""
    begin, end = samples.first[robot], samples.first[robot + 1]
    return SampledDrive(
        samples.distance[begin:end].copy(), samples.place[begin:end].copy(),
        samples.comes[begin:end].copy(), samples.goes[begin:end].copy(),
    )  # fmt: skip


@uncounted
def copy_drive(drive: SampledDrive, to: SampledDrive) -> None:
    """Copy all samples."""
    for i in range(drive.distance.size):
        to.place[i, 0], to.place[i, 1] = drive.place[i, 0], drive.place[i, 1]
        to.comes[i], to.goes[i] = drive.comes[i], drive.goes[i]


@inlined
def _step(place: Floats, i: int) -> float:
    """How far it is from a sample to the next [m]."""
    dx, dy = place[i + 1, 0] - place[i, 0], place[i + 1, 1] - place[i, 1]
    return math.sqrt(dx * dx + dy * dy)


@inlined
def _curvature(place: Floats, i: int) -> float:
    """About the curvature at a sample that has one before and one behind [1/m]."""
    ax, ay = place[i, 0] - place[i - 1, 0], place[i, 1] - place[i - 1, 1]
    bx, by = place[i + 1, 0] - place[i, 0], place[i + 1, 1] - place[i, 1]
    before, after = math.sqrt(ax * ax + ay * ay), math.sqrt(bx * bx + by * by)
    if ax * bx + ay * by <= 0.0:
        return np.inf  # it turns back
    return 2.0 * abs(ax * by - ay * bx) / (before * after * (before + after))


@inner
def swerve(
    drive: SampledDrive, apex: int, wide: float, half: float, room: tuple[float, float],
    bend: float, out: SampledDrive,
) -> tuple[int, int, float]:  # fmt: skip
    """Swerve, in samples.

    Args:
        drive: As it is.
        apex: The sample that is to be farthest aside.
        wide: How far, to the left [m].
        half: Length of either half of the swerve [m].
        room: From where to where along the path there is [m].
        bend: The curvature up to which the robot needn't slow down [1/m].
        out: The drive; written to.

    Returns:
        (the first sample that is moved, the first behind that isn't, how much longer it takes [s]);
        infinitely long where there is no room, or it bends too sharply.
    """
    middle, last = drive.distance[apex], drive.distance.size - 1
    if min(middle - room[0], room[1] - middle) < half:
        return apex, apex, np.inf
    begin, end = apex, apex + 1
    while begin > 1 and drive.distance[begin - 1] > middle - half:
        begin -= 1
    while end < last and drive.distance[end] < middle + half:
        end += 1
    copy_drive(drive, out)
    for i in range(begin, end):
        share = share_aside(abs(drive.distance[i] - middle), half, -1.0)[0]
        along_x = drive.place[i + 1, 0] - drive.place[i - 1, 0]
        along_y = drive.place[i + 1, 1] - drive.place[i - 1, 1]
        aside = wide * share / max(math.hypot(along_x, along_y), 1e-9)
        out.place[i, 0] -= aside * along_y
        out.place[i, 1] += aside * along_x
    longer = 0.0
    for i in range(begin - 1, end):
        slower = 1.0
        if i > 0:
            curvature, had = _curvature(out.place, i), _curvature(drive.place, i)
            if curvature > max(SHARPEST * bend, had):
                return apex, apex, np.inf
            slower = math.sqrt(max(curvature / bend, 1.0) / max(had / bend, 1.0))
        stretch = _step(out.place, i) / max(_step(drive.place, i), 1e-9)
        if stretch < LEAST_STEP:
            return apex, apex, np.inf
        longer += (drive.comes[i + 1] - drive.goes[i]) * (stretch * slower - 1.0)
        out.comes[i + 1] += longer
        out.goes[i + 1] += longer
    for i in range(end + 1, drive.distance.size):
        out.comes[i] += longer
        out.goes[i] += longer
    return begin, end, longer
