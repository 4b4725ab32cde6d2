"""The problem of a path that a robot is to drive, and what its turns go along.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import tee

import numpy as np

from viaspline.curve.bending import curvature_bound
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.cleared_spline import ClearedSpline
from viaspline.planning.alternatives.homotopy_classes import TautRow
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.checking.conflicts import is_clear
from viaspline.planning.checking.driving_time import driving_time, leg_time
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.problem.work_budget import SpentBudgetError
from viaspline.planning.routing.asked_sides import AskedSides
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.planning.routing.route_problem import on_the_line
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.turning.bend_row import DETOUR, Bends, LegBends, bends_along, bends_of_legs
from viaspline.planning.turning.end_turns import soonest_end_turns
from viaspline.planning.turning.laid_turns import through_spans, through_turns
from viaspline.planning.turning.lane import Lane
from viaspline.planning.turning.lane_stays import LegLane
from viaspline.planning.turning.local_detours import LANE_REACHES, LaneTurns, local_bends
from viaspline.planning.turning.repair import clear_turn_path
from viaspline.planning.turning.short_turns import short_turn_path
from viaspline.planning.turning.spline_and_turns import turns_on_runs
from viaspline.planning.turning.turn_path import OVERSHOOT, TurnPath
from viaspline.planning.turning.wide_turns import WideTurns
from viaspline.world.world import World

# Radii of turns for a long body without a turning circle, wide ones first, in required distances.
FREE_TURN_RADII = (3.0, 1.5)
LEAST_FREE_TURN_RADIUS = 0.5
ROOMY_TURN_RADIUS = 2.0  # of turns where there is room, even if sharper ones are as fast
LOOP_RAD = 1.25 * math.pi  # a turn by more is a loop: it begins to the other side
MUCH_LOST = 1.07  # time of a leg, over that of a straight line
LEAST_REQUIRED_M = 1e-3  # that these are of
DEAR_LANE = 1.05  # driven time of a leg on its line over the shortest way's; nobody asked for that

RowBends = tuple[LegBends, ...]
LayTurns = Callable[[Bends, World, Requirements], TurnPath | None]


@dataclass(frozen=True)
class DrivenProblem(PathProblem):
    """A path that is asked for, and the spline that there is for the disc in the body.

    Attributes:
        cleared: The spline.
    """

    cleared: ClearedSpline = field(kw_only=True)

    @property
    def turn_radius(self) -> float:
        """The radius of the turning circle, or of what stands for one [m]."""
        if self.requirements.turn_radius is not None:
            return self.requirements.turn_radius
        return LEAST_FREE_TURN_RADIUS * max(self.requirements.required, LEAST_REQUIRED_M)

    @property
    def least_radii(self) -> tuple[float, ...]:
        """The least radii with which turns are laid [m], in the order in which they are tried."""
        least = self.sharpest
        if self.requirements.turn_radius is not None:
            return (least,)
        wide = tuple(part * self.requirements.required for part in FREE_TURN_RADII)
        if self._takes_wide_turns:
            return (*wide, least)
        own = OVERSHOOT * self.requirements.outer_radius
        return (own, least, *reversed(wide)) if own > least else (least, *reversed(wide))

    @property
    def sharpest(self) -> float:
        """The least of them [m]."""
        return OVERSHOOT * self.turn_radius

    @property
    def searched_radii(self) -> tuple[float, ...]:
        """Those of them that are worth a longer search [m], in the same order."""
        radii = self.least_radii
        if len(radii) == 1:
            return radii
        return radii[1:] if self._takes_wide_turns else radii[:2]

    @property
    def _takes_wide_turns(self) -> bool:
        """Whether wide turns come first: not where a disc is to have the shortest path."""
        return self.requirements.objective.is_time or not self.requirements.is_free_disc

    @cached_property
    def legs(self) -> tuple[LegSearch, ...]:
        """The legs of the sequence."""
        return tuple(
            LegSearch(self.sequence, k, self.world, self.requirements, self.router, sides)
            for k, sides in enumerate(self.sides)
        )

    @cached_property
    def sides(self) -> tuple[AskedSides, ...]:
        """The sides that are asked for, with those that the spline was found to meet."""
        return self.cleared.sides

    @cached_property
    def shortest_row(self) -> TautRow:
        """The shortest taut path of every leg."""
        return TautRow.of(_shortest(leg) for leg in self.legs)

    @cached_property
    def bends(self) -> Bends:
        """What the shortest taut paths go round."""
        return bends_along(self.sequence, self.shortest_row.taut_paths)

    @property
    def spots(self) -> set[int]:
        """The via points at which the robot may turn on the spot."""
        where = self.requirements.turns_on_spot
        return {
            k
            for k, via in enumerate(self.sequence.vias)
            if where == "vias" or (where == "stations" and via.dwell > 0.0)
        }

    def is_clear(self, spans: Floats) -> bool:
        """Whether the body keeps clear on planar spans."""
        return is_clear(self.world, spans, self.requirements)

    def keeps_sides(self, spline_path: SplinePath) -> bool:
        """Whether a path passes everything on the sides that are asked for."""
        return not any(len(sides.wrong(spline_path.leg(k))) for k, sides in enumerate(self.sides))

    def passed_wrong(self, turn_path: TurnPath) -> tuple[tuple[int, Floats], ...]:
        """What a turn path passes on the wrong side: the leg, and the middle of it [m], (2,)."""
        spline_path = through_turns(self.sequence, [turn_path])
        return tuple(
            (k, barrier[:2])
            for k, sides in enumerate(self.sides)
            for barrier in sides.barriers[np.isin(sides.indices, sides.wrong(spline_path.leg(k)))]
        )

    def is_drivable(self, spans: Floats) -> bool:
        """Whether the body keeps clear, and no turn is sharper than the turning circle."""
        limit = self.requirements.turn_radius
        if limit is not None and not self._curvature_bound(spans) * limit <= 1.0:
            return False
        return self.is_clear(spans)

    def is_round(self, spans: Floats) -> bool:
        """Whether no turn is sharper than the circle round the body, about the reference point."""
        return self._curvature_bound(spans) * self.requirements.outer_radius <= 1.0

    def _curvature_bound(self, spans: Floats) -> float:
        """What the curvature is nowhere above [1/m]."""
        flat = np.ascontiguousarray(spans[:, :, :2])
        is_closed = self.sequence.closed and np.array_equal(flat[0, 0], flat[-1, 3])
        ground = PiecewiseCubic(flat, closed=is_closed)  # with the seam: no turn there either
        return curvature_bound(ground)[0]

    def cost(self, spline_path: SplinePath) -> float:
        """What a path is chosen by [s or m]."""
        objective = self.requirements.objective
        if not objective.is_time:
            return spline_path.length
        rests = spline_path.rests(self.sequence)
        return driving_time(spline_path.spans, objective.pace, rests)

    def loses_much(self, spline_path: SplinePath, leg: int) -> bool:
        """Whether a leg takes much longer than a straight line as long as its shortest taut path.

        So much that ways on other sides are worth the search among many obstacles.
        """
        if not self.requirements.objective.is_time:
            return False
        pace, stands = self.requirements.objective.pace, self.legs[leg].stands
        line = np.zeros((1, 4, 2))
        line[0, :, 0] = np.linspace(0.0, self.shortest_row.taut_paths[leg].length, 4)
        least = leg_time(line, pace, stands)
        return leg_time(spline_path.leg(leg), pace, stands) > MUCH_LOST * least

    def turns_along(
        self, taut_paths: Sequence[TautPath], choices: Iterable[RowBends] | None = None
    ) -> SplinePath | None:
        """Lines and turns along a row of taut paths, with the widest turns that keep clear.

        Where the mission says how taut its spline is to be, on the blocked legs alone if that
        keeps clear.

        Args:
            taut_paths: One for each leg.
            choices: The bends along them, if they are known: see ``bends_along``.
        """
        tried, again = tee(self.bends_along(taut_paths) if choices is None else choices)
        if self.requirements.has_own_tension and self.requirements.detours != "local":
            spline_path = self._turns_on_blocked(taut_paths, tried)
            if spline_path is not None:
                return spline_path
        return self._cheapest_unwound(again)

    def _cheapest_unwound(self, choices: Iterable[RowBends]) -> SplinePath | None:
        """The first that is laid; where that makes a loop, the cheapest up to one that makes none.

        A wide turn into a given heading may have room by a loop alone, where a sharper one needs
        none.
        """
        best: SplinePath | None = None
        cost = math.inf
        try:
            for legs, rho in self._at_radii(choices):
                bends = bends_of_legs(self.sequence, legs)
                turn_path = self._turns_round(bends, rho, self._rests_at_ends)
                if turn_path is None:
                    continue
                spline_path = through_turns(self.sequence, [turn_path])
                if not self.keeps_sides(spline_path):
                    continue
                its_cost = self.cost(spline_path)
                if its_cost < cost:
                    best, cost = spline_path, its_cost
                if float(np.abs(turn_path.turns).max()) < LOOP_RAD:
                    break
        except SpentBudgetError:
            if best is None:
                raise
        return best

    def _at_radii(self, choices: Iterable[RowBends]) -> Iterator[tuple[RowBends, float]]:
        """Each choice of bends with every least radius of turns [m]."""
        return ((legs, rho) for legs in choices for rho in self.least_radii)

    def _turns_on_blocked(
        self, taut_paths: Sequence[TautPath], choices: Iterable[RowBends]
    ) -> SplinePath | None:
        """The spline with turns on its blocked legs, if some are free and it can be driven."""
        bent = {k for k, taut_path in enumerate(taut_paths) if not taut_path.is_direct}
        blocked = bent | set(self.cleared.passed)
        if len(blocked) == len(self.sequence.legs):
            return None
        for legs, rho in self._at_radii(choices):
            lay_row = partial(self._turns_round, rho=rho)
            found = turns_on_runs(self.sequence, legs, blocked, lay_row)
            if found is None:
                continue
            spans, joints, detours = found
            spline_path = through_spans(self.sequence, spans, np.array(joints), detours)
            if self.is_drivable(spline_path.spans) and self.keeps_sides(spline_path):
                return spline_path
        return None

    @property
    def keeps_lanes(self) -> bool:
        """Whether there is a leg on its shortest way that is to keep to its line, or get to it."""
        return any(self._shortest_local)

    @property
    def kept_lanes(self) -> tuple[Lane | None, ...]:
        """The line that each leg keeps to on its shortest way, or gets to; None without one."""
        return tuple(
            None if bends is None else Lane.of(self.sequence.whole_leg(leg))
            for leg, bends in enumerate(self._shortest_local)
        )

    def bends_along(self, taut_paths: Sequence[TautPath]) -> Iterator[RowBends]:
        """The bends of legs along taut paths, those first that keep most to the lines of vias."""
        short = tuple(LegBends.along(taut_path) for taut_path in taut_paths)
        stretched = []
        for reach in LANE_REACHES:
            local = self._local_legs(taut_paths, reach)
            if not any(local):
                break
            stretched.append(local)
            yield tuple(mine or its for mine, its in zip(local, short, strict=True))
        if stretched and len(short) > 1:
            choices = zip(*stretched, short, strict=True)
            yield tuple(self._first_that_fits(k, legs) for k, legs in enumerate(choices))
        yield short

    def _first_that_fits(self, leg: int, choices: Sequence[LegBends | None]) -> LegBends:
        """The first of some bends of a leg round which it can be laid by itself, else the last."""
        alone = self._alone(leg)
        *local, short = [bends for bends in choices if bends is not None]
        for bends in local:
            row = bends_of_legs(alone, [bends])
            if self._turns_round(row, self.sharpest) is not None:
                return bends
        return short

    def _alone(self, leg: int) -> ViaSequence:
        """A leg by itself, from rest to rest."""
        ends = self.sequence.ends(leg)
        return replace(self.sequence, vias=ends, legs=(self.sequence.legs[leg],), closed=False,
                       start_tangent=None, end_tangent=None, parts_of=())  # fmt: skip

    def _local_legs(
        self, taut_paths: Sequence[TautPath], reach: float
    ) -> tuple[LegBends | None, ...]:
        """The bends of every leg that keeps to its line, None where it takes the shortest way."""
        if not self.requirements.may_be_local:
            return (None,) * len(taut_paths)
        if reach > LANE_REACHES[0]:
            return self._kept_to_lanes(taut_paths, reach)
        known = zip(self.shortest_row.taut_paths, self._shortest_local, strict=True)
        rows = zip(self.lanes, taut_paths, known, strict=True)
        turns = self._lane_turns(reach)
        return tuple(
            bends if taut_path is shortest else local_bends(lane, taut_path, turns)
            for lane, taut_path, (shortest, bends) in rows
        )

    @cached_property
    def _shortest_local(self) -> tuple[LegBends | None, ...]:
        """Those of the legs of the shortest row; other rows differ from it in a leg or two."""
        taut_paths = self.shortest_row.taut_paths
        if not self.requirements.may_be_local:
            return (None,) * len(taut_paths)
        return self._kept_to_lanes(taut_paths, LANE_REACHES[0])

    def _kept_to_lanes(
        self, taut_paths: Sequence[TautPath], reach: float
    ) -> tuple[LegBends | None, ...]:
        turns = self._lane_turns(reach)
        pairs = zip(self.lanes, taut_paths, strict=True)
        kept = [local_bends(lane, taut_path, turns) for lane, taut_path in pairs]
        if self.requirements.detours == "local" or not self.requirements.objective.is_time:
            return tuple(kept)
        return tuple(
            None if bends is None or self._is_dear(leg, bends, LegBends.along(taut_path)) else bends
            for leg, (bends, taut_path) in enumerate(zip(kept, taut_paths, strict=True))
        )

    def _is_dear(self, leg: int, kept: LegBends, short: LegBends) -> bool:
        """Whether it takes much longer to keep to a leg's line than to take the shortest way."""
        alone = self._alone(leg)
        times = [self._ideal_time(alone, bends_of_legs(alone, [one])) for one in (kept, short)]
        return times[0] > DEAR_LANE * times[1] > 0.0

    def _lane_turns(self, reach: float) -> LaneTurns:
        widest = max(self.requirements.objective.pace.widest_radius, self._roomy)
        return LaneTurns(self.sharpest, max(widest, self.sharpest), reach)

    @cached_property
    def lanes(self) -> tuple[LegLane, ...]:
        """The lines that legs may keep to."""
        return tuple(LegLane.of(leg) for leg in self.legs)

    def is_promising(self, legs: RowBends, bound: float) -> bool:
        """Whether turns round the bends of all legs may cost less than a bound [m or s].

        Those of a good driver do where nothing else stands beside them.
        """
        if not self.requirements.objective.is_time:
            return True
        bends, stands = bends_of_legs(self.sequence, legs), tuple(leg.stands for leg in self.legs)
        asked = ("ideal time", self.sharpest, bends.key, stands)
        return (
            self.requirements.once(asked, partial(self._ideal_time, self.sequence, bends)) < bound
        )

    def _ideal_time(self, sequence: ViaSequence, bends: Bends) -> float:
        """The driven time of turns with nothing else beside them; 0 where there are none [s]."""
        ideal = self._wide_turns(self.sharpest).ideal(bends, self.requirements)
        if ideal is None:
            return 0.0
        at_vias = ideal.bends.vias != DETOUR
        joints = ideal.begins[: len(at_vias)][at_vias]
        rests = sequence.rests(joints, len(ideal.spans))
        return driving_time(ideal.spans, self.requirements.objective.pace, rests)

    def _wide_turns(self, rho: float) -> WideTurns:
        pace = self.requirements.objective.pace
        return WideTurns(pace, rho, self.sharpest, self._roomy)

    @property
    def _roomy(self) -> float:
        return ROOMY_TURN_RADIUS * self.requirements.required

    @property
    def _rests_at_ends(self) -> tuple[bool, bool]:
        """Whether the robot stands where the path begins, and where it ends."""
        sequence = self.sequence
        if sequence.closed:
            return (False, False)
        return sequence.stands(0), sequence.stands(len(sequence.vias) - 1)

    def _turns_round(
        self, bends: Bends, rho: float, rests: tuple[bool, bool] = (False, False)
    ) -> TurnPath | None:
        """Turns of at least a radius [m]: no wider ones where it is the length that counts.

        Args:
            bends: The row.
            rho: The radius [m].
            rests: Whether the robot stands where the row begins, and where it ends.
        """
        if not self.requirements.objective.is_time:
            lay = short_turn_path if self.requirements.is_free_disc else clear_turn_path
            return lay(bends.turning(rho), self.world, self.requirements)
        turns = self._wide_turns(rho)
        return soonest_end_turns(turns, bends, self.world, self.requirements, rests)

    def leg_on_sides(self, leg: int, bends: Bends, lay: LayTurns) -> TurnPath | None:
        """The turn path of one leg, if it keeps clear and to the sides that are asked for.

        Args:
            leg: The leg.
            bends: Its bends.
            lay: Lays a clear turn path round bends, if it can.
        """
        turn_path = lay(bends, self.world, self.requirements)
        if turn_path is None or self.sides[leg].crossed(turn_path.spans).any():
            return None
        return turn_path


@dataclass(frozen=True)
class TurnProblem:
    """A path that is asked for, with turns that are nowhere sharper than a radius.

    Attributes:
        path: What is to be driven.
        rho: The least radius [m].
    """

    path: DrivenProblem
    rho: float


def _shortest(leg: LegSearch) -> TautPath:
    active = on_the_line(leg.world, *leg.ends, leg.requirements.required)
    taut_path = leg.shortest_allowed(active)[0].value
    assert taut_path is not None  # the spline was led along one
    return taut_path
