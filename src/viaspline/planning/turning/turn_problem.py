"""The problem of turns that are nowhere sharper than a radius.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.bend_row import DETOUR, Bends
from viaspline.planning.turning.driven_problem import LOOP_RAD, DrivenProblem
from viaspline.planning.turning.headings import HeadingLeg, legs_of
from viaspline.planning.turning.laid_turns import through_turns
from viaspline.planning.turning.posed_legs import Poses
from viaspline.planning.turning.repair import Stuck, clear_turn_path_or_why
from viaspline.planning.turning.turn_path import TurnPath
from viaspline.world.world import World

LayTurns = Callable[[Bends, World, Requirements], TurnPath | None]


@dataclass(frozen=True)
class TurnProblem:
    """A path that is asked for, with turns that are nowhere sharper than a radius.

    Attributes:
        path: What is to be driven.
        rho: The least radius [m].
        spots: The via points at which the robot may turn on the spot instead.
        row: What the turns go round; None: what the shortest taut paths do.
    """

    path: DrivenProblem
    rho: float
    spots: Collection[int]
    row: Bends | None = None

    @property
    def vias(self) -> range:
        """All of its via points."""
        return range(len(self.path.sequence.vias))

    @property
    def bends(self) -> Bends:
        """What its turns go round, with their radius."""
        row = self.path.bends if self.row is None else self.row
        return row.turning(self.rho)

    @cached_property
    def tight_vias(self) -> frozenset[int]:
        """The via points about which turns have no room as they come to be, or make loops."""
        laid = clear_turn_path_or_why(self.bends, self.path.world, self.path.requirements)
        if isinstance(laid, Stuck):
            return laid.vias(self.path.requirements) & self.free_vias
        loops = np.flatnonzero(np.abs(laid.turns) > LOOP_RAD).tolist()
        return frozenset().union(*map(laid.bends.vias_of, loops)) & self.free_vias

    @property
    def free_vias(self) -> frozenset[int]:
        """The via points whose headings are to be chosen: no ends, and where it doesn't turn."""
        ends = set() if self.path.sequence.closed else {0, self.vias[-1]}
        return frozenset(self.vias) - ends - set(self.spots)

    def heading_legs(self, sought: Collection[int], count: int) -> tuple[HeadingLeg, ...]:
        """Its legs with so many headings at the ends of each that are via points to be sought at.

        Args:
            sought: The via points.
            count: How many.
        """
        return legs_of(self.bends, self.spots, sought, count, self.path.walls)

    def on_sides(self, lay: LayTurns) -> Callable[[Bends], TurnPath | None]:
        """Lays turns round bends from via point to via point, if they keep to the asked sides.

        Args:
            lay: Lays a clear turn path round bends, if it can.
        """
        return partial(self._laid_on_sides, lay)

    def without_blocked_spots(self, laid: SplinePath) -> TurnProblem | None:
        """It without the spots at which the body has no room to turn as a path does; None: it has.

        Args:
            laid: The path, whose legs are clear each by itself.
        """
        if self.path.requirements.footprint is None:
            return None
        count, begins = len(laid.spans), laid.joints
        inner = [k for k in self.spots if self.path.sequence.closed or 0 < begins[k] < count]
        about = {k: laid.spans[[begins[k] - 1, begins[k]], :, :2] for k in inner}
        blocked = {k for k, spans in about.items() if not self.path.is_clear(spans)}
        return replace(self, spots=frozenset(self.spots) - blocked) if blocked else None

    def laid(self, poses: Poses) -> SplinePath:
        """The path of turns between headings, or of a good driver's where those are sooner.

        These are wider where they have room, and at rests as sharp as the robot itself.

        Args:
            poses: The headings, and turns between them.
        """
        path = self.path
        narrow = through_turns(path.sequence, poses.turn_paths)
        if not path.requirements.objective.is_time:
            return narrow
        widened = [self._widened(turn_path) or turn_path for turn_path in poses.turn_paths]
        return min(narrow, through_turns(path.sequence, widened), key=path.price)

    def _widened(self, turn_path: TurnPath) -> TurnPath | None:
        """Turns between the same headings as a good driver makes them; None if there is no room."""
        bends = turn_path.bends
        first, last = (self.path.sequence.stands(via) for via in bends.vias[[0, -1]].tolist())

        def lay(bends: Bends, _: World, __: Requirements) -> TurnPath | None:
            return self.path.turns_round(bends, self.rho, (first, last))

        return self._laid_on_sides(lay, bends)

    def _laid_on_sides(self, lay: LayTurns, bends: Bends) -> TurnPath | None:
        turn_path = lay(bends, self.path.world, self.path.requirements)
        if turn_path is None:
            return None
        at_vias = np.flatnonzero(turn_path.bends.vias != DETOUR)
        legs = np.split(turn_path.spans, turn_path.begins[at_vias[1:-1]])
        sides = [self.path.sides[leg] for leg in turn_path.bends.vias[at_vias[:-1]].tolist()]
        if any(its.crossed(leg).any() for its, leg in zip(sides, legs, strict=True)):
            return None
        return turn_path
