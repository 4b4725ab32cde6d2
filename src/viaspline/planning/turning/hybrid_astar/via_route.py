"""A whole via sequence through tight space, by the search among poses.

Tested through ``planning/methods/test_hybrid_astar_search``.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.planning.turning.hybrid_astar.pose_search import SEARCH_EFFORTS, Effort
from viaspline.planning.turning.hybrid_astar.pose_sequence import find_row
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Chain,
    Goal,
    NotFound,
    Pose,
    Reason,
)
from viaspline.world.world import World

MAX_ROUND_STARTS = 8  # headings with which a round is begun where the first one is free
START_SECTORS = 72  # headings with which any other way is begun at once


def via_route_chains(
    sequence: ViaSequence,
    world: World,
    requirements: Requirements,
    rho: float,
    ramp: float,
    spots: Collection[int],
    budget: WorkBudget,
    efforts: Sequence[Effort] = SEARCH_EFFORTS,
    barriers: Sequence[Floats] = (),
) -> list[Chain] | NotFound:
    """A chain for every leg of a via sequence, or why there is none.

    Args:
        sequence: Its via points and the headings at its ends.
        world: What to keep clear of.
        requirements: The body and what it keeps.
        rho: The least radius [m].
        ramp: Length on which the curvature rises from 0 to 1 / rho [m].
        spots: Via points at which the robot may turn on the spot.
        budget: What may be spent on poses in all; once it is, the search gives up.
        efforts: How finely and how long is looked, one after the other.
        barriers: For each leg, segments that it must not cross [m], each (b, 4); none at all if
            it is empty.
    """
    count = len(sequence.vias)
    stops = [0, *(k for k in sorted(spots) if 0 < k < count - (not sequence.closed))]
    stops.append(count if sequence.closed else count - 1)
    chains: list[Chain] = []
    for first, last in pairwise(stops):
        part = _Part(
            sequence, world, requirements, rho, ramp, first, last, budget, efforts,
            barriers[first:last],
        )  # fmt: skip
        found = part.round_chains() if part.is_round else part.chains()
        if isinstance(found, NotFound):
            return NotFound(found.reason, first + found.goal, found.expanded)
        chains += found
    return chains


@dataclass(frozen=True)
class _Part:
    """What lies between two stops of a via sequence, ``first`` and ``last``."""

    sequence: ViaSequence
    world: World
    requirements: Requirements
    rho: float
    ramp: float
    first: int
    last: int
    budget: WorkBudget
    efforts: Sequence[Effort]
    barriers: Sequence[Floats]

    @property
    def is_round(self) -> bool:
        """Whether it ends with the heading with which it begins."""
        return self.sequence.closed and (self.first, self.last) == (0, len(self.sequence.vias))

    @property
    def places(self) -> list[Floats]:
        """The places it goes through [m], each (2,)."""
        vias = self.sequence.vias
        return [vias[k % len(vias)].at[:2] for k in range(self.first, self.last + 1)]

    @property
    def given(self) -> float | None:
        """The heading that is given at its start [rad]."""
        tangent = self.sequence.start_tangent if self.first == 0 else None
        return None if tangent is None else math.atan2(tangent[1], tangent[0])

    @property
    def straight(self) -> float:
        """The heading from its first place to the second [rad]."""
        places = self.places
        ahead = places[1] - places[0]
        return math.atan2(ahead[1], ahead[0])

    @property
    def end(self) -> tuple[float, ...]:
        """The heading that is given at its end [rad]."""
        sequence = self.sequence
        tangent = None if sequence.closed else sequence.end_tangent
        if tangent is None or self.last != len(sequence.vias) - 1:
            return ()
        return (math.atan2(tangent[1], tangent[0]),)

    def chains(self) -> list[Chain] | NotFound:
        """The chains of a part that may end with another heading than it begins with."""
        if self.given is not None:
            return self._from((self.given,), self.end)
        found = self._from((self.straight,), self.end)
        if not isinstance(found, NotFound) or found.reason.is_of_goal:
            return found
        return self._and_more(found, self._from(self._turned(START_SECTORS), self.end))

    def round_chains(self) -> list[Chain] | NotFound:
        """The chains of a whole round.

        That there is none is proven where there would be none either if it could end with any
        heading, or where it is for each of the headings with which it may begin.
        """
        if self.given is not None:
            return self._from((self.given,), (self.given,))
        failed = self._from((self.straight,), (self.straight,))
        if not isinstance(failed, NotFound):
            return failed
        opened = self._from(self._turned(START_SECTORS), ())
        if isinstance(opened, NotFound):
            return self._and_more(failed, opened)
        quick = (opened[0].start.heading, *self._turned(MAX_ROUND_STARTS)[1:])
        for number, heading in enumerate((*quick, *self._turned(START_SECTORS)[1:])):
            if number >= len(quick) and not failed.reason.is_proof:
                break  # the rest is only looked at for the proof
            found = self._from((heading,), (heading,))
            if not isinstance(found, NotFound):
                return found
            failed = _both_failed(failed, found)
        return failed

    def _and_more(self, failed: NotFound, found: list[Chain] | NotFound) -> list[Chain] | NotFound:
        """What was found after a failure; its poses count as well."""
        if not isinstance(found, NotFound):
            return found
        return replace(found, expanded=failed.expanded + found.expanded)

    def _turned(self, count: int) -> list[float]:
        """Headings all round, that to the next place first, then the nearest to it [rad]."""
        turns = sorted(range(-(count // 2), count - count // 2), key=abs)
        return [self.straight + k * math.tau / count for k in turns]

    def _from(self, headings: Sequence[float], end: tuple[float, ...]) -> list[Chain] | NotFound:
        """The chains that begin with one of some headings, and end with that which is given."""
        (x, y), *others = [(float(x), float(y)) for x, y in self.places]
        goals = [Goal(*place) for place in others]
        goals[-1] = replace(goals[-1], headings=end)
        starts = [Pose(x, y, heading) for heading in headings]
        found = find_row(
            self.world, self.requirements, self.rho, self.ramp, starts, goals, self.budget,
            self.efforts, self.barriers,
        )  # fmt: skip
        return found if isinstance(found, NotFound) else list(found)


def _both_failed(one: NotFound, other: NotFound) -> NotFound:
    """Why neither of two headings serves: what is told of the one that came farther.

    It is proven only if both are.
    """
    farther = other if other.goal > one.goal else one
    reason = farther.reason if one.reason.is_proof and other.reason.is_proof else Reason.BUDGET
    return NotFound(reason, farther.goal, one.expanded + other.expanded)
