r"""The line of least curvature inside a strip, through given places.

The line is a cubic B-spline on equal knots, so that its curvature is continuous. Its control points
:math:`c_i` move along their normals by :math:`a_i`. With the curvature linearised in a, the sum of
:math:`\kappa^2 \mathrm{d}s` is a sum of squares, and the room to the edges of the strip and to what
stands in it is linear too: a quadratic programme with a handful of numbers in each row. Solved over
and over from where it led, in steps that are kept short, it comes to a line at which no small
change makes the curvature less.

Source: F. Braghin et al., Race driver model (2008), for the objective; A. Heilmeier et al., Minimum
curvature trajectory planning and control for an autonomous race car (2019), for solving it again
about its own result. Both move the points of an interpolating spline; control points make the
matrices sparse.

Tested through ``planning/corridor/test_corridor_planner``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.sparse import csr_array, diags_array, eye_array, vstack

from viaspline.kernels.arrays import Floats
from viaspline.planning.corridor.line_in_strip import SAMPLES_PER_SPAN, Line, samples
from viaspline.planning.corridor.quadratic_program import Programme, solve
from viaspline.planning.corridor.strip_problem import StripProblem
from viaspline.world.world import World

FINE_SAMPLES_PER_SPAN = 8  # samples a span where the line is laid through anew
MAX_STRIDE_WIDTHS = 0.25  # of the width: farthest that a control point moves at once
SETTLED_WIDTHS = 0.05  # of the width: below it the line isn't laid through equal distances again
LAST_STEP_WIDTHS = 2e-3  # of the width: such a step is the last
MAX_STEPS_OF_LINE = 40
GATE_SNAP = 5e-3  # a gate so near to a joint is moved onto it, as a parameter
ROOM_PRICE = 1.5e5  # of room that is missing
LENGTH_WEIGHT = 0.03  # what a metre is worth beside curvature, with the width as the unit
PEAK_WEIGHT = 1.0  # of the curvature's fourth power beside its square, in the same units
GRADIENT_STEP_M = 1e-5  # step of differences [m]


def settled(line: Line, task: StripProblem) -> Line:
    """The line of least curvature that is reached from a line."""
    for _ in range(MAX_STEPS_OF_LINE):
        line, moved = improved(line, task)
        if moved <= LAST_STEP_WIDTHS * task.width:
            break
        if moved > SETTLED_WIDTHS * task.width:
            at = samples(line.knots, FINE_SAMPLES_PER_SPAN)
            rows = line.rows[np.minimum((at * SAMPLES_PER_SPAN).astype(int), len(line.rows) - 1)]
            line = Line.through(line.knots.matrix(at) @ line.controls, rows, task)
    return line


def improved(line: Line, task: StripProblem) -> tuple[Line, float]:
    """One quadratic programme farther.

    Returns:
        (line, farthest that a control point was moved [m]).
    """
    at = samples(line.knots, SAMPLES_PER_SPAN)
    normals = _normals(line)
    moves = [_Moves(line.knots.matrix(at, order), line.controls, normals) for order in range(3)]
    hessian, gradient, bend_rows, bend_floors = _bending(moves, task)
    room_rows, room_floors = _rooms(line, moves[0], task)
    still = eye_array(line.knots.controls)
    stride = np.full(line.knots.controls, -MAX_STRIDE_WIDTHS * task.width)
    equal, values = _gate_rows(line, normals, task)
    answer = solve(
        Programme(
            hessian, gradient,
            csr_array(vstack([*room_rows, *bend_rows, still, -still])),
            np.concatenate([*room_floors, *bend_floors, stride, stride]),
            ROOM_PRICE / task.width**2, equal, values,
        )
    )  # fmt: skip
    moved = replace(line, controls=line.controls + answer[:, None] * normals)
    places = moves[0].matrix @ moved.controls
    moved = replace(moved, rows=task.strip.follow(places, line.rows, task.window))
    moved = replace(moved, at=moved.passing(task, places, at))
    return moved, float(np.abs(answer).max())


def fixed(line: Line, task: StripProblem) -> Line:
    """The line moved as little as possible so that it runs through its gates to the last digit."""
    if not task.gates:
        return line
    whole = np.rint(line.at)
    line = replace(line, at=np.where(np.abs(line.at - whole) < GATE_SNAP, whole, line.at))
    for _ in range(3):
        rows = line.knots.matrix(line.at).toarray()
        off = np.array([gate.place for gate in task.gates]) - rows @ line.controls
        shift = np.linalg.lstsq(rows, off, rcond=None)[0]
        line = replace(line, controls=line.controls + shift)
    return line


class _Moves:
    """How samples of a derivative change as the control points move along their normals."""

    def __init__(self, matrix: csr_array, controls: Floats, normals: Floats) -> None:
        self.matrix = matrix
        self.values: Floats = matrix @ controls
        self._x = csr_array(matrix @ diags_array(normals[:, 0]))
        self._y = csr_array(matrix @ diags_array(normals[:, 1]))

    def along(self, directions: Floats) -> csr_array:
        """The change along a direction at each sample, (k, n)."""
        return csr_array(
            diags_array(directions[:, 0]) @ self._x + diags_array(directions[:, 1]) @ self._y
        )


def _normals(line: Line) -> Floats:
    """Unit normals at the control points, to the left."""
    controls = line.controls
    if line.knots.closed:
        along = np.roll(controls, -1, axis=0) - np.roll(controls, 1, axis=0)
    else:
        along = np.gradient(controls, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    return _left_of(along)


def _left_of(vectors: Floats) -> Floats:
    """Vectors turned to the left, (k, 2)."""
    return np.column_stack((-vectors[:, 1], vectors[:, 0]))


def _bending(
    moves: Sequence[_Moves], task: StripProblem
) -> tuple[Any, Floats, list[Any], list[Floats]]:
    """The objective, and what keeps the curvature below its limit."""
    slope, bend = moves[1].values, moves[2].values
    speed = np.linalg.norm(slope, axis=1)
    turned = _left_of(slope) / speed[:, None] ** 3
    curvature = (turned * bend).sum(axis=1)
    by_slope = -_left_of(bend) / speed[:, None] ** 3
    by_slope -= 3.0 * (curvature / speed**2)[:, None] * slope
    change = moves[1].along(by_slope) + moves[2].along(turned)
    step = speed / SAMPLES_PER_SPAN
    unit = task.width
    across = moves[1].along(_left_of(slope) / speed[:, None])
    along = moves[1].along(slope / speed[:, None])
    worth = LENGTH_WEIGHT / unit**2
    sharp = PEAK_WEIGHT * (unit * curvature) ** 2
    hessian = change.T @ diags_array(step * (1.0 + 4.0 * sharp)) @ change
    hessian += across.T @ diags_array(worth / (speed * SAMPLES_PER_SPAN)) @ across
    hessian += 1e-9 / unit**3 * eye_array(hessian.shape[0])
    gradient = change.T @ (step * curvature * (1.0 + 2.0 * sharp)) + along.T @ np.full(
        step.size, worth / SAMPLES_PER_SPAN
    )
    if task.max_curvature is None:
        return hessian, gradient, [], []
    scale = unit**2
    rows = [scale * change, -scale * change]
    floors = [scale * (-task.max_curvature - curvature), scale * (curvature - task.max_curvature)]
    return hessian, gradient, rows, floors


def _rooms(line: Line, places: _Moves, task: StripProblem) -> tuple[list[Any], list[Floats]]:
    """What keeps samples away from the edges and from what stands in the strip."""
    reach = task.margin + line.extra + 1.5 * MAX_STRIDE_WIDTHS * task.width
    found = [edge.room(places.values, line.rows) for edge in task.edges]
    if task.obstacles is not None:
        found.append(_free(task.obstacles, places.values))
    rows, floors = [], []
    for distance, direction in found:
        near = np.flatnonzero(distance < reach)
        rows.append(places.along(direction)[near])
        floors.append((task.margin + line.extra - distance)[near])
    return rows, floors


def _free(world: World, places: Floats) -> tuple[Floats, Floats]:
    """Distance of places to a world and the direction in which it grows."""
    distance = world.distance(places)
    slope = np.column_stack([
        world.distance(places + step) - world.distance(places - step)
        for step in (np.array([GRADIENT_STEP_M, 0.0]), np.array([0.0, GRADIENT_STEP_M]))
    ])  # fmt: skip
    size = np.linalg.norm(slope, axis=1)
    return distance, slope / np.where(size > 0.0, size, 1.0)[:, None]


def _gate_rows(line: Line, normals: Floats, task: StripProblem) -> tuple[Any, Floats]:
    """What leads the line through its gates."""
    if not task.gates:
        return csr_array((0, line.knots.controls)), np.zeros(0)
    place = _Moves(line.knots.matrix(line.at), line.controls, normals)
    slope = _Moves(line.knots.matrix(line.at, 1), line.controls, normals)
    across = _left_of(slope.values)
    across /= np.linalg.norm(across, axis=1)[:, None]
    aims = np.array([gate.place for gate in task.gates])
    rows = [place.along(across)]
    values = [((aims - place.values) * across).sum(axis=1)]
    turned = [k for k, gate in enumerate(task.gates) if gate.direction is not None]
    if turned:
        aside = np.zeros((len(task.gates), 2))
        aside[turned] = _left_of(np.array([task.gates[k].direction for k in turned]))
        rows.append(slope.along(aside)[turned])
        values.append(-(slope.values * aside).sum(axis=1)[turned])
    return csr_array(vstack(rows)), np.concatenate(values)
