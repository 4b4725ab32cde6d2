"""The problem of a path that a robot is to drive: with what turns, clear of what, at what cost.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from viaspline.curve.bending import curvature_bound, is_round
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.cleared_spline import ClearedSpline
from viaspline.planning.alternatives.homotopy_classes import TautRow
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.alternatives.unrouted_leg import unrouted
from viaspline.planning.checking.conflicts import is_clear
from viaspline.planning.checking.driving_time import driving_time, leg_time
from viaspline.planning.problem.method import Found, GaveUp, Refusal
from viaspline.planning.problem.spline_path import SAME_HEADING_RAD, SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.routing.asked_sides import AskedSides
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.planning.routing.route_problem import on_the_line
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.turning.bend_row import DETOUR, Bends, bends_along
from viaspline.planning.turning.end_turns import soonest_end_turns
from viaspline.planning.turning.laid_turns import through_turns
from viaspline.planning.turning.repair import clear_turn_path
from viaspline.planning.turning.short_turns import short_turn_path
from viaspline.planning.turning.turn_path import OVERSHOOT, TurnPath
from viaspline.planning.turning.wide_turns import WideTurns

# Radii of turns for a long body without a turning circle, wide ones first, in required distances.
FREE_TURN_RADII = (3.0, 1.5)
LEAST_FREE_TURN_RADIUS = 0.5
ROOMY_TURN_RADIUS = 2.0  # of turns where there is room, even if sharper ones are as fast
MOST_LONGER = 1.1  # what round turns may cost, over what turns do that are sharper than the robot
MUCH_LOST = 1.07  # time of a leg, over that of a straight line
LEAST_REQUIRED_M = 1e-3  # that these are of
BESIDE_WALL = 0.25  # beyond the required distance, in such distances: a via point is beside a wall
GRADIENT_STEP = 1e-3  # of the required distance, about a place, to tell the heading of its wall
AXES = np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])


@dataclass(frozen=True)
class TurningProblem(PathProblem):
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
        sharp = (self.own_radius, least) if self.own_radius > least else (least,)
        return (*wide, *sharp) if self._takes_wide_turns else (*sharp, *reversed(wide))

    @property
    def sharpest(self) -> float:
        """The least of them [m]."""
        return OVERSHOOT * self.turn_radius

    @property
    def searched_radii(self) -> tuple[float, ...]:
        """Those of them that are worth a longer search [m]; a disc's own first, then laid wider."""
        radii = self.least_radii
        if len(radii) == 1 or not self._takes_wide_turns:
            return radii[:2]
        wide, own, *least = radii[1:]
        return (own, wide, *least) if self.requirements.is_free_disc else radii[1:]

    @property
    def own_radius(self) -> float:
        """The least radius of turns that are no sharper than the robot's own body [m]."""
        return OVERSHOOT * self.requirements.outer_radius

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

    @cached_property
    def walls(self) -> dict[int, float]:
        """The headings of the walls that via points lie close beside [rad].

        There a turn may have room if it begins or ends along the wall, and no other.
        """
        places = np.array([via.at[:2] for via in self.sequence.vias])
        far = (1.0 + BESIDE_WALL) * self.requirements.required
        steps = GRADIENT_STEP * max(self.requirements.required, LEAST_REQUIRED_M) * AXES
        around = self.world.distance(places[:, None] + steps[None])
        with np.errstate(invalid="ignore"):  # where nothing stands anywhere all are infinite
            out = np.stack((around[:, 0] - around[:, 1], around[:, 2] - around[:, 3]), axis=1)
        beside = (self.world.distance(places) < far) & np.isfinite(out).all(axis=1)
        return {int(k): math.atan2(out[k, 0], -out[k, 1]) for k in np.flatnonzero(beside)}

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
        if limit is not None and not curvature_bound(self._ground(spans))[0] * limit <= 1.0:
            return False
        return self.is_clear(spans)

    def is_round(self, spline_path: SplinePath) -> bool:
        """Whether no turn is sharper than the circle round the body, about the reference point.

        Where the robot may turn on the spot there may be a corner.
        """
        if id(spline_path) not in self._rounds:
            self._rounds[id(spline_path)] = spline_path, self._is_round(spline_path)
        return self._rounds[id(spline_path)][1]

    @cached_property
    def _rounds(self) -> dict[int, tuple[SplinePath, bool]]:
        """Paths that are known to be round or not, by their ids: most are asked for twice."""
        return {}

    def _is_round(self, spline_path: SplinePath) -> bool:
        spans, spots = spline_path.spans, sorted(self.spots)
        parts = [part for part in np.split(spans, spline_path.joints[spots]) if len(part)]
        if spots and self.sequence.closed and 0 not in self.spots:
            parts.append(spans[[-1, 0]])  # its seam
        return all(is_round(self._ground(part), self.requirements.outer_radius) for part in parts)

    def _ground(self, spans: Floats) -> PiecewiseCubic:
        """The ground track of spans; with the seam, if they are a round: no turn there either."""
        flat = np.ascontiguousarray(spans[:, :, :2])
        is_closed = self.sequence.closed and np.array_equal(flat[0, 0], flat[-1, 3])
        return PiecewiseCubic(flat, closed=is_closed)

    def cost(self, spline_path: SplinePath) -> float:
        """What a path is chosen by [s or m]."""
        objective = self.requirements.objective
        if not objective.is_time:
            return spline_path.length
        known = self._times.get(id(spline_path))
        if known is None:
            rests = spline_path.rests(self.sequence)
            time = driving_time(spline_path.spans, objective.pace, rests)
            known = spline_path, time + self._turning_time(spline_path)
            self._times[id(spline_path)] = known
        return known[1]

    def _turning_time(self, spline_path: SplinePath) -> float:
        """For how long a robot that turns on the spot along a path stands for that alone [s]."""
        sequence, turning = self.sequence, self.requirements.turning
        ends = () if sequence.closed else (0, len(sequence.vias) - 1)
        spots = sorted(self.spots.difference(ends))
        if not spots:
            return 0.0
        turns = zip(spots, spline_path.jumps_at(spots).tolist(), strict=True)
        return sum(
            max(turning.time(turn) - sequence.vias[via].dwell, 0.0)
            for via, turn in turns
            if abs(turn) > SAME_HEADING_RAD
        )

    def price(self, spline_path: SplinePath) -> float:
        """What a path is compared with others by [s or m]: more than it costs if it is too sharp.

        That is sharper than the robot itself, where it isn't the length that counts.
        """
        cost, by_time = self.cost(spline_path), self.requirements.objective.is_time
        if not by_time or self.own_radius <= self.sharpest or self.is_round(spline_path):
            return cost
        return MOST_LONGER * cost

    @cached_property
    def _times(self) -> dict[int, tuple[SplinePath, float]]:
        """Paths that were timed, by their ids, with their times [s]: most are compared often."""
        return {}

    def loses_much(self, spline_path: SplinePath, leg: int) -> bool:
        """Whether a leg takes much longer than a straight line as long as its shortest taut path.

        So much that ways on other sides are worth the search among many obstacles.
        """
        if not self.requirements.objective.is_time:
            return False
        pace, stands = self.requirements.objective.pace, self.legs[leg].stands
        line = np.zeros((1, 4, 2))
        line[0, :, 0] = np.linspace(0.0, self.shortest_row.taut_paths[leg].length, 4)
        least = leg_time(line, pace.beside_zones, stands)
        return leg_time(spline_path.leg(leg), pace, stands) > MUCH_LOST * least

    def ideal_time(self, sequence: ViaSequence, bends: Bends, narrowings: int = 0) -> float:
        """The driven time of turns with nothing else beside them; 0 where there are none [s].

        Args:
            sequence: What they lead through.
            bends: What they go round.
            narrowings: See ``WideTurns.ideal``.
        """
        ideal = self.wide_turns(self.sharpest).ideal(bends, self.requirements, narrowings)
        if ideal is None:
            return 0.0
        at_vias = ideal.bends.vias != DETOUR
        joints = ideal.begins[: len(at_vias)][at_vias]
        rests = sequence.rests(joints, len(ideal.spans))
        pace = self.requirements.objective.pace.beside_zones  # a path beside may miss what it meets
        return driving_time(ideal.spans, pace, rests)

    def wide_turns(self, rho: float) -> WideTurns:
        """The turns of a good driver, of at least a radius [m]."""
        pace, own = self.requirements.objective.pace, self.own_radius
        sharpest = max(self.sharpest, min(own, rho))
        return WideTurns(pace, rho, sharpest, self.roomy, own)

    @property
    def roomy(self) -> float:
        """The radius of turns where there is room, even if sharper ones are as fast [m]."""
        return ROOMY_TURN_RADIUS * self.requirements.required

    @property
    def rests_at_ends(self) -> tuple[bool, bool]:
        """Whether the robot stands where the path begins, and where it ends."""
        sequence = self.sequence
        if sequence.closed:
            return (False, False)
        return sequence.stands(0), sequence.stands(len(sequence.vias) - 1)

    def turns_round(
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
        turns = self.wide_turns(rho)
        return soonest_end_turns(turns, bends, self.world, self.requirements, rests)


def _shortest(leg: LegSearch) -> TautPath:
    """The shortest taut path of a leg.

    Raises:
        GaveUpError: When there is none on the sides that bind it by now. Its spline keeps to them,
            so that there is no way at all isn't known.
    """
    active = on_the_line(leg.world, *leg.ends, leg.requirements.required)
    outcome, barriers = leg.shortest_allowed(active)
    if isinstance(outcome, Found):
        return outcome.value
    stuck = GaveUp((outcome.reason,)) if isinstance(outcome, Refusal) else outcome
    raise unrouted(leg, stuck, barriers)
