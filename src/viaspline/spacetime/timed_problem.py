"""What is asked of a path with a time law among moving obstacles.

Tested through ``spacetime/test_plan_among``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property

from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import (
    JERK_KNOT_S,
    STATE_MOVING_S,
    STATE_S,
    TIME_LAW_S,
    WorkBudget,
)
from viaspline.spacetime.world_squares import WorldSquares
from viaspline.trajectory.coupled import is_coupled
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

SQUARES = 2_500
"""About so many squares tell whether a thing closes the way."""
AMONG_S, BETTER_S = 4.0, 2.0
"""What may be spent on paths and laws past what moves; and once there is a law, no more are tried
when so much was spent [s of the reference machine]."""
SLOWER = (0.75, 0.55, 0.4, 0.3, 0.2)
"""Of the largest speed: what robots are tried with that can't slow down for a while alone."""
ONE_OF_MORE = 0.5
"""The share of what is left that one of several searches past what moves may spend."""


@dataclass(frozen=True)
class TimedProblem:
    """A mission among what moves.

    Attributes:
        mission: What is asked for.
        world: What stands.
        moving: What moves.
        requirements: Of every path.
        limits: Of every law.
        stops: The stops of a path.
        budget: What all paths and laws that are tried may spend together.
        better: Once there is a law, no more are tried when so much was spent [s].
        outer: What several problems may spend together, on what is searched as well: in places and
            times at once, which has a limit of its own else; None where that isn't said.
    """

    mission: Mission
    world: World
    moving: MovingObstacles
    requirements: Requirements
    limits: Limits
    stops: Callable[[Path], Sequence[Station]]
    budget: WorkBudget = field(default_factory=lambda: WorkBudget(AMONG_S))
    better: float = field(default_factory=lambda: BETTER_S)
    outer: WorkBudget | None = None

    @contextmanager
    def within(self, outer: WorkBudget) -> Iterator[TimedProblem]:
        """The problem as one of several that draw on one budget: there may be others to come.

        Args:
            outer: What they may spend together. It takes half of what is left of that at most.
        """
        with outer.share(min(AMONG_S, ONE_OF_MORE * outer.left)) as budget:
            better = BETTER_S / AMONG_S * budget.limit
            yield replace(self, budget=budget, better=better, outer=outer)

    def affords_search(self, states: int) -> bool:
        """Whether there is enough left to search through so many states, at most."""
        return self.outer is None or self._search_s(states) <= self.outer.left

    def count_search(self, states: int) -> None:
        """Take off what a search through so many states has cost."""
        if self.outer is not None:
            self.outer.spent += self._search_s(states)

    def _search_s(self, states: int) -> float:
        return states * (STATE_S + STATE_MOVING_S * len(self.moving))

    @property
    def required(self) -> float:
        """Distance that a disc round the body's reference point keeps from what moves [m].

        A body that is no disc is taken for the one around it; its certificate knows better.
        """
        return self.requirements.around

    @property
    def lower_speeds(self) -> tuple[float, ...]:
        """Speeds at which a law is tried that waits at stops alone [m/s]; none for others."""
        waits_at_stops = self.limits.max_jerk is not None or is_coupled(self.limits, 2)
        return tuple(share * self.limits.max_speed for share in SLOWER if waits_at_stops)

    @property
    def least(self) -> float:
        """Distance that the reference point of any body keeps from what moves [m]."""
        return self.requirements.required

    @cached_property
    def squares(self) -> WorldSquares | None:
        """Where the robot may be beside what stands, roughly; None in a world without bounds."""
        return WorldSquares.over(self.world, SQUARES, self.least)

    def free_law(self, path: Path) -> Trajectory:
        """The law that would be driven along a path if nothing moved."""
        law = retime(
            path, self.limits, self.stops(path), zones=self.mission.world.speed_zones,
            start_time=self.mission.route.depart_s,
        )  # fmt: skip
        self.budget.spent += self.law_s(law)
        return law

    def law_s(self, law: Trajectory) -> float:
        """What it took to find a law [s of the reference machine]."""
        is_plain = self.limits.max_jerk is None
        return TIME_LAW_S if is_plain else JERK_KNOT_S * law.times.size

    def cost(self, path: Path, law: Trajectory) -> float:
        """What a path with a law costs, in what the mission asks to have little of [m or s]."""
        if self.mission.route.optimise == "length":
            return path.length
        return law.end_time


def without_lanes(requirements: Requirements) -> Requirements:
    """What paths keep that are led round what moves: where it isn't said, no lanes.

    What moves is gone soon; to swerve for it and back costs time.
    """
    if requirements.detours is not None:
        return requirements
    return replace(requirements, detours="short")
