"""The law over all legs: first the earliest arrival of each, then every arrival that may pay.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.yielding.course import Course
from viaspline.trajectory.yielding.law_knots import LawKnots
from viaspline.trajectory.yielding.leg_arrivals import LatticeSearch, LegArrival
from viaspline.trajectory.yielding.leg_lattice import DrivenLeg, Dynamics
from viaspline.trajectory.yielding.road import Road
from viaspline.trajectory.yielding.traffic import Traffic

STEPS_S = (0.1, 0.2, 0.4, 0.8, 1.6)
"""Steps of the lattice: the shortest with which it is no larger than ``LATTICE_WORDS``."""
LATTICE_WORDS = 8_000_000
HALVINGS = 1
"""How often the step is halved where nothing was found."""
SPARE_S, SPARE_SHARE = 60.0, 3.0
"""A leg may take so much longer than where nothing moves, and so many times as long, at first."""
LONGER = 4.0
"""By how much more it may take then."""
MOST = 64
"""So many times for which a station is free are told apart."""


@dataclass(frozen=True, eq=False)
class LegsSearch:
    """A search for a law over all legs.

    Attributes:
        course: What is driven.
        search: What all legs have in common.
        rests: Where legs end [m].
        traffic: What moves; it leaves the end free for the stay there as well.
    """

    course: Course
    search: LatticeSearch
    rests: tuple[float, ...]
    traffic: Traffic

    @classmethod
    def of(cls, course: Course, road: Road, traffic: Traffic) -> LegsSearch:
        """The search on a course."""
        line, caps, rests = course.stretches()
        limits = course.limits
        top = min(course.stage.top, float(course.static.speeds.max()))
        search = LatticeSearch(
            road, traffic, Dynamics(limits.max_accel, limits.brake, top), line, caps,
            _across(limits, road, top),
        )  # fmt: skip
        return cls(course, search, tuple(rests.tolist()), traffic)

    def first_step(self) -> float:
        """The first step to try [s]."""
        dynamics, drive = self.search.dynamics, self.course.static
        length = self.course.stage.end - self.course.stage.start
        for step in STEPS_S:
            places = length / (0.5 * min(dynamics.accel, dynamics.brake) * step * step)
            levels = dynamics.top / (min(dynamics.accel, dynamics.brake) * step)
            if 0.05 * places * levels * drive.duration / step <= LATTICE_WORDS:
                break
        return step

    def law(
        self, budget: WorkBudget, halvings: int = HALVINGS,
        is_proven: Callable[[], bool] = lambda: False,
    ) -> tuple[LawKnots | None, bool]:  # fmt: skip
        """The knots of a law, and whether nothing is left of any lattice that was tried.

        Args:
            budget: What may be spent.
            halvings: How often the step is halved where nothing was found.
            is_proven: Asked before that, whether there is no law.
        """
        onset = self.course.onset()
        step, is_closed = self.first_step(), True
        for k in range(1 + halvings):
            if k > 0 and is_proven():
                return None, True
            knots, closed = self._on_steps(onset, step, budget)
            if knots is not None:
                return onset.followed_by(knots), closed
            is_closed = is_closed and closed
            step *= 0.5
        return None, is_closed

    def _on_steps(
        self, onset: LawKnots, step: float, budget: WorkBudget
    ) -> tuple[LawKnots | None, bool]:
        share, spare = SPARE_SHARE, SPARE_S
        closed = False
        while not closed and budget.spent < budget.limit:
            latest = self._latest(share, spare)
            knots, closed = self._chained(onset, step, latest, 1, budget)
            if len(self.rests) > 1 and (knots is not None or not closed):
                if knots is not None:
                    late = float(knots.times[-1]) - self.course.reaches(self.rests[-1])
                    latest = tuple(self.course.reaches(s) + late for s in self.rests)
                better, closed = self._chained(onset, step, latest, MOST, budget)
                if better is not None and (
                    knots is None or better.times[-1] < knots.times[-1] - 1e-9
                ):
                    knots = better
            if knots is not None:
                return knots, closed
            share, spare = LONGER * share, LONGER * spare
            if share > LONGER**2 * SPARE_SHARE:
                break
        return None, closed

    def _latest(self, share: float, spare: float) -> tuple[float, ...]:
        """Until when each rest is reached [s]."""
        begin = self.course.static.start_time
        return tuple(
            begin + share * (self.course.reaches(rest) - begin) + spare for rest in self.rests
        )

    def _chained(
        self, onset: LawKnots, step: float, latest: tuple[float, ...], most: int,
        budget: WorkBudget,
    ) -> tuple[LawKnots | None, bool]:  # fmt: skip
        """A law leg by leg, with so many arrivals of each at most."""
        chain, is_closed = self._chain(onset, step, latest, most, 1, budget)
        if len(chain) < len(self.rests):
            return None, is_closed
        knots, index = chain[-1][0].knots, chain[-1][0].begin
        for arrivals in reversed(chain[:-1]):
            knots, index = arrivals[index].knots.followed_by(knots), arrivals[index].begin
        return knots, is_closed

    def arrivals(self, budget: WorkBudget) -> tuple[float, ...]:
        """For each time for which the end is free, the earliest arrival in it [s]."""
        latest = self._latest(SPARE_SHARE, SPARE_S)
        chain, _ = self._chain(self.course.onset(), self.first_step(), latest, MOST, MOST, budget)
        whole = len(chain) == len(self.rests)
        return tuple(arrival.time for arrival in chain[-1]) if whole else ()

    def _chain(
        self, onset: LawKnots, step: float, latest: tuple[float, ...], most: int, at_end: int,
        budget: WorkBudget,
    ) -> tuple[list[tuple[LegArrival, ...]], bool]:  # fmt: skip
        """The arrivals of each leg, as far as there are any, so many of each at most."""
        begins, place = [float(onset.times[-1])], float(onset.places[-1])
        speed = float(onset.speeds[-1])
        chain: list[tuple[LegArrival, ...]] = []
        is_closed = True
        for i, (rest, until) in enumerate(zip(self.rests, latest, strict=True)):
            last = i == len(self.rests) - 1
            stay = self.traffic.hold if last else self.course.dwell(rest)
            leg = DrivenLeg(place, rest, stay, begins[0], speed)
            ways = self.search.ways(leg, begins, step, until, at_end if last else most, budget)
            is_closed = is_closed and ways.is_closed
            if not ways.arrivals:
                break
            chain.append(ways.arrivals)
            begins, place, speed = [way.time + stay for way in ways.arrivals], rest, 0.0
        return chain, is_closed


def _across(limits: Limits, road: Road, top: float) -> float:
    """The largest acceleration across the path [m/s²], infinite at a corner without limits.

    It is the limit where there is one: how much the path bends takes longer to find than that is
    worth.
    """
    found = np.inf
    if limits.max_lateral_accel is not None:
        found = limits.max_lateral_accel
    if limits.max_yaw_rate is not None:
        found = min(found, limits.max_yaw_rate * top)
    if found < np.inf or math.isinf(road.bend):
        return found
    return road.bend * top * top
