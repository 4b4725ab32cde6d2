"""Ways through tight space for robots with a turning circle: the last resort of a planner.

What is between places is searched for with poses, forwards from the start, and in doubt backwards
from the goal, to see whether it can be come to at all. What is found is shortened, and laid as
spans.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.hybrid_astar.pose_nodes import CELL_SHARE, Ahead
from viaspline.kernels.turning.hybrid_astar.primitives import MotionPrimitives, primitives_of
from viaspline.kernels.turning.segment_chain import chain_spans, merged
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import (
    FIELD_CELL_S,
    PASSAGES_S,
    POSES_EFFORT_S,
    TREE_S,
)
from viaspline.planning.turning.hybrid_astar.closed_gaps import closed_gaps
from viaspline.planning.turning.hybrid_astar.narrow_places import Passage, passages
from viaspline.planning.turning.hybrid_astar.search_outcome import (
    Chain,
    Goal,
    Pose,
)
from viaspline.planning.turning.hybrid_astar.search_tree import SearchTree
from viaspline.planning.turning.hybrid_astar.search_window import Body, SearchWindow, search_areas
from viaspline.planning.turning.hybrid_astar.shortcut_search import ShortcutSearch
from viaspline.world.world import World

SHARE_AFTER_ARRIVAL = 0.25  # of states, that is looked at then; see ``SearchTree``
HEADING_SECTORS = 16  # headings that are tried where any is allowed


@dataclass(frozen=True)
class Effort:
    """How finely and how long a search looks.

    Attributes:
        overhang: Of the discs that cover the body, as a share of its half width.
        ramps: Length of the ramps, as a share of what is asked for.
        steps: Lengths of moves where it is tight, and where there is ever more room, as shares
            of the turning circle's radius.
        room: States that are kept, at most.
        care: How near to the start and the goal longer moves take more room, and how much more,
            both in radii.
    """

    overhang: float
    ramps: float
    steps: tuple[float, ...]
    room: int
    care: tuple[float, float] = (0.0, 0.0)


SEARCH_EFFORTS = (
    Effort(0.05, 1.0, (1 / 3,), 60_000),
    Effort(0.05, 0.7, (1 / 6, 1 / 3), 60_000),
    Effort(0.025, 0.4, (1 / 12, 1 / 6, 1 / 3), 120_000, (1.5, 0.25)),
    Effort(0.025, 0.08, (1 / 12, 1 / 6, 1 / 3), 120_000, (1.5, 1.0)),
    Effort(0.025, 0.02, (1 / 12, 1 / 6, 1 / 3), 120_000, (1.5, 1.0)),
)
FIRST_LOOK = 0.1  # of its states, that each effort looks at before any of them looks at all
LEAST_SEARCH_RAMP = 0.02  # of the radius


@dataclass(frozen=True)
class PoseProblem:
    """What is asked for, in one window with one effort.

    Attributes:
        search_window: Where.
        moves: What the robot can do.
        room: States that are kept, at most.
        requirements: With what may be spent.
    """

    search_window: SearchWindow
    moves: MotionPrimitives
    room: int
    requirements: Requirements

    def closed_by(self, barriers: Floats) -> PoseProblem:
        """This problem with segments that the reference point must not cross [m], (b, 4)."""
        return replace(self, search_window=self.search_window.closed_by(barriers))

    def go_on(self, tree: SearchTree) -> None:
        """Let a search look at some more states, when what they cost has been taken off.

        Raises:
            SpentBudgetError: When less is left.
        """
        self.requirements.spend_on_part(POSES_EFFORT_S * tree.effort)
        tree.go_on()

    def forwards(self, starts: Floats, goal: Goal, headings: Floats, after: float) -> SearchTree:
        """A search from some poses (n, 4) to the goal, that goes on for a share ``after``.

        See ``SearchTree``.
        """
        place = np.array([goal.x, goal.y])
        self.requirements.spend(TREE_S)
        return SearchTree(
            self.search_window,
            self.search_window.cache,
            self.moves,
            self._ahead(place),
            starts,
            place,
            headings,
            self.room,
            after,
        )

    def backwards(
        self, start: Goal, goal: Goal, headings: Floats, after: float = SHARE_AFTER_ARRIVAL
    ) -> SearchTree:
        """A search from the goal to the start, as of a robot that drives backwards.

        Args:
            start: With the headings that it may be left with.
            goal: Where it begins.
            headings: That the robot may have there [rad], (h,).
            after: See ``SearchTree``.
        """
        starts = np.zeros((len(headings), 4))
        starts[:, 0], starts[:, 1], starts[:, 2] = goal.x, goal.y, headings + math.pi
        self.requirements.spend(TREE_S)
        place, back = np.array([start.x, start.y]), np.array(start.headings) + math.pi
        return SearchTree(
            self.search_window,
            self.search_window.cache_back,
            self.moves,
            self._ahead(place),
            starts,
            place,
            back,
            self.room,
            after,
        )

    def passages(self, start: Floats, goal: Goal) -> tuple[Passage, ...]:
        """The narrow places on the shortest way from a place (2,) to a goal."""
        window = self.search_window
        ahead = self._ahead(np.array([goal.x, goal.y]))
        body = (window.body.discs.tobytes(), window.barriers.tobytes())
        asked = (window.world, window.area, window.side, *body, *start.tolist(), goal.x, goal.y)

        def told() -> tuple[Passage, ...]:
            self.requirements.spend(PASSAGES_S)
            return passages(window, ahead, start)

        return self.requirements.once(("passages", *asked), told)

    def _ahead(self, place: Floats) -> Ahead:
        """How far it is to a place (2,) from everywhere: the same from wherever a search begins."""
        window = self.search_window
        asked = (window.world, window.area, window.side, window.barriers.tobytes(), *place.tolist())

        def told() -> Ahead:
            fields = 2 if len(window.walls) else 1
            self.requirements.spend(FIELD_CELL_S * fields * window.cells.size)
            return window.ahead(place[None])

        return self.requirements.once(("ahead", *asked), told)


def first_looks(efforts: Sequence[Effort]) -> tuple[Effort, ...]:
    """The efforts with few states each: where one sees no end, a finer one may find one at once."""
    return tuple(replace(each, room=math.ceil(FIRST_LOOK * each.room)) for each in efforts)


def prepare_body(requirements: Requirements) -> None:
    """Find the discs that cover a body before they are asked for under way: that takes long."""
    for effort in SEARCH_EFFORTS:
        Body.of(requirements, effort.overhang)


def pose_problems(
    world: World,
    requirements: Requirements,
    rho: float,
    ramp: float,
    places: Floats,
    effort: Effort,
) -> Iterator[PoseProblem]:
    """The problem in ever greater windows."""
    body = Body.of(requirements, effort.overhang)
    bent = max(effort.ramps * ramp, min(LEAST_SEARCH_RAMP * rho, ramp))
    steps = np.maximum(np.array(effort.steps) * rho, 0.5 * bent)
    for area in search_areas(world, body.reach, places, 3.0 * rho + body.reach):
        search_window = SearchWindow(
            world,
            area,
            body,
            rho,
            CELL_SHARE * float(steps[0]),
            (effort.care[0] * rho, effort.care[1] * rho),
        )
        yield PoseProblem(
            _with_narrow_gaps(search_window, requirements),
            primitives_of(rho, bent, steps, search_window.pace),
            effort.room,
            requirements,
        )


def _with_narrow_gaps(window: SearchWindow, requirements: Requirements) -> SearchWindow:
    """A window with the gaps that its lattice shows open and that are too narrow."""
    if not window.is_fine:
        return window
    inner, side = window.body.inner, window.side

    def told() -> Floats:
        return closed_gaps(window.world.near(window.area.box), inner, side)

    asked = ("narrow gaps", window.world, window.area, inner, side)
    return replace(window, narrow_gaps=requirements.once(asked, told))


def headings_at(problem: PoseProblem, goal: Goal, sectors: int = HEADING_SECTORS) -> Floats:
    """The headings with which the body may stand at a goal, of those that are tried.

    Args:
        problem: Where.
        goal: The place.
        sectors: How many are tried where any is allowed.
    """
    headings = np.array(goal.headings or np.arange(sectors) * (2.0 * math.pi / sectors))
    return headings[[problem.search_window.has_room(goal.x, goal.y, each) for each in headings]]


def turn_of(segments: Floats) -> float:
    """By how much a chain turns [rad]."""
    return 0.5 * float(((segments[:, 0] + segments[:, 1]) * segments[:, 2]).sum())


def finished(
    problem: PoseProblem, start: Pose, goal: Floats, segments: Floats, expanded: int,
    asked: tuple[Hashable, ...],
) -> Chain:  # fmt: skip
    """The chain of what was found, with shortcuts.

    Args:
        problem: Where.
        start: Where it begins.
        goal: x, y and heading; NaN where that is free, (3,).
        segments: What was found, (n, 3).
        expanded: How many states were looked at for it.
        asked: All that it depends on.

    Raises:
        SpentBudgetError: When less is left than the next shortcuts cost.
    """
    rho, ramp = problem.moves.sizes[:2].tolist()
    begin = np.array([start.x, start.y, start.heading])

    def set_out() -> ShortcutSearch:
        return ShortcutSearch(problem.search_window.cache, begin, goal, segments, rho, ramp)

    search = problem.requirements.taken_up(("shortcuts", *asked), set_out)
    while not search.is_over:
        problem.requirements.spend_on_part(POSES_EFFORT_S * search.effort)
        search.go_on()
    segments = merged(search.segments, rho)
    spans = chain_spans(begin, goal, segments)
    heading = start.heading + turn_of(segments) if math.isnan(goal[2]) else float(goal[2])
    end = Pose(float(goal[0]), float(goal[1]), heading)
    return Chain(segments, spans, search.length, start, end, expanded)
