"""Ways through a row of places: as they are asked for, or led by narrow places between them."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.turning.hybrid_astar.from_behind import (
    thoroughly_from_behind,
    through_from_behind,
)
from viaspline.planning.turning.hybrid_astar.narrow_places import Passage
from viaspline.planning.turning.hybrid_astar.pose_search import (
    SEARCH_EFFORTS,
    Effort,
    PoseProblem,
    first_looks,
    pose_problems,
)
from viaspline.planning.turning.hybrid_astar.row_layers import RowLeg, through
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Chain,
    Goal,
    NotFound,
    Pose,
    Reason,
)
from viaspline.world.world import World

SHARPER = 0.95  # so many times as wide are turns with which a proof is doubted
Lead = Callable[[Sequence[Passage]], Sequence[Passage]]  # those of a leg that it is led by
Found = tuple[tuple[Chain, ...] | NotFound, bool]
Search = Callable[[Sequence[RowLeg], Sequence[Pose], WorkBudget, tuple[Hashable, ...]], Found]


def find_row(
    world: World,
    requirements: Requirements,
    rho: float,
    ramp: float,
    starts: Sequence[Pose],
    goals: Sequence[Goal],
    budget: WorkBudget,
    efforts: Sequence[Effort] = SEARCH_EFFORTS,
    barriers: Sequence[Floats] = (),
) -> tuple[Chain, ...] | NotFound:
    """Ways from a pose through a row of places, forwards, with continuous curvature.

    Args:
        world: What to keep clear of.
        requirements: The body and what it keeps.
        rho: The least radius [m].
        ramp: Length on which the curvature rises from 0 to 1 / rho [m]; less, but not below
            ``LEAST_SEARCH_RAMP``, where an effort says so.
        starts: Where the first may begin: poses at one place.
        goals: Where they end.
        budget: What may be spent on poses; once it is, the search gives up.
        efforts: How finely and how long is looked, one after the other.
        barriers: For the way to each goal, segments that it must not cross [m], each (b, 4); none
            at all if it is empty.

    Returns:
        A chain for every goal, whose discs (see ``disc_cover``) are clear, each beginning with the
        pose in which the one before ends; or why there are none. From every place only the
        shortest arrivals with different headings are followed on; that there is no way is said
        only where those were all.
    """
    row = _Row(world, requirements, rho, ramp, tuple(starts), tuple(goals), budget, tuple(barriers))
    failed, expanded = [NotFound(Reason.BUDGET)] * len(efforts), 0
    ended: set[tuple[int, Search]] = set()  # with more room they come to the same
    for number, effort, lead, search in _attempts(efforts):
        if failed[number].reason.is_proof or (lead is None and (number, search) in ended):
            continue
        if search is not through and len(goals) == 1:
            continue
        found, seen = row.found(effort, lead, search)
        if not isinstance(found, NotFound):
            return found
        expanded += seen
        if lead is None:
            failed[number] = found
            ended |= set() if found.is_full else {(number, search)}
    return replace(row.doubted(failed[-1], efforts[-1]), expanded=expanded)


def _attempts(efforts: Sequence[Effort]) -> Iterator[tuple[int, Effort, Lead | None, Search]]:
    """The efforts by number, by which narrow places ways are led, and how: few states at first."""
    looks = first_looks(efforts)
    for each in enumerate(looks):
        yield from ((*each, lead, through) for lead in (None, _all_of_them, _the_narrowest))
    yield len(looks) - 1, looks[-1], None, through_from_behind
    yield from ((*each, None, through) for each in enumerate(efforts))
    yield len(efforts) - 1, efforts[-1], None, thoroughly_from_behind


def _all_of_them(narrow: Sequence[Passage]) -> Sequence[Passage]:
    """Leads ways by all narrow places."""
    return narrow


def _the_narrowest(narrow: Sequence[Passage]) -> Sequence[Passage]:
    """Leads ways by the narrowest place of each leg: round others there may be another way."""
    return [] if len(narrow) < 2 else [min(narrow, key=lambda passage: passage.width)]


@dataclass(frozen=True)
class _Row:
    """A row of places, see ``find_row``."""

    world: World
    requirements: Requirements
    rho: float
    ramp: float
    starts: tuple[Pose, ...]
    goals: tuple[Goal, ...]
    budget: WorkBudget
    barriers: tuple[Floats, ...]

    def found(
        self, effort: Effort, lead: Lead | None, search: Search
    ) -> tuple[tuple[Chain, ...] | NotFound, int]:
        """What there is with an effort in ever greater windows, and how many states were seen."""
        world, rho, ramp, starts = self.world, self.rho, self.ramp, self.starts
        lines = tuple(each.tobytes() for each in self.barriers)
        found: tuple[Chain, ...] | NotFound = NotFound(Reason.BUDGET)
        seen, is_full = 0, False
        problems = pose_problems(world, self.requirements, rho, ramp, self._places, effort)
        for window, problem in enumerate(problems):
            legs = self._legs(problem, lead)
            if not legs:
                continue
            goals = tuple(leg.goal for leg in legs)
            asked = (world, rho, ramp, starts, goals, effort, window, lines)
            found, is_cut = self.requirements.once(
                ("poses", search, *asked), partial(self._sought, search, legs, asked)
            )
            if not isinstance(found, NotFound):
                break
            seen += found.expanded
            is_full |= found.is_full
            found = replace(found, is_full=is_full)
            if not is_cut:
                break
        return found, seen

    def doubted(self, failed: NotFound, effort: Effort) -> NotFound:
        """What nothing was found for, but as a proof only if nothing is with sharper turns either.

        What a lattice leaves out of an exact way makes up for no more than these.
        """
        if not (failed.reason.is_proof and failed.reason.is_of_turns):
            return failed
        sharper, _ = replace(self, rho=SHARPER * self.rho).found(effort, None, through)
        if not isinstance(sharper, NotFound):
            return replace(failed, reason=Reason.CLOSE)
        return failed if sharper.reason.is_proof else replace(failed, reason=Reason.BUDGET)

    def _sought(self, search: Search, legs: list[RowLeg], asked: tuple[Hashable, ...]) -> Found:
        """The chains in one window; those that a plan with another tension has sought as well."""
        sought = partial(search, legs, self.starts, self.budget, asked)
        needs, shared = self.requirements, self.requirements.shared
        if shared is None:
            return sought()
        budgets = (self.budget,) if needs.budget is None else (self.budget, needs.budget)
        return shared.once((needs.without_tension, search, asked), budgets, sought)

    @property
    def _places(self) -> Floats:
        """(n, 2) [m]."""
        ends = [(goal.x, goal.y) for goal in self.goals]
        return np.array([(self.starts[0].x, self.starts[0].y), *ends])

    def _legs(self, problem: PoseProblem, lead: Lead | None) -> list[RowLeg]:
        """The legs, led by narrow places; none where there is no such place."""
        closed = [problem.closed_by(each) for each in self.barriers] or [problem] * len(self.goals)
        legs = []
        for number, (part, goal) in enumerate(zip(closed, self.goals, strict=True)):
            narrow = () if lead is None else lead(part.passages(self._places[number], goal))
            poses = [pose for passage in narrow for pose in (passage.enter, passage.leave)]
            goals = (*(Goal(pose.x, pose.y, (pose.heading,)) for pose in poses), goal)
            legs += [RowLeg(number, part, each) for each in goals]
        return legs if lead is None or len(legs) > len(self.goals) else []
