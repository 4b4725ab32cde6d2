"""A fleet that is driven, tick by tick: reports, grants, drives.

Tested through ``fleet/execution/test_simulate_fleet``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.dispatching import grant_of, new_dispatch, swap_orders, take_report
from viaspline.kernels.fleet.granted_drive import (
    PackedDrive,
    PackedTrouble,
    drive_stretch,
    new_drive,
)
from viaspline.kernels.fleet.order_swaps import settle_recall
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_dispatch import PackedDispatch
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.growable import new_floats, sized_floats
from viaspline.kernels.jit import inlined, inner, kernel

SAME_SLOPE = 1e-9
"""Slopes of the square of a speed that differ by less are one [m/s²]."""
SWAPPED: Final = 0
WAITS: Final = 1
GOES_ON: Final = 2


class FleetTicks(NamedTuple):
    """What was driven.

    Attributes:
        stretches: Robot, time [s], place [m] and square of the speed [m²/s²] where a stretch of
            even acceleration begins, in the order of time for each robot, (m, 4).
        happened: What, when [s], robot, other robot, and its place [m], but the crossing of an
            order that was swapped, in the order of time, (e, 5).
        arrived: When each robot came to its end [s]; infinite: it never did, (n,).
        place: Where robots are at the end [m], (n,).
        end: The time then [s].
    """

    stretches: Floats
    happened: Floats
    arrived: Floats
    place: Floats
    end: float


@inlined
def chance(seed: int, tick: int, number: int) -> float:
    """A number from 0 to 1 that is the same for the same arguments."""
    x = np.uint64(seed) * np.uint64(0x9E3779B97F4A7C15) + np.uint64(tick)
    x = x * np.uint64(0xD1342543DE82EF95) + np.uint64(number)
    for _ in range(2):
        x = (x ^ (x >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        x = (x ^ (x >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        x = x ^ (x >> np.uint64(31))
    return float(x >> np.uint64(11)) / 9007199254740992.0


@inner
def _noted(rows: Floats, count: int, row: tuple[float, float, float, float, float]) -> Floats:
    """The table with a row at the end; there is room for it."""
    if count == rows.shape[0]:
        rows = sized_floats(rows, count, 2 * count + 64)
    for i in range(rows.shape[1]):
        rows[count, i] = row[i]
    return rows


@inner
def _drive_tick(
    drive: PackedDrive, courses: PackedCourses, rides: PackedRides, trouble: PackedTrouble,
    grants: Floats, now: float, step: float, stretches: Floats, count: int,
) -> tuple[Floats, int]:  # fmt: skip
    """Drive every robot for one tick; where its acceleration changes, that is written down."""
    for robot in range(grants.size):
        time, until = now, now + step
        while time < until and drive.arrived[robot] == np.inf:
            before, place, square = drive.slope[robot], drive.place[robot], drive.square[robot]
            began = time
            time = drive_stretch(drive, courses, rides, trouble, robot, grants[robot], time, until)
            if abs(drive.slope[robot] - before) > SAME_SLOPE:
                stretches = _noted(stretches, count, (float(robot), began, place, square, 0.0))
                count += 1
    return stretches, count


@inner
def _hear(
    orders: PackedOrders, dispatch: PackedDispatch, drive: PackedDrive, trouble: PackedTrouble,
    grants: Floats, heard: Floats, tick: int, now: float,
) -> int:  # fmt: skip
    """Take the reports that aren't lost; how many orders were swapped for what they say."""
    swapped = 0
    for robot in range(grants.size):
        if chance(trouble.seed, 2 * tick, robot) < trouble.lost:
            continue
        place = drive.place[robot]
        if drive.arrived[robot] < np.inf and orders.vanishes[robot]:
            place = np.inf
        if take_report(orders, dispatch, robot, place, grants[robot], heard[robot], now):
            swapped += settle_recall(orders, dispatch, robot)
    return swapped


