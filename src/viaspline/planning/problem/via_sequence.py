"""A via sequence: the points that a spline runs through, leg by leg from user via to user via.

Tested through ``test_planner``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.tangents import ALPHA, PIECES, RULES
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.mission.model import Mission
from viaspline.mission.spline_spec import SplineSpec, Tangents


@dataclass(frozen=True)
class RouteVia:
    """A point of the mission's route as the planner sees it.

    Attributes:
        name: What it is called.
        at: [m], shape (d,).
        index: Its place in the route, 0 for the start; None for a place under way.
        dwell: [s].
        key: Its key in the mission that is planned; empty for a place under way.
    """

    name: str
    at: Floats
    index: int | None
    dwell: float = 0.0
    key: str = ""


@dataclass(frozen=True)
class Leg:
    """What lies between two user via points.

    Attributes:
        points: Detour via points [m], shape (k, d).
        slack: One for each of the k + 1 spans.
    """

    points: Floats
    slack: Floats

    @classmethod
    def straight(cls, slack: float, dimension: int) -> Leg:
        """A leg without detours."""
        return cls(np.empty((0, dimension)), np.array([slack]))


@dataclass(frozen=True)
class WholeLeg:
    """The leg of the route that a leg is, or that it is the rest of where it is laid under way.

    What a leg goes past is seen along the whole of it, wherever the robot is by now.

    Attributes:
        start: The user's via point before it [m], (d,).
        goal: The user's via point after it [m], (d,).
        laid: Bézier control polygons of the curve that is driven so far [m], (m, 4, d); None where
            there is none.
    """

    start: Floats
    goal: Floats
    laid: Floats | None = None


@dataclass(frozen=True)
class ViaSequence:
    """User via points and the legs between them.

    Attributes:
        vias: (n,) of them, n >= 2.
        legs: n - 1 of them, or n when it is closed.
        spline: Its knots; tensions stand in the legs as slack.
        tangents: Which ones.
        start_tangent: Direction in which the curve leaves, shape (d,), or None.
        end_tangent: Direction in which it arrives, shape (d,), or None.
        closed: Whether it comes back to the first via point.
        parts_of: The leg of the route that each leg is a part of; empty where they are whole.
    """

    vias: tuple[RouteVia, ...]
    legs: tuple[Leg, ...]
    spline: SplineSpec
    start_tangent: Floats | None = None
    end_tangent: Floats | None = None
    tangents: Tangents = "cardinal"
    closed: bool = False
    parts_of: tuple[WholeLeg, ...] = ()

    @property
    def places(self) -> Floats:
        """Where the via points are [m], the first once more at the end of a round, (v, d)."""
        ends = (*self.vias, self.vias[0]) if self.closed else self.vias
        return np.array([via.at for via in ends])

    def whole_leg(self, leg: int) -> WholeLeg:
        """The leg of the route that a leg is or is a part of."""
        if self.parts_of:
            return self.parts_of[leg]
        start, goal = self.ends(leg)
        return WholeLeg(start.at, goal.at)

    def ends(self, leg: int) -> tuple[RouteVia, RouteVia]:
        """The via points before and after a leg."""
        return self.vias[leg], self.vias[(leg + 1) % len(self.vias)]

    def with_leg(self, index: int, leg: Leg) -> ViaSequence:
        """This sequence with another leg."""
        return replace(self, legs=(*self.legs[:index], leg, *self.legs[index + 1 :]))

    def between(self, first: int, last: int) -> ViaSequence:
        """The part from one via point to another, of a round past its end; free where it is cut.

        Args:
            first: The via point with which it begins.
            last: That with which it ends, counted on past the last of a round.
        """
        count = len(self.vias)
        legs = [k % len(self.legs) for k in range(first, last)]
        at_start, at_end = not self.closed and first == 0, not self.closed and last == count - 1
        return replace(
            self,
            vias=tuple(self.vias[k % count] for k in range(first, last + 1)),
            legs=tuple(self.legs[k] for k in legs),
            start_tangent=self.start_tangent if at_start else None,
            end_tangent=self.end_tangent if at_end else None,
            closed=False,
            parts_of=tuple(self.parts_of[k] for k in legs) if self.parts_of else (),
        )

    def stands(self, via: int) -> bool:
        """Whether the robot stands still at a via point, the one after the last the first again."""
        at = self.vias[via % len(self.vias)]
        is_end = via in (0, len(self.vias) - (not self.closed))
        return at.dwell > 0.0 or at.index == 0 or (is_end and at.index is not None)

    def rests(self, joints: Ints, spans: int) -> Flags:
        """Where the robot stands still on a curve through the via points, (spans + 1,).

        Args:
            joints: The span that begins at each via point, from the first on.
            spans: How many there are.
        """
        found = np.zeros(spans + 1, np.bool_)
        found[joints] = [self.stands(k) for k in range(len(joints))]
        return found

    @property
    def pieces(self) -> int:
        """Cubics from one via point to the next, detours counted."""
        return PIECES[self.tangents]

    def first_spans(self) -> NDArray[np.int64]:
        """Index of every leg's first span, and the number of all spans at the end."""
        return np.cumsum([0, *(self.pieces * len(leg.slack) for leg in self.legs)])


