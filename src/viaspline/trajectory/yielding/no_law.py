"""Why there is no law: a proof that holds for a robot without inertia too, and what would help."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from viaspline.kernels.motion.packed_motion import (
    BEGINS,
    PRESENT,
    SPEED_X,
    SPEED_Y,
    TURNING,
)
from viaspline.kernels.timing.yielding.reachable_places import (
    Reached,
    reachable_places,
    unmoved,
)
from viaspline.planning.problem.method import GaveUp, Refusal
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.trajectory.yielding.course import Course
from viaspline.trajectory.yielding.law_through_legs import LegsSearch
from viaspline.trajectory.yielding.leg_arrivals import PAUSE_WORDS, WORD_S
from viaspline.trajectory.yielding.traffic import Traffic

PLACES_M = 0.02
"""From place to place in the proof, if the path isn't long [m]."""
MAX_PLACES = 20_000
AHEAD = 4
"""How many places the robot goes on in a step of the proof."""
WATCHED_S, WATCHED_SHARE = 120.0, 3.0
"""For how long is looked at what moves, and how many times the static law [s]."""
MAX_WATCHED_S = 600.0
"""What moves for longer counts as moving for ever [s]."""
MOST_STEPS = 2_000_000
"""So many steps are gone at most: where a robot stays for days no proof is sought to their end."""

PROOF_S = 0.2
"""A proof may spend as much, whatever the search has left of its budget [s]."""
MAX_DELAY_S = 300.0
"""Later departures are tried up to this [s]."""
MAX_DEPARTURES = 8
ELSEWHERE = "via points that lead away from where that moves, or another depart_s"
"""What may help where it isn't known what does."""


