"""The line with which a corridor's own begins: along the middle, led round what stands there."""

from __future__ import annotations

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import NoPathError
from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.spline_spec import SplineSpec
from viaspline.mission.strip import Strip, rings_of
from viaspline.planning.alternatives.fit import CLEAR, too_close
from viaspline.planning.alternatives.lay_clear import lay_clear
from viaspline.planning.corridor.minimum_curvature import SHARE, Line, StripProblem
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import Leg, RouteVia, ViaSequence
from viaspline.world.world import World


def seed(task: StripProblem, world: World) -> Line:
    """The line along the middle of a strip, led round what stands there.

    Raises:
        NoPathError: When there is no way round it.
    """
    strip = task.strip
    first, last = task.gates[0], task.gates[-1]
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
    line = Line.through(points, rows, task)
    if task.obstacles is None:
        return line
    close = np.flatnonzero(too_close(task.obstacles, line.spans, task.margin) != CLEAR)
    if not close.size:
        return line
    where = line.knots.matrix(close.astype(np.float64) + 0.5) @ line.controls
    away = np.linalg.norm(points - where[:, None], axis=2)
    points = _led_round(points, rows, away.argmin(axis=1), task, world)
    return Line.through(points, strip.track(points, int(rows[0]), task.window), task)


def _led_round(points: Floats, rows: Ints, close: Ints, task: StripProblem, world: World) -> Floats:
    """The points of a way through a strip that is free of what stands in it.

    Only pieces of the strip are searched, so that no way goes the wrong way round.

    Args:
        points: Along the middle [m], (k, 2).
        rows: Their rows.
        close: Indices of points next to which something stands.
        task: What the line keeps.
        world: The known world.
    """
    closed = task.strip.closed
    if closed:
        points = np.vstack((task.gates[0].place, points[1:], task.gates[0].place))
        rows = np.append(rows, rows[0])
    reach = np.zeros(len(points), np.bool_)
    for index in close.tolist():
        reach[max(index - task.window, 0) : index + task.window + 1] = True
    edges = np.flatnonzero(np.diff(np.r_[False, reach, False].astype(int))).reshape(-1, 2)
    pieces: list[Floats] = []
    done = 0
    for first, end in edges.tolist():
        taut_path = _way(points[first:end], task.strip.piece(rows[first:end]), task, world)
        pieces += [points[done:first], taut_path]
        done = end
    found = np.vstack([*pieces, points[done:]])
    return found[:-1] if closed else found


def _way(points: Floats, piece: Strip, task: StripProblem, world: World) -> Floats:
    """The points of a way along a piece of the strip, from the first of some points to the last."""
    local = World(
        world.obstacles, bounds=world.bounds, fences=world.fences, corridor=rings_of(piece.area)
    )
    free = local.distance(points) > task.margin + 0.1 * SHARE * task.width
    free[[0, -1]] = True
    vias = tuple(RouteVia("the corridor", place, None) for place in points[free])
    legs = tuple(Leg.straight(0.5, 2) for _ in vias[1:])
    requirements = Requirements(radius=0.0, clearance=task.margin)
    try:
        spans = lay_clear(ViaSequence(vias, legs, SplineSpec()), local, requirements)[0].spans
    except NoPathError as error:
        raise NoPathError(
            f"the corridor is blocked: {error.reason}", where=error.where, remedy=error.remedy,
            obstacles=error.obstacles,
        ) from error  # fmt: skip
    return PiecewiseCubic(spans).sample(0.5 * SHARE * task.width)[2]
