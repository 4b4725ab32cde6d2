"""A proven path with a proven time law past what moves, the one that arrives first."""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.errors import GaveUpError, NoPathError
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.problem.method import Found, GaveUp, Outcome
from viaspline.spacetime.alternatives import (
    Alternative,
    alternatives_elsewhere,
    alternatives_to,
    meeting_of,
)
from viaspline.spacetime.cut_off import is_cut_off
from viaspline.spacetime.hopeless import check_start
from viaspline.spacetime.law_on_path import (
    WORTH_S,
    departure_that_serves,
    law_on_path,
    moving_proof,
)
from viaspline.spacetime.searched_paths import is_searchable, searched_paths
from viaspline.spacetime.taken_points import check_points
from viaspline.spacetime.timed_drive import TimedCandidate, TimedDrive
from viaspline.spacetime.timed_problem import TimedProblem
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.waits import TrafficWait, waits

MAX_PATHS = 48
"""Paths that are timed at most."""

SAME_M = 1e-3
"""Paths that differ by less are one [m]: led round what is met ever anew, they draw together."""

ENOUGH_SEARCHED = 2
"""After so many drives that were searched it is enough."""


def plan_among(problem: TimedProblem, static: Solution) -> TimedDrive:
    """The path and the law that arrive first among what was tried.

    The path among what stands comes first. Each path is timed: the robot slows and waits where
    that is better. Then it is led round what it would meet if it didn't, as if that stood where it
    is by then, on either side; and so on, always the path with the earliest arrival it could have,
    until what may be spent is spent. Where none of them has a law, or the best one loses time,
    places and times are searched at once.
    With ``optimise: length`` it is the shortest path that can be timed.

    Args:
        problem: What is asked.
        static: The path among what stands.

    Raises:
        NoPathError: When the robot is run over whatever it does, or something stays on the goal.
        GaveUpError: When no path that was tried has a law, or none was found.
    """
    check_start(problem)
    check_points(problem)
    first = Alternative(static, problem.free_law(static.path))
    tried = _Tried().and_then(problem, first, law_on_path(problem, first))
    if tried.best is None and is_cut_off(problem):
        raise _cut_off(problem, tried.outcomes, static)
    if tried.is_late(first):
        tried = _searched(problem, tried)
    tried = _beside(problem, first, tried)
    best = tried.best
    if best is None:
        raise _given_up(problem, tried.outcomes, static)
    chosen = (best.solution.path.length, best.trajectory.end_time)
    marked = tuple(
        replace(one, chosen=(one.length, one.arrival) == chosen) for one in tried.candidates
    )
    return replace(best, candidates=marked, waits=_waits(problem, best))


@dataclass(frozen=True)
class _Tried:
    """Paths that were timed, in the order in which they were.

    Attributes:
        outcomes: What came of each,
        candidates: and in what is told of it.
        best: The best of them that is proven.
    """

    outcomes: tuple[Outcome[Trajectory], ...] = ()
    candidates: tuple[TimedCandidate, ...] = ()
    best: TimedDrive | None = None

    def is_late(self, first: Alternative) -> bool:
        """Whether nothing was found that loses little."""
        late = first.free.end_time + WORTH_S
        return self.best is None or self.best.trajectory.end_time > late

    def and_then(
        self, problem: TimedProblem, taken: Alternative, outcome: Outcome[Trajectory]
    ) -> _Tried:
        """These and one more."""
        best = self.best
        if isinstance(outcome, Found):
            best = _better(problem, best, taken, outcome.value)
        if best is not None:
            problem.budget.limit = min(problem.budget.limit, problem.better)
        return _Tried(
            (*self.outcomes, outcome), (*self.candidates, _candidate(taken, outcome)), best
        )


def _searched(problem: TimedProblem, tried: _Tried) -> _Tried:
    """What was timed, and drives that are searched with their times, until enough have a law."""
    found = 0
    for drive in searched_paths(problem):
        for taken in drive:
            outcome = law_on_path(problem, taken)
            tried = tried.and_then(problem, taken, outcome)
            if isinstance(outcome, Found):
                found += 1
                break
        if found == ENOUGH_SEARCHED:
            break
    return tried


def _beside(problem: TimedProblem, first: Alternative, tried: _Tried) -> _Tried:
    """What was timed, the path among what stands first, and paths led round what it meets.

    Where it is met comes first; where that is before or afterwards one path after the other, as
    long as nothing else is left that could be better.
    """
    ahead = _Ahead(problem, {_key(first)}, [])
    elsewhere = _elsewhere(problem, first, tried.outcomes[0])
    near = alternatives_to(problem, first)
    while len(tried.outcomes) < MAX_PATHS and not problem.budget.is_spent:
        for other in near:
            ahead.add(other)
        while not ahead.is_promising(tried.best):
            another = next(elsewhere, None)
            if another is None:
                return tried
            ahead.add(another)
        taken = ahead.pop()
        tried = tried.and_then(problem, taken, law_on_path(problem, taken))
        near = alternatives_to(problem, taken)
    return tried


