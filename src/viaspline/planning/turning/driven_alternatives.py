"""Either side of what a leg meets, as a robot with a body or a turning circle drives it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.comparison import SIDES, Comparison
from viaspline.planning.alternatives.leg_search import Curve
from viaspline.planning.checking.cost import measure_body
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.gentler_path import gentler_path
from viaspline.planning.turning.parts_at_corners import PartsAtCorners
from viaspline.planning.turning.station_corners import StationCorners

SAMPLES_PER_SPAN = 8  # for the side on which it passes something


def as_driven(
    problem: DrivenProblem, comparison: Comparison, spline_path: SplinePath
) -> Comparison:
    """The curves past what a leg meets, as they are driven.

    Where the path has corners at stations, the others have them, too.

    Args:
        problem: What was laid, for what drives it.
        comparison: The splines.
        spline_path: The path as it was laid in the end.
    """
    parts = PartsAtCorners.of(problem, spline_path)
    if not parts.corners or not StationCorners(problem).may_be_any:
        return _as_driven(problem, comparison, spline_path)
    part, index = parts.place(comparison.leg.index)
    its = parts.problem(part)
    leg = replace(comparison.leg, sequence=its.sequence, index=index)
    found = _as_driven(its, replace(comparison, leg=leg), parts.cut(spline_path, part))
    return replace(found, leg=comparison.leg)


def _as_driven(
    problem: DrivenProblem, comparison: Comparison, spline_path: SplinePath
) -> Comparison:
    """The curves past what a leg meets, of a path without corners."""
    leg, met = comparison.leg.index, comparison.met
    winner = _curve(problem, leg, spline_path)
    curves = [winner]
    sides = {tuple(one.side_of(winner.taut_path) for one in met)}
    refused: list[TautPath] = []
    for spline in comparison.curves:
        passing = tuple(one.side_of(spline.taut_path) for one in met)
        if passing in sides:
            continue
        sides.add(passing)
        driven = _driven(problem, leg, spline)
        if driven is None:
            refused.append(spline.taut_path)
        else:
            curves.append(driven)
    reasons = tuple(
        _reason(problem.requirements, [one.side_of(taut_path) for taut_path in refused]) or reason
        for one, reason in zip(met, comparison.reasons, strict=True)
    )
    return replace(comparison, curves=tuple(curves), winner=winner, reasons=reasons)


def _driven(problem: DrivenProblem, leg: int, spline: Curve) -> Curve | None:
    """The leg laid along its taut path, else the spline if it can be driven."""
    row = problem.shortest_row.with_leg(leg, spline.taut_path)
    spline_path = problem.turns_along(row.taut_paths)
    if spline_path is not None:
        return _curve(problem, leg, gentler_path(problem, spline_path) or spline_path)
    if not problem.is_drivable(spline.spans[:, :, :2]):
        return None
    stands = problem.legs[leg].stands
    cost = measure_body(spline.spans, problem.world, problem.requirements, stands)
    return replace(spline, measured=cost)


def _curve(problem: DrivenProblem, leg: int, spline_path: SplinePath) -> Curve:
    """A leg of a path that was laid."""
    spans = spline_path.leg(leg)
    stands = problem.legs[leg].stands
    cost = measure_body(spans, problem.world, problem.requirements, stands)
    vias, whole = spline_path.detours(leg), problem.cost(spline_path)
    return Curve(_path_along(spans), vias, spans, cost, whole)


def _reason(requirements: Requirements, refused: Sequence[str]) -> str | None:
    """Why one of the sides has no curve, if there would be a way for a point."""
    sides = [side for side in SIDES if side in refused]
    if not sides:
        return None
    body, circle = requirements.footprint, requirements.turn_radius
    what = "the body" if circle is None else f"with turns of {circle:.3g} m the body"
    if body is None:
        what = f"with turns of {circle:.3g} m the robot"
    return f"{what} comes too close on the {sides[-1]}"


def _path_along(spans: Floats) -> TautPath:
    """A curve as a taut path, to tell the sides on which it passes what it meets."""
    curve = PiecewiseCubic(spans)
    places = curve.evaluate(np.linspace(*curve.domain, SAMPLES_PER_SPAN * len(spans) + 1))
    corners = np.zeros((len(places), 8))
    corners[:, :2] = places[:, :2]
    return TautPath(corners, np.empty((0, 6)), curve.length)
