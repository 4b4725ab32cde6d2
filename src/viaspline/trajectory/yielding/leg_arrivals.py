"""The ways over one leg: for each time for which its end is free, the earliest arrival in it.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.timing.yielding.blocked_places import Driving
from viaspline.kernels.timing.yielding.time_lattice import (
    TimeLattice,
    Tube,
    Visited,
    allowed_steps,
    earliest_arrivals,
    unvisited,
)
from viaspline.kernels.timing.yielding.way_back import way_back
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.trajectory.yielding.law_knots import LawKnots
from viaspline.trajectory.yielding.leg_lattice import DrivenLeg, Dynamics, on_lattice
from viaspline.trajectory.yielding.road import Road
from viaspline.trajectory.yielding.traffic import Traffic

WORD_S = 2e-9
"""What a word of places costs to look at [s]."""
PAUSE_WORDS = 50_000_000
"""After so many a walk comes up for breath: whoever interrupts it needn't wait for its end."""
MAX_WORDS = 40_000_000
"""How many words are kept at once."""


@dataclass(frozen=True, eq=False)
class LegArrival:
    """A way over a leg.

    Attributes:
        time: When it is over [s].
        begin: Which of the times at which it could begin it makes use of.
        knots: Its law, from that time on.
    """

    time: float
    begin: int
    knots: LawKnots


@dataclass(frozen=True, eq=False)
class Ways:
    """The ways over a leg that were found.

    Attributes:
        arrivals: In the order of time.
        is_closed: Whether all of the lattice was seen, and nothing is left that could go on.
    """

    arrivals: tuple[LegArrival, ...]
    is_closed: bool


@dataclass(frozen=True, eq=False)
class LatticeSearch:
    """What all legs have in common.

    Attributes:
        road: The path.
        traffic: What moves.
        dynamics: How the robot speeds up and slows down.
        line: Ends of the stretches with one largest speed each [m], (n + 1,).
        caps: These speeds [m/s], (n,).
        across: Largest acceleration across the path [m/s²]; infinite: not known.
    """

    road: Road
    traffic: Traffic
    dynamics: Dynamics
    line: Floats
    caps: Floats
    across: float

    def driving(self, lattice: TimeLattice) -> Driving:
        """What every law on a lattice keeps."""
        half = 0.5 * lattice.step
        hardest = max(self.dynamics.accel, self.dynamics.brake)
        across = min(self.across, 4.0 * self.dynamics.top / half)  # at a corner: any turn
        return Driving(self.traffic.required, self.dynamics.top, hardest, across, half)

    def ways(
        self, leg: DrivenLeg, begins: Sequence[float], step: float, until: float, most: int,
        budget: WorkBudget,
    ) -> Ways:  # fmt: skip
        """Ways over a leg that the robot begins at one of some times.

        Args:
            leg: What is driven.
            begins: Increasing [s]; one if it begins under way.
            step: As long as steps may be [s].
            until: What is later plays no part [s].
            most: So many are enough.
            budget: What may be spent.
        """
        rough = self.dynamics.lattice(leg, step)
        entry = _entry(leg, rough, self.dynamics)
        if entry.end + 2.0 * rough.pitch >= leg.end:  # it comes to rest as it brakes
            return Ways((), is_closed=True)
        lattice = on_lattice(rough, entry.end, leg.end, entry.time, entry.level)
        width = (lattice.last >> 6) + 1
        steps = math.floor((until - lattice.begin) / lattice.step)
        room = MAX_WORDS // (width * (lattice.levels + 1))
        steps, is_whole = min(steps, room), steps <= room
        if steps < 1:
            return Ways((), is_closed=is_whole)
        flags, origins = self._flags(leg, begins, entry, lattice, steps)
        tube = Tube(
            np.zeros(steps + 1, np.int64), np.zeros(steps + 1, np.int64),
            np.full(steps + 1, lattice.levels), width,
        )  # fmt: skip
        allowed = allowed_steps(lattice, self.line, self.caps)
        limit = int(budget.left / WORD_S)
        visited = unvisited(lattice, tube)
        while not visited.is_over:
            walked = earliest_arrivals(
                self.traffic.moving.packed, self.driving(lattice), self.road.tree, lattice, tube,
                allowed, flags, entry.level, np.array(self.road.at(leg.end)), float(leg.stay), most,
                limit, visited, visited.work + PAUSE_WORDS,
            )  # fmt: skip
            visited = Visited(visited.rows, visited.bands, visited.found, *walked)
        budget.spent = min(budget.limit, budget.spent + visited.work * WORD_S)
        found = []
        for arrival in visited.arrivals:
            first, levels = way_back(
                visited, lattice, tube, allowed, flags, entry.level, int(arrival)
            )
            knots = _knots(lattice, int(first), levels, leg.end)
            if entry.knots is not None:
                knots = entry.knots.followed_by(knots.since(1))
            index = origins.get(int(first), 0)
            if knots.times[0] > begins[index]:  # it stood until its first step
                knots = _standing(begins[index], leg.start).followed_by(knots)
            time = float(lattice.begin + arrival * lattice.step)
            found.append(LegArrival(time, index, knots))
        is_closed = visited.last_alive < visited.steps and visited.work <= limit
        return Ways(tuple(found), is_closed)

    def _flags(
        self,
        leg: DrivenLeg,
        begins: Sequence[float],
        entry: Entry,
        lattice: TimeLattice,
        steps: int,
    ) -> tuple[Flags, dict[int, int]]:  # fmt: skip
        """At which steps the leg can begin, and which of the times each is."""
        flags = np.zeros(steps + 1, np.bool_)
        origins: dict[int, int] = {}
        for i, time in enumerate(begins):
            n = 0
            if leg.speed == 0.0:
                n = math.ceil((time - lattice.begin) / lattice.step - 1e-9)
                at = lattice.begin + n * lattice.step
                if at > time and self.traffic.free_until(self.road, leg.start, time, at) < at:
                    continue
            if n <= steps and n not in origins:
                flags[n], origins[n] = True, i
        return flags, origins


