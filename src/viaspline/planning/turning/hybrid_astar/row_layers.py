"""Ways leg by leg through a row: the best heading at one place may bar the way to the next.

Tested through ``planning/turning/hybrid_astar/test_pose_sequence``.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import groupby

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.hybrid_astar.expand_poses import EMPTY, FULL
from viaspline.planning.problem.work_budget import POSES_EFFORT_S, WorkBudget
from viaspline.planning.turning.hybrid_astar.pose_search import (
    HEADING_SECTORS,
    PoseProblem,
    finished,
    headings_at,
    turn_of,
)
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Chain,
    Goal,
    NotFound,
    Pose,
    Reason,
)
from viaspline.planning.turning.hybrid_astar.search_tree import SearchTree

MAX_ARRIVALS = 6  # that are followed on from every place, of different headings
SHARE_AFTER_FIRST = 1.0  # of states, that is looked at after the first arrival; see ``SearchTree``
DOUBT_STATES = 1000  # after which it is looked at whether the goal can be come to at all
PROOF_SECTORS = 72  # headings that nothing may come with, for a place to be out of reach
THINNED = 3  # of these, where a body stands with none of the usual ones, one in so many is tried
SAME_HEADING_RAD = math.pi / HEADING_SECTORS  # nearer to each other than this, two are one


@dataclass(frozen=True)
class RowLeg:
    """What is asked between two places of a row.

    Attributes:
        number: Which of them it is.
        problem: What is asked.
        goal: Where it ends, or a pose that it is led through.
    """

    number: int
    problem: PoseProblem
    goal: Goal


@dataclass(frozen=True)
class _Arrival:
    """A pose at a place, and how it was come to.

    Attributes:
        pose: x, y, heading and length so far, (4,).
        before: Number of the arrival at the place before.
        segments: From there, (n, 3).
    """

    pose: Floats
    before: int
    segments: Floats


def through(
    legs: Sequence[RowLeg], starts: Sequence[Pose], budget: WorkBudget, asked: tuple[Hashable, ...]
) -> tuple[tuple[Chain, ...] | NotFound, bool]:
    """The chains in one window, or why there are none and whether a greater one may have some.

    It may as well where there is no room for more states: what a window shows the mere edge of is
    sought in vain in it, and found at once in a greater one.

    Args:
        legs: As they follow each other; those of one number come to be one chain.
        starts: Where the first may begin: poses at one place.
        budget: What may be spent on poses.
        asked: All that the searches depend on.
    """
    has_room = legs[0].problem.search_window.has_room
    roomy = [pose for pose in starts if has_room(pose.x, pose.y, pose.heading)]
    if not roomy:
        return NotFound(Reason.START_TAKEN), False
    if _is_shut_in(legs[-1].problem, roomy[0], legs[-1].goal, budget):
        return NotFound(Reason.GOAL_SHUT_IN, legs[-1].number), False
    begins = [np.array([pose.x, pose.y, pose.heading, 0.0]) for pose in roomy]
    layers = [[_Arrival(begin, -1, np.empty((0, 3))) for begin in begins]]
    expanded, has_followed_all, is_full = 0, True, False
    for step, leg in enumerate(legs):
        number, problem, goal = leg.number, leg.problem, leg.goal
        headings = headings_at(problem, goal)
        if not len(headings):
            headings = headings_at(problem, goal, PROOF_SECTORS)[::THINNED]
        if not len(headings):
            return NotFound(Reason.GOAL_TAKEN, number, expanded), False
        to = headings if goal.headings else np.append(headings, math.nan)
        begin = np.array([arrival.pose for arrival in layers[-1]])
        tree = problem.requirements.taken_up(
            (*asked, step), partial(problem.forwards, begin, goal, to, SHARE_AFTER_FIRST)
        )
        is_shut_in, seen = _grown(problem, tree, layers[-1][0].pose, goal, budget, (*asked, step))
        expanded += seen
        is_full |= tree.state == FULL
        if is_shut_in:
            return NotFound(Reason.GOAL_SHUT_IN, number, expanded), False
        arrivals = []
        for found in tree.arrivals():
            before = layers[-1][found.start].pose[2]
            heading = before + turn_of(found.segments)
            pose = np.array([goal.x, goal.y, heading, found.cost])
            arrivals.append(_Arrival(pose, found.start, found.segments))
        is_cut = not problem.search_window.area.is_whole  # outside of it there may be a way round
        if not arrivals:
            reason = Reason.START_SHUT_IN if number == 0 else Reason.NO_WAY
            if tree.state != EMPTY or is_cut or not has_followed_all:
                reason = Reason.BUDGET
            return NotFound(reason, number, expanded, is_full), is_cut
        distinct = _distinct(arrivals)
        layers.append(distinct[:MAX_ARRIVALS])
        has_seen_all = tree.state == EMPTY and not is_cut
        has_followed_all &= has_seen_all and len(distinct) <= MAX_ARRIVALS
    return _chains(legs, roomy, layers, expanded, asked), False


def _is_shut_in(problem: PoseProblem, start: Pose, goal: Goal, budget: WorkBudget) -> bool:
    """Whether a place with given headings is seen at once to be out of reach from anywhere."""
    headings = headings_at(problem, goal)
    if not goal.headings or not len(headings) or not problem.search_window.area.is_whole:
        return False
    back = problem.backwards(Goal(start.x, start.y, (start.heading,)), goal, headings)
    if not budget.affords(POSES_EFFORT_S * back.effort):
        return False
    problem.go_on(back)
    return back.state == EMPTY


def _grown(
    problem: PoseProblem,
    tree: SearchTree,
    start: Floats,
    goal: Goal,
    budget: WorkBudget,
    asked: tuple[Hashable, ...],
) -> tuple[bool, int]:
    """Let a search grow to its end, and in doubt another one from its goal.

    It ends earlier when the budget is spent.

    Args:
        problem: Where.
        tree: The search.
        start: The pose from which it begins, and the cost so far.
        goal: Where it ends.
        budget: What may be spent on poses.
        asked: All that the searches depend on.

    Returns:
        Whether the goal can't be come to from anywhere, and how many states were looked at.
    """
    back: SearchTree | None = None
    while not tree.is_over and budget.affords(POSES_EFFORT_S * tree.effort):
        problem.go_on(tree)
        if tree.has_arrived or tree.expanded < DOUBT_STATES:
            continue
        if back is None:
            from_all = headings_at(problem, goal, PROOF_SECTORS)
            x, y, heading = start[:3].tolist()
            back = problem.requirements.taken_up(
                ("back", *asked),
                partial(problem.backwards, Goal(x, y, (heading,)), goal, from_all),
            )
        if not back.is_over:
            if not budget.affords(POSES_EFFORT_S * back.effort):
                break
            problem.go_on(back)
        if back.state == EMPTY and problem.search_window.area.is_whole:
            return True, tree.expanded + back.expanded
    return False, tree.expanded + (0 if back is None else back.expanded)


def _distinct(arrivals: Sequence[_Arrival]) -> list[_Arrival]:
    """The best arrivals whose headings differ."""
    kept: list[_Arrival] = []
    for arrival in arrivals:
        gaps = [math.remainder(arrival.pose[2] - other.pose[2], math.tau) for other in kept]
        if all(abs(gap) >= SAME_HEADING_RAD for gap in gaps):
            kept.append(arrival)
    return kept


def _chains(
    legs: Sequence[RowLeg], starts: Sequence[Pose], layers: Sequence[list[_Arrival]],
    expanded: int, asked: tuple[Hashable, ...],
) -> tuple[Chain, ...]:  # fmt: skip
    """The shortest row, a chain for each number of its legs."""
    row = [layers[-1][0]]
    for layer in layers[-2:0:-1]:
        row.insert(0, layer[row[0].before])
    start = starts[row[0].before]
    chains: list[Chain] = []
    steps = groupby(zip(legs, row, strict=True), key=lambda step: step[0].number)
    for number, parts in steps:
        *_, (leg, arrival) = some = list(parts)
        free = leg is legs[-1] and not leg.goal.headings
        heading = math.nan if free else float(arrival.pose[2])
        end = np.array([leg.goal.x, leg.goal.y, heading])
        segments = np.concatenate([each.segments for _, each in some])
        every = (*asked, number)
        chains.append(finished(leg.problem, start, end, segments, expanded, every))
        start = chains[-1].end
    return tuple(chains)
