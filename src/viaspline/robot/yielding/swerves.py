"""Paths by which a robot may swerve for what moves: laid at once through places beside its own.

Tested through ``robot/yielding/test_give_way``.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from viaspline.errors import PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.replanning.departure import rolling, standing
from viaspline.planning.replanning.swerve import Swerving, may_swerve
from viaspline.robot.replanning.path_candidate import PathCandidate, first_law, slowed, timed
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.run import Mode
from viaspline.robot.yielding.swerve_places import swerve_places
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles

SWERVES = 5
"""So many places are tried."""

SWERVE_WORK_S = 0.03
"""What may be spent on all of them [s of the reference machine]."""

NOWHERE = np.empty((0, 2))


@dataclass(frozen=True, eq=False)
class Swerves:
    """The paths by which a robot may swerve, each laid when it is first asked for.

    Attributes:
        context: The robot under way, with what moves, by which the places are chosen.
    """

    context: ReplanContext
    _laid: dict[int, Solution | None] = field(default_factory=dict, init=False)
    _fastest: dict[int, Trajectory | None] = field(default_factory=dict, init=False)

    @cached_property
    def places(self) -> Floats:
        """Through which they lead, the most promising first [m], (k, 2).

        None where the mission allows no such path.
        """
        return swerve_places(self.context, SWERVES) if self._swerving is not None else NOWHERE

    @cached_property
    def _swerving(self) -> Swerving | None:
        """How the robot leaves its path; None: it can't, or mustn't."""
        context = self.context
        path, world = context.schedule.path, context.knowledge.world
        if not context.vias_ahead or not may_swerve(path, world, context.requirements):
            return None
        stands = context.speed == 0.0
        leave, at = (standing, context.stop) if stands else (rolling, context.leaves[0])
        requirements = context.searching(SWERVE_WORK_S).requirements
        try:
            return Swerving.off(path, at, world, requirements, leave)
        except PlanningError:
            return None

    def path(self, number: int) -> Solution | None:
        """The path through one of the places; None if it isn't clear of what stands."""
        if number not in self._laid:
            self._laid[number] = self._through(number)
        return self._laid[number]

    def fastest(self, number: int) -> Trajectory | None:
        """The law of one of the paths if nothing moved; None: there is none, whatever moves.

        No law past what moves ends sooner; and where the robot is too fast for how the path
        begins, it is so for every law.
        """
        if number not in self._fastest:
            self._fastest[number] = self._alone(number)
        return self._fastest[number]

    def alone(self) -> Iterator[PathCandidate]:
        """Those that have a law if nothing moved, with that law."""
        for number in range(len(self.places)):
            path, candidate = self.path(number), None
            with suppress(PlanningError):
                law = self.fastest(number)
                if path is not None and law is not None:
                    candidate = slowed(self._unmoved, _mode(self.context), path, law)
            if candidate is not None:
                yield candidate

    @cached_property
    def _unmoved(self) -> ReplanContext:
        """The robot as if nothing moved."""
        known = replace(self.context.knowledge, moving=MovingObstacles())
        return replace(self.context, knowledge=known)

    def _alone(self, number: int) -> Trajectory | None:
        path = self.path(number)
        if path is None:
            return None
        return first_law(self._unmoved, _mode(self.context), path)

    def _through(self, number: int) -> Solution | None:
        if self._swerving is None:
            return None
        try:
            return self._swerving.through(self.places[number])
        except PlanningError:
            return None

    def __iter__(self) -> Iterator[Solution]:
        """Those that are clear of what stands, the most promising first."""
        paths = (self.path(number) for number in range(len(self.places)))
        return (path for path in paths if path is not None)

    def __bool__(self) -> bool:
        """Whether there is any."""
        return next(iter(self), None) is not None


def driven(context: ReplanContext, solution: Solution) -> PathCandidate | None:
    """A swerve with its law past what moves; None if it has none.

    Args:
        context: The robot under way.
        solution: The path.
    """
    try:
        return timed(context, _mode(context), solution)
    except PlanningError:
        return None


def _mode(context: ReplanContext) -> Mode:
    """How a robot goes over to a swerve."""
    return "from_rest" if context.speed == 0.0 else "planned"