@dataclass(frozen=True, eq=False)
class Entry:
    """How a robot that is under way gets onto the lattice.

    Attributes:
        level: With which speed it is there.
        end: Where, as a distance along the path [m].
        time: When [s].
        knots: Its law until then; None if it is there already.
    """

    level: int
    end: float
    time: float
    knots: LawKnots | None = None


def _entry(leg: DrivenLeg, lattice: TimeLattice, dynamics: Dynamics) -> Entry:
    """Braking to the next speed of the lattice."""
    if leg.speed == 0.0:
        return Entry(0, leg.start, leg.begin)
    quantum = 2.0 * lattice.pitch / lattice.step
    level = min(math.floor(leg.speed / quantum + 1e-9), lattice.levels)
    speed = level * quantum
    late = max(leg.speed - speed, 0.0) / dynamics.brake
    end = leg.start + 0.5 * (leg.speed + speed) * late
    knots = LawKnots(
        np.array([leg.begin, leg.begin + late]), np.array([leg.start, end]),
        np.array([leg.speed, speed]),
    )  # fmt: skip
    return Entry(level, end, leg.begin + late, knots if late > 0.0 else None)


def _standing(time: float, place: float) -> LawKnots:
    return LawKnots(np.array([time]), np.array([place]), np.zeros(1))


def _knots(lattice: TimeLattice, first: int, levels: Ints, end: float) -> LawKnots:
    """The law with some speeds, one a step from the first."""
    changes = np.diff(levels)
    is_knot = np.concatenate(([True], changes[1:] != changes[:-1], [True]))
    gone = np.concatenate(([0], np.cumsum(levels[1:] + levels[:-1])))
    at = np.flatnonzero(is_knot)
    places = lattice.origin + lattice.pitch * gone[at]
    places[-1] = end
    quantum = 2.0 * lattice.pitch / lattice.step
    times = np.array(lattice.begin + lattice.step * (first + at), np.float64)
    return LawKnots(times, places, np.array(quantum * levels[at], np.float64))