@dataclass(frozen=True, eq=False)
class _Ahead:
    """Paths that are laid and not timed yet, the one with the earliest arrival it could have first.

    Attributes:
        problem: What is asked.
        seen: Keys of all that were laid.
        queue: With what each would cost if nothing moved.
    """

    problem: TimedProblem
    seen: set[bytes]
    queue: list[tuple[float, int, Alternative]]

    def add(self, other: Alternative) -> None:
        """Put in one more, unless it was laid before."""
        key = _key(other)
        if key not in self.seen and len(self.seen) <= 2 * MAX_PATHS:
            self.seen.add(key)
            cost = self.problem.cost(other.solution.path, other.free)
            heapq.heappush(self.queue, (cost, len(self.seen), other))

    def is_promising(self, best: TimedDrive | None) -> bool:
        """Whether the first of them may be better than the best that is proven."""
        if not self.queue or best is None:
            return bool(self.queue)
        return self.queue[0][0] < self.problem.cost(best.solution.path, best.trajectory)

    def pop(self) -> Alternative:
        """Take out the first."""
        return heapq.heappop(self.queue)[2]


def _key(laid: Alternative) -> bytes:
    """What is one for paths that count as one."""
    return np.round(laid.solution.path.spans / SAME_M).tobytes()


def _waits(problem: TimedProblem, best: TimedDrive) -> tuple[TrafficWait, ...]:
    """Where the robot loses time to what moves."""
    return waits(
        best.solution.path, best.trajectory, best.free, moving=problem.moving,
        required=problem.required, hold=problem.mission.route.hold_s,
    )  # fmt: skip


def _elsewhere(
    problem: TimedProblem, first: Alternative, outcome: Outcome[Trajectory]
) -> Iterator[Alternative]:
    """Paths that lead by bays to wait in, where waiting on the first one loses time."""
    late = first.free.end_time + WORTH_S
    if isinstance(outcome, Found) and outcome.value.end_time <= late:
        return iter(())
    return alternatives_elsewhere(problem, first)


def _better(
    problem: TimedProblem, best: TimedDrive | None, taken: Alternative, law: Trajectory
) -> TimedDrive | None:
    """The better of what was best and a path with its law, if that is proven."""
    path = taken.solution.path
    cost = problem.cost(path, law)
    if best is not None and problem.cost(best.solution.path, best.trajectory) <= cost:
        return best
    certificate = moving_proof(problem, path, law)
    if not certificate.holds:
        return best
    return TimedDrive(taken.solution, law, certificate, taken.free)


def _candidate(taken: Alternative, outcome: Outcome[Trajectory]) -> TimedCandidate:
    path = taken.solution.path
    if isinstance(outcome, Found):
        arrival = outcome.value.end_time
        return TimedCandidate(
            taken.passings, path.length, taken.free.end_time, arrival, is_searched=taken.is_searched
        )
    reason = outcome.reason
    return TimedCandidate(
        taken.passings, path.length, taken.free.end_time, None, reason,
        is_searched=taken.is_searched,
    )  # fmt: skip


def _given_up(
    problem: TimedProblem, outcomes: Sequence[Outcome[Trajectory]], static: Solution
) -> GaveUpError:
    """The error of a search that found no path with a law."""
    tried = [f"{len(outcomes)} paths, with waits and on either side of what is met"]
    if is_searchable(problem):
        tried.append("a search over places, speeds and times at once")
    if problem.budget.is_spent:
        tried.append(f"no more than {problem.budget.limit:g} s of work allow")
    tried += dict.fromkeys(outcome.reason for outcome in outcomes if not isinstance(outcome, Found))
    names, where = _met_first(problem, static)
    first = f", '{names[0]}' first" if names else ""
    return GaveUpError(
        f"no path was found on which the robot is clear of what moves{first}",
        where=where,
        remedy=departure_that_serves(problem, static.path) or _remedy(outcomes),
        tried=tried,
        obstacles=names,
    )


def _cut_off(
    problem: TimedProblem, outcomes: Sequence[Outcome[Trajectory]], static: Solution
) -> NoPathError:
    """The error that what moves cuts the robot off, whatever path it takes."""
    names, where = _met_first(problem, static)
    first = f", '{names[0]}' first" if names else ""
    return NoPathError(
        f"what moves cuts the robot off from its route, whatever path it takes{first}",
        where=where,
        remedy=_remedy(outcomes),
        obstacles=names,
    )


def _met_first(problem: TimedProblem, static: Solution) -> tuple[tuple[str, ...], list[float]]:
    """What the path among what stands meets first, if anything, and where [m]."""
    meeting = meeting_of(problem, static.path, problem.free_law(static.path))
    where = static.path.at_distance(0.0 if meeting is None else meeting.distance)
    names = () if meeting is None else (problem.moving.name(meeting.obstacle),)
    return names, np.asarray(where).tolist()


def _remedy(outcomes: Sequence[Outcome[Trajectory]]) -> str:
    """What would help by the words of the laws that weren't found."""
    helps = [outcome.would_help for outcome in outcomes if isinstance(outcome, GaveUp)]
    return next((words for words in helps if words), "depart at another time (route.depart_s)")