@dataclass(frozen=True, eq=False)
class Unserved:
    """A search that found no law.

    Attributes:
        legs: The search.
        budget: What is left to spend.
    """

    legs: LegsSearch
    budget: WorkBudget

    @property
    def _course(self) -> Course:
        return self.legs.course

    @property
    def _traffic(self) -> Traffic:
        return self.legs.traffic

    def outcome(self) -> Refusal | GaveUp:
        """That there is none, if that can be proven; else that none was found."""
        reached, pitch, step = self._reached
        watched = self._course.static.start_time + reached.last_alive * step
        remedy = self._remedy()
        is_alive = self._is_alive
        if not self.is_proven:
            return GaveUp(
                ("waiting, slowing down and passing before on a lattice of times and speeds",),
                remedy or ELSEWHERE,
                reason="no law was found on this path among what moves",
            )
        first, last = (max(place, 0) for place in reached.ends)
        low = self._course.stage.start + first * pitch
        high = min(self._course.stage.start + last * pitch, self._course.stage.end)
        begin = max(watched, self._course.static.start_time)
        where = f"{low:.1f} m" if high - low < 0.1 else f"{low:.1f} to {high:.1f} m"
        middle = self.legs.search.road.at(high if is_alive else 0.5 * (low + high))
        _, index = self._traffic.moving.nearest(middle, begin + step)
        name = self._traffic.moving.name(int(index[0]))
        if is_alive:
            reason = (
                f"there is no law: from {where} along the path the robot gets no farther, for "
                f"'{name}' stays nearer than {self._traffic.required:g} m"
            )
        else:
            reason = (
                f"there is no law: wherever the robot could be at {begin:.1f} s, {where} along "
                f"the path, '{name}' comes nearer than {self._traffic.required:g} m"
            )
        return Refusal(f"{reason}; {remedy}" if remedy else reason)

    @property
    def is_proven(self) -> bool:
        """Whether there is no law for a robot without inertia either."""
        reached, _, step = self._reached
        is_cut = reached.step < self._steps(step) and reached.last_alive >= reached.step - 1
        goes_on = self._is_alive and self._still() == math.inf
        return not (is_cut or reached.can_arrive or goes_on)

    @property
    def _is_alive(self) -> bool:
        """Whether the robot may be somewhere as long as it is looked at what moves."""
        reached, _, step = self._reached
        return reached.last_alive >= self._steps(step) - 1

    def _steps(self, step: float) -> int:
        return math.ceil(self._watched() / step)

    def _watched(self) -> float:
        """For how long is looked at what moves [s]; to the end of all motion if there is one."""
        static = self._course.static
        still = self._still()
        to_the_end = 0.0 if still == math.inf else still - static.start_time
        return max(to_the_end, 0.0) + WATCHED_SHARE * static.duration + WATCHED_S

    def _still(self) -> float:
        """From when on nothing moves any more, so that no place becomes free [s]; inf: never."""
        motion = self._traffic.moving.packed
        last = motion.pieces[motion.first_piece[1:] - 1]
        moves = np.abs(last[:, [SPEED_X, SPEED_Y, TURNING]]).max(axis=1) > 0.0
        if (motion.rounds[:, 1] > 0.0).any() or (moves & (last[:, PRESENT] > 0.0)).any():
            return math.inf
        still = float(last[:, BEGINS].max())
        return still if still < self._course.static.start_time + MAX_WATCHED_S else math.inf

    @cached_property
    def _reached(self) -> tuple[Reached, float, float]:
        """How far a robot without inertia comes; the pitch [m] and the step [s] of that."""
        course, road = self._course, self.legs.search.road
        length, static = course.stage.end - course.stage.start, course.static
        pitch = max(PLACES_M, length / MAX_PLACES)
        count = max(math.ceil(length / pitch), 1)
        pitch = length / count
        step = AHEAD * pitch / float(static.speeds.max())
        times = static.start_time + step * np.arange(min(self._steps(step), MOST_STEPS))
        first = float(static.speeds[0])
        braking = np.minimum(times - times[0], first / course.limits.brake)
        behind = course.stage.start + (first - 0.5 * course.limits.brake * braking) * braking
        front, end = static.distance_at(times), np.array(road.at(course.stage.end))
        reached, limit = unmoved(count), int(max(self.budget.left, PROOF_S) / WORD_S)
        while reached.step < times.size and reached.work < limit:
            can_arrive, alive, walked, taken, work = reachable_places(
                self._traffic.moving.packed, self._traffic.required, road.optimistic, times[0],
                step, course.stage.start, pitch, count, AHEAD, behind, front, end,
                self._traffic.hold, reached, min(reached.work + PAUSE_WORDS, limit),
            )  # fmt: skip
            reached = Reached(can_arrive, alive, reached.places, walked, taken, work)
        self.budget.spent += reached.work * WORD_S
        return reached, pitch, step

    def _remedy(self) -> str:
        """The least change that would allow a law; empty if none is known."""
        stays = self._course.dwell(self._course.stage.end)
        if self._traffic.hold > stays:
            freed = self._longest_stay() - stays
            if freed > 0.0:
                return f"hold {math.floor(10.0 * freed) / 10.0:g} s at most"
        if self._course.static.speeds[0] > 0.0:
            return ""
        delay = self._least_delay()
        return "" if delay is None else f"depart {math.ceil(10.0 * delay) / 10.0:g} s later"

    def _longest_stay(self) -> float:
        """For how long the end stays free after the arrival for which that is longest [s]."""
        traffic = replace(self._traffic, hold=0.0)
        legs = replace(
            self.legs, traffic=traffic, search=replace(self.legs.search, traffic=traffic)
        )
        road, end, watched = self.legs.search.road, self._course.stage.end, self._watched()
        return max(
            (
                min(traffic.free_until(road, end, time, time + watched) - time, watched)
                for time in legs.arrivals(self.budget)
            ),
            default=0.0,
        )

    def _least_delay(self) -> float | None:
        """By how much later there is a law [s].

        A robot that stands where nothing comes can as well begin later by waiting; so it is enough
        to begin where the start becomes free.
        """
        road, start = self.legs.search.road, self._course.stage.start
        begin = self._course.static.start_time
        time = begin
        for _ in range(MAX_DEPARTURES):
            time = self._traffic.free_until(road, start, time, begin + MAX_DELAY_S)
            time = self._traffic.free_again(road, start, time, begin + MAX_DELAY_S)
            if time >= begin + MAX_DELAY_S or self.budget.is_spent:
                return None
            later = replace(self._course, static=self._course.static.delayed(time - begin))
            if replace(self.legs, course=later).law(self.budget)[0] is not None:
                return time - begin
        return None