def lay(sequence: ViaSequence) -> Floats:
    """The cardinal spline through a via sequence: Bézier control polygons [m], shape (m, 4, d)."""
    rows: list[Floats] = []
    for k, leg in enumerate(sequence.legs):
        rows.append(sequence.vias[k].at[None, :])
        if len(leg.points):
            rows.append(leg.points)
    if not sequence.closed:
        rows.append(sequence.vias[-1].at[None, :])
    points = np.concatenate(rows)
    slack = np.concatenate([leg.slack for leg in sequence.legs])
    return spline_spans(points, slack, sequence)


def spline_spans(points: Floats, slack: Floats, sequence: ViaSequence) -> Floats:
    """Spans through points with the sequence's knots, tangents and end directions."""
    start, end = sequence.start_tangent, sequence.end_tangent
    none = np.zeros(points.shape[1])
    return RULES[sequence.tangents](
        points, ALPHA[sequence.spline.knots], slack,
        none if start is None else start, none if end is None else end,
        start is not None, end is not None, sequence.closed,
    )  # fmt: skip


def via_sequence_of(mission: Mission) -> ViaSequence:
    """The via sequence of a mission before any detour."""
    route = mission.route
    named = list(route.points())
    vias = tuple(
        RouteVia(via.name or _default_name(key), np.array(via.at, np.float64), i, via.dwell_s, key)
        for i, (key, via) in enumerate(named)
    )
    dimension = len(vias[0].at)
    count = len(vias) if route.closed else len(vias) - 1
    slack = span_slack(mission.spline, count)
    goal = route.goal
    start_tangent = direction(route.start.heading_deg, dimension)
    end_tangent = None if goal is None else direction(goal.heading_deg, dimension)
    # A round with a heading at its start is laid as a path to there that arrives with it. Along a
    # corridor it stays a round: its line takes the heading by itself.
    is_round = route.closed and (start_tangent is None or route.corridor is not None)
    if route.closed and not is_round:
        vias = (*vias, replace(vias[0], index=count))
        end_tangent = start_tangent
    return ViaSequence(
        vias=vias,
        legs=tuple(Leg.straight(value, dimension) for value in slack),
        spline=mission.spline,
        tangents=mission.tangents,
        start_tangent=start_tangent,
        end_tangent=end_tangent,
        closed=is_round,
    )


def span_slack(spline: SplineSpec, count: int) -> tuple[float, ...]:
    """The slack s of every span, from tension or slack, one number or one for each.

    Raises:
        GeometryError: When there are more or fewer than the spans, or they are still to be advised.
    """
    if spline.tension == "auto":
        raise GeometryError("spline: tension is auto; let the planner choose it first")
    given: float | Sequence[float]
    if spline.slack is not None:
        given = spline.slack
        values = [given] * count if isinstance(given, float | int) else list(given)
    else:
        given = 0.0 if spline.tension is None else spline.tension
        tensions = [given] * count if isinstance(given, float | int) else list(given)
        values = [(1 - t) / 2 for t in tensions]
    if len(values) != count:
        raise GeometryError(f"spline: {len(values)} tensions for {count} spans; give one for each")
    return tuple(values)


def _default_name(key: str) -> str:
    tail = key.removeprefix("route.")
    return f"via {int(tail[4:-1]) + 1}" if tail.startswith("via[") else tail


def direction(heading_deg: float | None, dimension: int) -> Floats | None:
    """The unit vector of a heading in the plane, shape (d,); None if it is free."""
    if heading_deg is None:
        return None
    angle = np.radians(heading_deg)
    direction = np.zeros(dimension)
    direction[:2] = np.cos(angle), np.sin(angle)
    return direction
