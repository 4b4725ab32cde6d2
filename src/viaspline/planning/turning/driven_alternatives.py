"""Either side of what a leg meets, as a robot with a body or a turning circle drives it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planning.alternatives.comparison import SIDES, Weighed
from viaspline.planning.alternatives.groups import PassedGroups
from viaspline.planning.alternatives.lead_round import Passed
from viaspline.planning.alternatives.leg_search import Curve
from viaspline.planning.checking.cost import measure_body
from viaspline.planning.problem.requirements import Brief
from viaspline.planning.problem.spline_path import Laid
from viaspline.planning.problem.via_sequence import Course
from viaspline.planning.routing.router import Floats, Way
from viaspline.world.world import World

SAMPLES = 8  # of a span, for the side on which it passes something
GAIN = 1e-6  # part of the length by which another side has to be shorter


@dataclass(frozen=True)
class DrivenSides:
    """Lays a course along other ways than those that were taken.

    Attributes:
        course: With the via points and nothing else.
        world: The known world.
        brief: What to keep.
        lay: The curve of the course with some legs along given ways, the others along their
            shortest; None if it comes too close to something.
        is_drivable: Whether planar spans (m, 4, 2) [m] are, as they are.
    """

    course: Course
    world: World
    brief: Brief
    lay: Callable[[Mapping[int, Way]], Laid | None]
    is_drivable: Callable[[Floats], bool]

    def shortest(self, laid: Laid, passed: Mapping[int, Passed]) -> Laid:
        """The curve, or a shorter one on other sides of the groups in its way.

        A side that is shorter for a point can be longer for a robot that has to swing out for
        it. Ways that are longer by more than the curve is longer than its ways can't win.

        Args:
            laid: The course along the shortest ways, or as a search among poses found it.
            passed: The legs that were led round something.
        """
        taken: dict[int, Way] = {}
        lengths = np.array([self._shortest_way(k, passed) for k in range(len(self.course.legs))])
        length = PiecewiseCubic(laid.spans).length
        for leg, met in passed.items():
            if not isinstance(met, PassedGroups):
                continue
            for curve in met.weighed.curves:
                longer = curve.way.length - lengths[leg]
                if curve is met.best or longer >= length - lengths.sum():
                    continue
                other = self.lay({**taken, leg: curve.way})
                if other is None:
                    continue
                needed = PiecewiseCubic(other.spans).length
                if needed < length * (1.0 - GAIN):
                    laid, length = other, needed
                    taken[leg], lengths[leg] = curve.way, curve.way.length
        return laid

    def _shortest_way(self, leg: int, passed: Mapping[int, Passed]) -> float:
        """Length of a leg's shortest way [m]."""
        if leg in passed:
            return passed[leg].best.way.length
        start, goal = self.course.ends(leg)
        return float(np.linalg.norm(goal.at[:2] - start.at[:2]))

    def weighed(self, weighed: Weighed, laid: Laid) -> Weighed:
        """The curves past what a leg meets, as they are driven.

        Args:
            weighed: The splines.
            laid: The course as it was laid in the end.
        """
        winner = self._curve(weighed.leg.index, laid)
        curves = [winner]
        met = weighed.met
        sides = {tuple(group.side_of(winner.way) for group in met)}
        refused: list[Way] = []
        for spline in weighed.curves:
            passing = tuple(group.side_of(spline.way) for group in met)
            if passing in sides:
                continue
            sides.add(passing)
            driven = self._driven(weighed.leg.index, spline)
            if driven is None:
                refused.append(spline.way)
            else:
                curves.append(driven)
        reasons = tuple(
            self._reason([group.side_of(way) for way in refused]) or reason
            for group, reason in zip(met, weighed.reasons, strict=True)
        )
        return replace(weighed, curves=tuple(curves), winner=winner, reasons=reasons)

    def _driven(self, leg: int, spline: Curve) -> Curve | None:
        """The spline if it can be driven, else the leg laid along its way."""
        if self.is_drivable(spline.spans[:, :, :2]):
            price = measure_body(spline.spans, self.world, self.brief)
            return replace(spline, measured=price)
        laid = self.lay({leg: spline.way})
        return None if laid is None else self._curve(leg, laid)

    def _curve(self, leg: int, laid: Laid) -> Curve:
        """A leg of a curve that was laid."""
        spans = laid.leg(leg)
        price = measure_body(spans, self.world, self.brief)
        return Curve(_way_along(spans), laid.detours(leg), spans, price)

    def _reason(self, refused: Sequence[str]) -> str | None:
        """Why one of the sides has no curve, if there would be a way for a point."""
        sides = [side for side in SIDES if side in refused]
        if not sides:
            return None
        body, circle = self.brief.footprint, self.brief.turn_radius
        what = "the body" if circle is None else f"with turns of {circle:.3g} m the body"
        if body is None:
            what = f"with turns of {circle:.3g} m the robot"
        return f"{what} comes too close on the {sides[-1]}"


def _way_along(spans: Floats) -> Way:
    """A curve as a way, to tell the sides on which it passes what it meets."""
    curve = PiecewiseCubic(spans)
    places = curve.evaluate(np.linspace(*curve.domain, SAMPLES * len(spans) + 1))
    corners = np.zeros((len(places), 8))
    corners[:, :2] = places[:, :2]
    return Way(corners, np.empty((0, 6)), curve.length)
