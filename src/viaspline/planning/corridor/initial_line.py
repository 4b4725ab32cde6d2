"""The line with which a corridor's own begins: along the middle, led round what stands there.

Tested through ``planning/corridor/test_corridor_planner``.
"""

from __future__ import annotations

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import NoPathError
from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.spline_spec import SplineSpec
from viaspline.mission.strip import Strip, rings_of
from viaspline.planning.checking.conflicts import CLEAR, too_close
from viaspline.planning.corridor.line_in_strip import SPAN_WIDTHS, Line
from viaspline.planning.corridor.strip_problem import StripProblem
from viaspline.planning.methods.clear_spline import ClearSpline
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import Leg, RouteVia, ViaSequence
from viaspline.planning.routing.path_problem import PathProblem
from viaspline.world.world import World


def seed(problem: StripProblem, world: World) -> Line:
    """The line along the middle of a strip, led round what stands there.

    Raises:
        NoPathError: When there is no way round it.
    """
    strip = problem.strip
    first, last = problem.gates[0], problem.gates[-1]
    middle = 0.5 * (strip.left + strip.right)
    if strip.closed:
        rows = (first.row + np.arange(len(middle))) % len(middle)
        points = middle[rows]
    else:
        rows = np.arange(first.row, last.row + 1)
        if rows.size < 3:
            rows = np.array([first.row, last.row])
        points = middle[rows].copy()
        points[0], points[-1] = first.place, last.place
    line = Line.through(points, rows, problem)
    if problem.obstacles is None:
        return line
    close = np.flatnonzero(too_close(problem.obstacles, line.spans, problem.margin) != CLEAR)
    if not close.size:
        return line
    where = line.knots.matrix(close.astype(np.float64) + 0.5) @ line.controls
    away = np.linalg.norm(points - where[:, None], axis=2)
    points = _led_round(points, rows, away.argmin(axis=1), problem, world)
    return Line.through(points, strip.track(points, int(rows[0]), problem.window), problem)


def _led_round(
    points: Floats, rows: Ints, close: Ints, problem: StripProblem, world: World
) -> Floats:
    """The points of a path through a strip that is free of what stands in it.

    Only pieces of the strip are searched, so that no way goes the wrong way round.

    Args:
        points: Along the middle [m], (k, 2).
        rows: Their rows.
        close: Indices of points next to which something stands.
        problem: What the line keeps.
        world: The known world.
    """
    closed = problem.strip.closed
    if closed:
        points = np.vstack((problem.gates[0].place, points[1:], problem.gates[0].place))
        rows = np.append(rows, rows[0])
    reach = np.zeros(len(points), np.bool_)
    for index in close.tolist():
        reach[max(index - problem.window, 0) : index + problem.window + 1] = True
    edges = np.flatnonzero(np.diff(np.r_[False, reach, False].astype(int))).reshape(-1, 2)
    pieces: list[Floats] = []
    done = 0
    for first, end in edges.tolist():
        taut_path = _piece_led_round(
            points[first:end], problem.strip.piece(rows[first:end]), problem, world
        )
        pieces += [points[done:first], taut_path]
        done = end
    found = np.vstack([*pieces, points[done:]])
    return found[:-1] if closed else found


def _piece_led_round(points: Floats, piece: Strip, problem: StripProblem, world: World) -> Floats:
    """The points of a path along a piece of the strip, from the first point to the last."""
    local = World(
        world.obstacles, bounds=world.bounds, fences=world.fences, corridor=rings_of(piece.area)
    )
    free = local.distance(points) > problem.margin + 0.1 * SPAN_WIDTHS * problem.width
    free[[0, -1]] = True
    vias = tuple(RouteVia("the corridor", place, None) for place in points[free])
    legs = tuple(Leg.straight(0.5, 2) for _ in vias[1:])
    requirements = Requirements(radius=0.0, clearance=problem.margin)
    asked = PathProblem.of(ViaSequence(vias, legs, SplineSpec()), local, requirements)
    try:
        spans = ClearSpline().lay(asked).spline_path.spans
    except NoPathError as error:
        raise NoPathError(
            f"the corridor is blocked: {error.reason}", where=error.where, remedy=error.remedy,
            obstacles=error.obstacles,
        ) from error  # fmt: skip
    return PiecewiseCubic(spans).sample(0.5 * SPAN_WIDTHS * problem.width)[2]
