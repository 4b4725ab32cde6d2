"""The spline through the via points, blocked legs led round what stands in their way.

What every path begins with: whatever drives it, the disc in its body needs a way. A refusal here is
everyone's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.routing.narrow_gaps import narrow_places
from viaspline.kernels.world.corner_fans import X, Y
from viaspline.planning.alternatives.cleared_spline import ClearedSpline
from viaspline.planning.alternatives.fit import tighten, untied
from viaspline.planning.alternatives.groups import FEW_GROUPS, GroupsInTheWay, groups_met
from viaspline.planning.alternatives.islands import IslandsInTheWay
from viaspline.planning.alternatives.leg_search import LegSearch, Spline
from viaspline.planning.alternatives.passed_leg import PassedLeg
from viaspline.planning.alternatives.unrouted_leg import unrouted
from viaspline.planning.checking.conflicts import CLEAR, too_close
from viaspline.planning.problem.method import Found, GaveUp, Outcome
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence, lay
from viaspline.planning.routing.asked_sides import AskedSides
from viaspline.planning.routing.leg_refusals import explain_tight_leg
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.planning.routing.route_problem import NO_BARRIERS, on_the_line
from viaspline.planning.routing.via_refusals import refuse_blocked_vias

CURVE_SLACK_M = 1e-4  # room on either side that a curve may need beyond what is required


@dataclass(frozen=True)
class ClearSpline:
    """Lays the spline, and leads every blocked leg round what stands in its way.

    The other legs are left alone.

    Attributes:
        max_rounds: Every round lowers slack, of spans that loop or of legs that are too close.
        max_closed_gaps: Gaps of a leg that are closed because no curve fits through them.
        max_weighed: Groups in the way of a leg up to which the splines on either side are weighed.
    """

    max_rounds: int = 60
    max_closed_gaps: int = 200
    max_weighed: int = FEW_GROUPS

    def lay(self, problem: PathProblem) -> ClearedSpline:
        """Lay it.

        Raises:
            NoPathError: When a via point has no room, or nothing leads from one to the next.
            GaveUpError: When a budget ran out before that was known.
        """
        sequence, world, requirements = problem.sequence, problem.world, problem.requirements
        refuse_blocked_vias(sequence, world, requirements)
        passed: dict[int, PassedLeg] = {}
        sides = list(problem.sides)
        leg = 0
        for _ in range(self.max_rounds):
            spans = lay(sequence)
            loose = untied(sequence, spans)
            if loose is not sequence:
                sequence = loose
                continue
            close = too_close(world, spans, requirements.required)
            first = sequence.first_spans()
            parts = [slice(*ends) for ends in pairwise(first.tolist())]
            off = [
                asked.crossed(spans[part]).any() for asked, part in zip(sides, parts, strict=True)
            ]
            if (close == CLEAR).all() and not any(off):
                spline_path = SplinePath.through(sequence, spans, first, _detours(sequence))
                return ClearedSpline(spline_path, tuple(sides), passed)
            for leg, part in enumerate(parts):
                hit = close[part]
                hit = hit[hit != CLEAR]
                if not (hit.size or off[leg]):
                    continue
                if leg in passed:  # a neighbour that was led round has turned its tangents
                    required, closed = requirements.required, sides[leg].closed
                    tightened = tighten(sequence, leg, world, required, closed)
                    if tightened is not None:
                        sequence = tightened.sequence
                        continue
                passed[leg], sides[leg] = self._led_round(
                    problem, sequence, leg, hit[hit >= 0].tolist()
                )
                sequence = passed[leg].taken.fitted.sequence
        rounds = f"{self.max_rounds} rounds of drawing the spline in"
        raise explain_tight_leg(sequence, leg, world, requirements, (rounds,))

    def _led_round(
        self, problem: PathProblem, sequence: ViaSequence, index: int, hit: Sequence[int]
    ) -> tuple[PassedLeg, AskedSides]:
        """Lead one leg round everything, by the shorter side of each group if they are few.

        The sides of what it met on the way bind it from then on.

        Args:
            problem: What is to be laid.
            sequence: What there is so far.
            index: The leg that comes too close to something.
            hit: Obstacles that its curve comes too close to.

        Raises:
            NoPathError: When there is no way, with the least change that would serve.
            GaveUpError: When that isn't known.
        """
        world, requirements, router = problem.world, problem.requirements, problem.router
        leg = LegSearch(sequence, index, world, requirements, router, problem.sides[index])
        active = on_the_line(world, *leg.ends, requirements.required)
        active[list(hit)] = True
        is_dense = router.is_dense(active)
        met = () if is_dense else groups_met(leg, problem.groups, active)
        outcome, barriers = self._fitted(leg, active)
        if not isinstance(outcome, Found):
            raise unrouted(leg, outcome, barriers)
        leg = replace(leg, sides=leg.sides.binding_if_met(active))
        if is_dense:
            return PassedLeg(IslandsInTheWay(leg), outcome.value, is_weighed=False), leg.sides
        groups = GroupsInTheWay(leg, met, active)
        is_weighed = len(met) <= self.max_weighed
        return PassedLeg(groups, outcome.value, is_weighed), leg.sides

    def _fitted(self, leg: LegSearch, active: Flags) -> tuple[Outcome[Spline], Floats]:
        """The curve along the shortest taut path on which one fits, and the forbidden sides.

        A gap that is just as wide as what is required lets a polyline through, but no curve with
        a certificate: it is closed then.
        """
        closed = NO_BARRIERS
        while True:
            outcome, barriers = leg.shortest_allowed(active, closed)
            if not isinstance(outcome, Found):
                return outcome, barriers
            best = leg.curve(outcome.value, active)
            if best is not None:
                return Found(best, best.measured.length), barriers
            places = np.ascontiguousarray(outcome.value.corners[:, X : Y + 1])
            room = leg.requirements.required + CURVE_SLACK_M
            tight = narrow_places(leg.world.packed, places, room)
            if not len(tight):
                roomier = _along_fatter(leg, active, closed)
                if roomier is not None:
                    return Found(roomier, roomier.measured.length), barriers
                return GaveUp(("a spline along a route that touches what it passes",)), barriers
            if len(closed) > self.max_closed_gaps:
                tried = f"routes through {len(closed)} gaps that no curve fits through"
                return GaveUp((tried,)), barriers
            closed = np.vstack((closed, tight))


def _along_fatter(leg: LegSearch, active: Flags, closed: Floats) -> Spline | None:
    """The curve along the taut path of a body that is a hair fatter.

    A route turns a millimetre off what it goes round, and may touch what is opposite just so: no
    curve fits there. That of a fatter body has room on both sides.
    """
    router = leg.router
    fatter = replace(router, required=router.required + CURVE_SLACK_M)
    outcome, _ = replace(leg, router=fatter).shortest_allowed(active, closed)
    return leg.curve(outcome.value, active)


def _detours(sequence: ViaSequence) -> list[int]:
    """The spans that begin at the detour via points of a sequence."""
    first = sequence.first_spans().tolist()
    return [
        u + sequence.pieces * j
        for u, leg in zip(first, sequence.legs, strict=False)
        for j in range(1, len(leg.slack))
    ]
