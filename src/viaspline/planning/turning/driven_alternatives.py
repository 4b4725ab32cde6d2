"""Either side of what a leg meets, as a robot with a body or a turning circle drives it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.comparison import SIDES, Comparison
from viaspline.planning.alternatives.groups import PassedGroups
from viaspline.planning.alternatives.lead_round import Passed
from viaspline.planning.alternatives.leg_search import Curve
from viaspline.planning.checking.cost import measure_body
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.routing.router import TautPath
from viaspline.world.world import World

SAMPLES = 8  # of a span, for the side on which it passes something
GAIN = 1e-6  # part of the length by which another side has to be shorter


@dataclass(frozen=True)
class DrivenSides:
    """Lays a course along other ways than those that were taken.

    Attributes:
        sequence: With the via points and nothing else.
        world: The known world.
        requirements: What to keep.
        lay: The curve of the course with some legs along given ways, the others along their
            shortest; None if it comes too close to something.
        is_drivable: Whether planar spans (m, 4, 2) [m] are, as they are.
    """

    sequence: ViaSequence
    world: World
    requirements: Requirements
    lay: Callable[[Mapping[int, TautPath]], SplinePath | None]
    is_drivable: Callable[[Floats], bool]

    def shortest(self, spline_path: SplinePath, passed: Mapping[int, Passed]) -> SplinePath:
        """The curve, or a shorter one on other sides of the groups in its way.

        A side that is shorter for a point can be longer for a robot that has to swing out for
        it. Ways that are longer by more than the curve is longer than its ways can't win.

        Args:
            spline_path: The course along the shortest ways, or as a search among poses found it.
            passed: The legs that were led round something.
        """
        taken: dict[int, TautPath] = {}
        lengths = np.array([self._shortest_way(k, passed) for k in range(len(self.sequence.legs))])
        length = PiecewiseCubic(spline_path.spans).length
        for leg, met in passed.items():
            if not isinstance(met, PassedGroups):
                continue
            for curve in met.comparison.curves:
                longer = curve.taut_path.length - lengths[leg]
                if curve is met.best or longer >= length - lengths.sum():
                    continue
                other = self.lay({**taken, leg: curve.taut_path})
                if other is None:
                    continue
                needed = PiecewiseCubic(other.spans).length
                if needed < length * (1.0 - GAIN):
                    spline_path, length = other, needed
                    taken[leg], lengths[leg] = curve.taut_path, curve.taut_path.length
        return spline_path

    def _shortest_way(self, leg: int, passed: Mapping[int, Passed]) -> float:
        """Length of a leg's shortest way [m]."""
        if leg in passed:
            return passed[leg].best.taut_path.length
        start, goal = self.sequence.ends(leg)
        return float(np.linalg.norm(goal.at[:2] - start.at[:2]))

    def comparison(self, comparison: Comparison, spline_path: SplinePath) -> Comparison:
        """The curves past what a leg meets, as they are driven.

        Args:
            comparison: The splines.
            spline_path: The course as it was laid in the end.
        """
        winner = self._curve(comparison.leg.index, spline_path)
        curves = [winner]
        met = comparison.met
        sides = {tuple(group.side_of(winner.taut_path) for group in met)}
        refused: list[TautPath] = []
        for spline in comparison.curves:
            passing = tuple(group.side_of(spline.taut_path) for group in met)
            if passing in sides:
                continue
            sides.add(passing)
            driven = self._driven(comparison.leg.index, spline)
            if driven is None:
                refused.append(spline.taut_path)
            else:
                curves.append(driven)
        reasons = tuple(
            self._reason([group.side_of(taut_path) for taut_path in refused]) or reason
            for group, reason in zip(met, comparison.reasons, strict=True)
        )
        return replace(comparison, curves=tuple(curves), winner=winner, reasons=reasons)

    def _driven(self, leg: int, spline: Curve) -> Curve | None:
        """The spline if it can be driven, else the leg laid along its way."""
        if self.is_drivable(spline.spans[:, :, :2]):
            price = measure_body(spline.spans, self.world, self.requirements)
            return replace(spline, measured=price)
        spline_path = self.lay({leg: spline.taut_path})
        return None if spline_path is None else self._curve(leg, spline_path)

    def _curve(self, leg: int, spline_path: SplinePath) -> Curve:
        """A leg of a curve that was laid."""
        spans = spline_path.leg(leg)
        price = measure_body(spans, self.world, self.requirements)
        return Curve(_way_along(spans), spline_path.detours(leg), spans, price)

    def _reason(self, refused: Sequence[str]) -> str | None:
        """Why one of the sides has no curve, if there would be a way for a point."""
        sides = [side for side in SIDES if side in refused]
        if not sides:
            return None
        body, circle = self.requirements.footprint, self.requirements.turn_radius
        what = "the body" if circle is None else f"with turns of {circle:.3g} m the body"
        if body is None:
            what = f"with turns of {circle:.3g} m the robot"
        return f"{what} comes too close on the {sides[-1]}"


def _way_along(spans: Floats) -> TautPath:
    """A curve as a way, to tell the sides on which it passes what it meets."""
    curve = PiecewiseCubic(spans)
    places = curve.evaluate(np.linspace(*curve.domain, SAMPLES * len(spans) + 1))
    corners = np.zeros((len(places), 8))
    corners[:, :2] = places[:, :2]
    return TautPath(corners, np.empty((0, 6)), curve.length)