@inner
def _grant(
    orders: PackedOrders, dispatch: PackedDispatch, drive: PackedDrive, rides: PackedRides,
    trouble: PackedTrouble, grants: Floats, heard: Floats, tick: int, now: float,
) -> None:  # fmt: skip
    """Tell robots how far they may go; one that couldn't stop any more keeps what it had."""
    for robot in range(grants.size):
        grant = grant_of(orders, dispatch, robot)
        if chance(trouble.seed, 2 * tick + 1, robot) < trouble.lost:
            continue
        heard[robot] = now
        room = 2.0 * rides.brake[robot] * (grant - drive.place[robot])
        if grant >= grants[robot] or drive.square[robot] <= room:
            grants[robot] = grant


@inner
def _note_swaps(
    seen: Ints, dispatch: PackedDispatch, now: float, happened: Floats, events: int
) -> tuple[Floats, int]:
    """Write down whose orders have been swapped since that was done before."""
    for c in range(seen.size):
        if seen[c] != dispatch.leaders[c]:
            row = (float(SWAPPED), now, float(dispatch.leaders[c]), float(seen[c]), float(c))
            happened = _noted(happened, events, row)
            events += 1
            seen[c] = dispatch.leaders[c]
    return happened, events


@inner
def _note_waits(
    orders: PackedOrders, dispatch: PackedDispatch, drive: PackedDrive, grants: Floats,
    waits: Flags, now: float, happened: Floats, events: int,
) -> tuple[Floats, int]:  # fmt: skip
    """Write down who has begun to wait for another, and who goes on."""
    for robot in range(grants.size):
        held = (
            drive.square[robot] == 0.0
            and drive.arrived[robot] == np.inf
            and dispatch.head[robot] < orders.first[robot + 1]
            and grants[robot] - drive.place[robot] <= 1e-6
        )
        if held != waits[robot]:
            waits[robot] = held
            bar = min(dispatch.head[robot], orders.place.size - 1)
            row = (
                float(WAITS if held else GOES_ON), now, float(robot), float(orders.other[bar]),
                drive.place[robot],
            )  # fmt: skip
            happened = _noted(happened, events, row)
            events += 1
    return happened, events


@kernel
def fleet_ticks(
    courses: PackedCourses, rides: PackedRides, alone: PackedLaws, orders: PackedOrders,
    leaders: Ints, trouble: PackedTrouble, begin: float, step: float, longest: int,
    swap_every: int,
) -> FleetTicks:  # fmt: skip
    """Drive a fleet until all have arrived, or the ticks run out, or none will ever get on.

    Args:
        courses: PackedCourses.
        rides: How robots drive where nobody is in their way.
        alone: Their laws if they set out at 0 s.
        orders: PackedOrders.
        leaders: Who passes each crossing first, (c,).
        trouble: PackedTrouble.
        begin: When the first tick is [s].
        step: From report to report [s].
        longest: So many ticks at most.
        swap_every: After so many ticks it is looked for orders to swap; 0: never.
    """
    count = orders.length.size
    drive = new_drive(courses, rides, trouble)
    dispatch = new_dispatch(orders, leaders, rides.depart)
    seen = leaders.copy()
    grants = np.zeros(count)
    heard = np.full(count, -np.inf)
    waits = np.zeros(count, np.bool_)
    stretches, rows = new_floats(64 + 32 * count, 5), 0
    happened, events = new_floats(64, 5), 0
    tick, now = 0, begin
    for robot in range(count):  # those without a law never set out
        dispatch.fixed[robot] = rides.depart[robot] == np.inf
    bound = count - dispatch.fixed.sum()
    arrivals = 0
    while tick < longest and arrivals < bound:
        now = begin + tick * step
        swapped = _hear(orders, dispatch, drive, trouble, grants, heard, tick, now)
        if swap_every > 0 and tick % swap_every == 0:
            swapped += swap_orders(courses, alone, orders, dispatch, now)
        if swapped > 0:
            happened, events = _note_swaps(seen, dispatch, now, happened, events)
        _grant(orders, dispatch, drive, rides, trouble, grants, heard, tick, now)
        stretches, rows = _drive_tick(
            drive, courses, rides, trouble, grants, now, step, stretches, rows
        )
        happened, events = _note_waits(
            orders, dispatch, drive, grants, waits, now + step, happened, events
        )
        arrivals = 0
        for robot in range(count):
            if drive.arrived[robot] < np.inf:
                arrivals += 1
        tick += 1
    return FleetTicks(
        stretches[:rows].copy(), happened[:events].copy(), drive.arrived, drive.place, now + step
    )
