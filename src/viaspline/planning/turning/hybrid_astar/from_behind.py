"""Ways through a row whose headings are told from its end: those from which the rest can be driven.

Forwards, the shortest arrivals at a place are followed on, and none of them may lead to the next
place if that lies beside a wall. Backwards from the end the few headings that do are found, and how
little can be reached from a place that nothing leads on from is seen as soon.

Tested through ``planning/turning/hybrid_astar/test_pose_sequence``.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass, replace
from functools import partial

from viaspline.kernels.turning.hybrid_astar.expand_poses import EMPTY, FULL
from viaspline.planning.problem.work_budget import POSES_EFFORT_S, WorkBudget
from viaspline.planning.turning.hybrid_astar.pose_search import headings_at
from viaspline.planning.turning.hybrid_astar.row_layers import (
    PROOF_SECTORS,
    SHARE_AFTER_FIRST,
    RowLeg,
    through,
)
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Chain,
    Goal,
    NotFound,
    Pose,
    Reason,
)
from viaspline.planning.turning.hybrid_astar.search_tree import SearchTree

THOROUGH_SHARE = 10.0  # of states, that is looked at after the first arrival where all else failed


@dataclass(frozen=True)
class _Behind:
    """The headings at a place from which the next one can be come to.

    Attributes:
        headings: [rad].
        is_all: Whether all was seen that leads to the next place.
        expanded: How many states were looked at.
        is_full: Whether there was no room for more.
    """

    headings: tuple[float, ...]
    is_all: bool
    expanded: int
    is_full: bool


def through_from_behind(
    legs: Sequence[RowLeg], starts: Sequence[Pose], budget: WorkBudget, asked: tuple[Hashable, ...],
    after: float = SHARE_AFTER_FIRST,
) -> tuple[tuple[Chain, ...] | NotFound, bool]:  # fmt: skip
    """The chains in one window, as ``through`` has them, by headings told from the row's end.

    Args:
        legs: See ``through``, and the others.
        starts: Where the first may begin.
        budget: What may be spent on poses.
        asked: All that the searches depend on.
        after: How long is looked for more headings; see ``SearchTree``.
    """
    told, is_all, is_full, seen = [legs[-1]], True, False, 0
    for leg in reversed(legs[:-1]):
        following = told[0]
        step = (*asked, "behind", after, len(told))
        behind = _behind(following, leg.goal, budget, step, after)
        is_all &= behind.is_all
        is_full |= behind.is_full
        seen += behind.expanded
        if not behind.headings:
            is_cut = not leg.problem.search_window.area.is_whole
            reason = Reason.NO_WAY if is_all and not is_cut else Reason.BUDGET
            return NotFound(reason, following.number, seen, is_full), is_cut
        told.insert(0, replace(leg, goal=replace(leg.goal, headings=behind.headings)))
    found, is_cut = through(told, starts, budget, (*asked, "told from behind", after))
    if not isinstance(found, NotFound):
        return found, is_cut
    reason = found.reason if is_all or not found.reason.is_proof else Reason.BUDGET
    more = replace(found, expanded=found.expanded + seen, is_full=found.is_full or is_full)
    return replace(more, reason=reason), is_cut


def thoroughly_from_behind(
    legs: Sequence[RowLeg], starts: Sequence[Pose], budget: WorkBudget, asked: tuple[Hashable, ...]
) -> tuple[tuple[Chain, ...] | NotFound, bool]:
    """What ``through_from_behind`` comes to with many more headings."""
    return through_from_behind(legs, starts, budget, asked, THOROUGH_SHARE)


def _behind(
    leg: RowLeg, place: Goal, budget: WorkBudget, asked: tuple[Hashable, ...], after: float
) -> _Behind:
    """The headings at a place from which a leg can be driven.

    Args:
        leg: That begins there.
        place: Where, with the headings that are allowed there.
        budget: What may be spent on poses.
        asked: All that the search depends on.
        after: See ``SearchTree``.
    """
    problem, goal = leg.problem, leg.goal
    ends = headings_at(problem, goal, PROOF_SECTORS)
    begins = headings_at(problem, place, PROOF_SECTORS)
    if not len(ends) or not len(begins):
        return _Behind((), False, 0, False)
    to = replace(place, headings=tuple(begins.tolist()))
    tree = problem.requirements.taken_up(asked, partial(problem.backwards, to, goal, ends, after))
    while not tree.is_over and budget.affords(POSES_EFFORT_S * tree.effort):
        problem.go_on(tree)
    return _Behind(_headings_of(tree), tree.state == EMPTY, tree.expanded, tree.state == FULL)


def _headings_of(tree: SearchTree) -> tuple[float, ...]:
    """The headings with which a robot leaves a place that a search came to backwards [rad]."""
    return tuple(math.remainder(found.heading + math.pi, math.tau) for found in tree.arrivals())
