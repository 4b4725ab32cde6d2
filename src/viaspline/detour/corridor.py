"""From a corridor with a line of its own to a proven path inside of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.certificate import SPARE, certify
from viaspline.curve.path import GUIDE, Path, PathVia, ViaKind
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.detour.body import proven as prove_body
from viaspline.detour.brief import Brief
from viaspline.detour.course import Course, Leg, RouteVia, course_of
from viaspline.detour.detoured import Detoured
from viaspline.detour.fit import CLEAR, too_close
from viaspline.detour.raceline import PER_SPAN, SHARE, Gate, Line, Task, fixed, improved, settled
from viaspline.detour.search import lay_clear
from viaspline.errors import NoPathError
from viaspline.kernels.clearance import tightest
from viaspline.mission.model import Mission
from viaspline.mission.parts import SplineSpec
from viaspline.mission.strip import Strip, rings_of, strip_of
from viaspline.world.world import World

Floats = NDArray[np.float64]
Rows = NDArray[np.int64]

PROOFS = 25  # times that a line is moved away from where the proof fails
FINER = 1e-4  # to which it is known by how much it fails [m]
BEYOND = 1.2  # times as far as it fails a line is moved away
GUIDED = 4  # spans from guide to guide: re-plans under way come back to the line at one of them
AT_JOINT = 1e-9  # a gate so near to a joint lies on it, as a parameter
ROUNDER = 0.999  # of the curvature that is allowed is what a line is held to


@dataclass(frozen=True, eq=False)
class StripLine:
    """A line inside a strip.

    Attributes:
        spans: Bézier control polygons [m], (m, 4, 2); of a closed strip the last ends where the
            first starts, at the first place.
        at: Parameters of the places that it runs through, whole numbers, (k,).
    """

    spans: Floats
    at: Rows


def line_through(
    strip: Strip,
    margin: float,
    *,
    places: Sequence[tuple[float, float]],
    directions: Sequence[Floats | None] | None = None,
    world: World | None = None,
    max_curvature: float | None = None,
) -> StripLine:
    """The line of least curvature in a strip, through places, proven to keep a margin.

    Args:
        strip: Where it lies.
        margin: What it keeps from the edges, and from what stands in the strip [m].
        places: Where it runs through, in the order of driving [m], (k, 2): at least its start;
            the start and the end of an open line.
        directions: Unit vectors in which it runs there, each (2,) or None.
        world: What it is proven against, the corridor itself among it; None: the strip alone.
        max_curvature: [1/m]; None: no limit.

    Raises:
        NoPathError: When there is no such line, naming the place.

    Example:
        >>> strip = Strip.of_rows([[0, 0, 3, 3], [20, 0, 3, 3], [40, 10, 3, 3]], closed=False)
        >>> laid = line_through(strip, 1.0, places=[(0, 0), (40, 10)])
        >>> laid.spans[0, 0].tolist(), laid.spans[-1, 3].tolist()
        ([0.0, 0.0], [40.0, 10.0])
        >>> laid.at.tolist() == [0, len(laid.spans)]
        True
    """
    if world is None:
        world = World(corridor=rings_of(strip.area))
    strip = strip.finer(SHARE * float(np.median(strip.widths)))
    _refuse_narrow(strip, margin)
    rows = [int(strip.nearest_row(place)) for place in places]
    aims = directions or [None] * len(rows)
    gates = tuple(
        Gate(np.array(place, np.float64), row, aim)
        for place, row, aim in zip(places, rows, aims, strict=True)
    )
    others = None
    if world.obstacles or world.bounds is not None or world.fences:
        others = World(world.obstacles, bounds=world.bounds, fences=world.fences)
    limit = None if max_curvature is None else ROUNDER * max_curvature
    task = Task(strip, margin, others, gates, limit)
    line = proven(settled(_seed(task, world), task), task, world)
    laid = _split(line, task)
    if max_curvature is not None:
        _refuse_sharp(laid, max_curvature)
    return laid


def find_line(mission: Mission, world: World, brief: Brief) -> Detoured:
    """A proven path along a mission's corridor.

    Raises:
        NoPathError: When there is none: the corridor is too narrow, or blocked, or its bends are
            too sharp; the place is named.
    """
    strip = strip_of(mission.route)
    assert strip is not None
    course = course_of(mission.model_copy(update={"spline": SplineSpec()}))
    _refuse_disorder(course, strip)
    aims: list[Floats | None] = [None] * len(course.vias)
    aims[0] = course.start_tangent
    if not course.closed:
        aims[-1] = course.end_tangent
    for margin in _margins(brief):
        laid = line_through(
            strip, margin, places=[(via.at[0], via.at[1]) for via in course.vias],
            directions=aims, world=world,
            max_curvature=None if brief.turn_radius is None else 1.0 / brief.turn_radius,
        )  # fmt: skip
        path = Path(laid.spans, _path_vias(course, laid))
        certificate = prove_body(path, world, brief)
        if certificate.holds:
            break
    else:
        raise _no_room(certificate.tightest_at, certificate.clearance, brief.kept, strip)
    return Detoured(path, certificate, None)


def _margins(brief: Brief) -> Floats:
    """What the reference point may have to keep: more for a body that is no disc."""
    if brief.footprint is None:
        return np.array([brief.required])
    outer = max(math.hypot(x, y) for x, y in brief.footprint)
    return brief.required + np.array([0.0, 0.25, 0.5, 1.0]) * (outer - brief.radius)


def proven(line: Line, task: Task, world: World) -> Line:
    """The line moved away from where it comes too close, until none of its spans does.

    Raises:
        NoPathError: When that can't be had.
    """
    for _ in range(PROOFS):
        line = fixed(line, task)
        spans = line.spans
        close = np.flatnonzero(too_close(world, spans, task.margin) != CLEAR)
        if not close.size:
            return line
        extra = line.extra.copy()
        for span in close.tolist():
            lower = tightest(world.packed, spans[span : span + 1], FINER)[0]
            at = np.arange(PER_SPAN * span, PER_SPAN * (span + 1) + 1)
            at = at % extra.size if line.knots.closed else at
            extra[at] += BEYOND * max(task.margin - lower, 0.0) + FINER
        for _ in range(2):
            line, _ = improved(replace(line, extra=extra), task)
    certificate = certify(PiecewiseCubic(line.spans), world, task.margin)
    raise _no_room(certificate.tightest_at, certificate.clearance, task.margin, task.strip)


def _seed(task: Task, world: World) -> Line:
    """The line along the middle of a strip, led round what stands there."""
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


def _led_round(points: Floats, rows: Rows, close: Rows, task: Task, world: World) -> Floats:
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
        way = _way(points[first:end], task.strip.piece(rows[first:end]), task, world)
        pieces += [points[done:first], way]
        done = end
    found = np.vstack([*pieces, points[done:]])
    return found[:-1] if closed else found


def _way(points: Floats, piece: Strip, task: Task, world: World) -> Floats:
    """The points of a way along a piece of the strip, from the first of some points to the last."""
    local = World(
        world.obstacles, bounds=world.bounds, fences=world.fences, corridor=rings_of(piece.area)
    )
    free = local.distance(points) > task.margin + 0.1 * SHARE * task.width
    free[[0, -1]] = True
    vias = tuple(RouteVia("the corridor", place, None) for place in points[free])
    legs = tuple(Leg.straight(0.5, 2) for _ in vias[1:])
    brief = Brief(radius=0.0, clearance=task.margin)
    try:
        spans = lay_clear(Course(vias, legs, SplineSpec()), local, brief)[0].spans
    except NoPathError as error:
        raise NoPathError(
            f"the corridor is blocked: {error.reason}", where=error.where, remedy=error.remedy,
            obstacles=error.obstacles,
        ) from error  # fmt: skip
    return PiecewiseCubic(spans).sample(0.5 * SHARE * task.width)[2]


def _split(line: Line, task: Task) -> StripLine:
    """The spans of a line with joints at its gates, from the first gate on."""
    count = line.knots.count
    at = line.at.copy()
    if line.knots.closed:
        laps = (at - at[0]) % count
        laps[0] = 0.0
    else:
        laps = at
    if (np.diff(laps) <= 0.0).any():
        k = int(np.flatnonzero(np.diff(laps) <= 0.0)[0]) + 1
        raise NoPathError(
            "the corridor's line can't serve its places in their order",
            where=task.gates[k].place, remedy="move them apart along the corridor",
        )  # fmt: skip
    spans = list(line.spans)
    joints = np.empty(at.size, np.int64)
    for k in np.argsort(at)[::-1].tolist():  # from behind, so that those before keep their index
        span = min(int(at[k]), count - 1)
        w = at[k] - span
        if AT_JOINT < w < 1.0 - AT_JOINT:
            spans[span : span + 1] = _halves(spans[span], w)
            joints[at > at[k]] += 1
            joints[k] = span + 1
        else:
            joints[k] = span + round(w)
    whole = np.array(spans)
    if line.knots.closed:
        whole = np.roll(whole, -joints[0], axis=0)
        joints = (joints - joints[0]) % len(whole)
    for gate, joint in zip(task.gates, joints.tolist(), strict=True):
        if joint > 0 or line.knots.closed:
            whole[joint - 1, 3] = gate.place
        if joint < len(whole):
            whole[joint, 0] = gate.place
    return StripLine(whole, joints)


def _halves(span: Floats, w: float) -> tuple[Floats, Floats]:
    """A cubic cut in two, by de Casteljau."""
    rows = [span]
    for _ in range(3):
        rows.append((1.0 - w) * rows[-1][:-1] + w * rows[-1][1:])
    left = np.array([row[0] for row in rows])
    right = np.array([row[-1] for row in rows[::-1]])
    return left, right


def _path_vias(course: Course, laid: StripLine) -> tuple[PathVia, ...]:
    """The points of the route on the line, and guides between them."""
    kind: ViaKind = "user"
    vias = [
        PathVia(
            via.name, (float(via.at[0]), float(via.at[1])), kind, float(u), via.dwell, via.index
        )
        for via, u in zip(course.vias, laid.at.tolist(), strict=True)
    ]
    if course.closed:
        vias.append(replace(vias[0], u=float(len(laid.spans)), index=len(course.vias)))
    taken = {via.u for via in vias}
    vias += [
        PathVia(GUIDE, tuple(laid.spans[u, 0].tolist()), "detour", float(u))
        for u in range(GUIDED, len(laid.spans), GUIDED)
        if float(u) not in taken
    ]
    return tuple(sorted(vias, key=lambda via: via.u))


def _refuse_disorder(course: Course, strip: Strip) -> None:
    rows = np.array([strip.nearest_row(via.at[:2]) for via in course.vias])
    if strip.closed:
        rows = (rows - rows[0]) % len(strip.middle)
    for k in np.flatnonzero(np.diff(strip.along[rows]) < 0.0).tolist():
        before, via = course.vias[k], course.vias[k + 1]
        raise NoPathError(
            f"{via.name!r} lies before {before.name!r} along the corridor", where=via.at[:2],
            remedy="give the points of the route in the direction of the corridor's line",
            via=via.name,
        )  # fmt: skip


def _refuse_narrow(strip: Strip, margin: float) -> None:
    row = int(strip.widths.argmin())
    if strip.widths[row] < 2.0 * (margin - SPARE):
        where = 0.5 * (strip.left[row] + strip.right[row])
        raise _no_room(where, 0.5 * float(strip.widths[row]), margin, strip)


def _no_room(
    where: Sequence[float] | Floats, half: float, margin: float, strip: Strip
) -> NoPathError:
    """The error of a place where the line can't keep its margin."""
    wide = float(strip.widths[strip.nearest_row(where)])
    if wide < 2.0 * margin:
        reason = f"the corridor is {wide:.3g} m wide, and the robot needs {2 * margin:.3g} m"
    else:
        reason = (
            f"the corridor's bend leaves {max(half, 0.0):.3g} m to the nearer edge, and the robot "
            f"needs {margin:.3g} m"
        )
    remedy = f"widen it there by {2.0 * (margin - half):.3g} m, or make robot.clearance_m smaller"
    return NoPathError(reason, where=where, remedy=remedy, obstacles=("corridor",))


def _refuse_sharp(laid: StripLine, max_curvature: float) -> None:
    curve = PiecewiseCubic(laid.spans)
    sharpest, u = curve.max_curvature()
    if sharpest > max_curvature * (1.0 + 1e-9):
        raise NoPathError(
            f"the corridor bends so sharply that the robot needs a turning circle of radius "
            f"{1.0 / sharpest:.3g} m, and its own has {1.0 / max_curvature:.3g} m",
            where=np.asarray(curve.evaluate(u)), remedy="widen the corridor there",
            obstacles=("corridor",),
        )  # fmt: skip
