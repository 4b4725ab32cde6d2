"""From a corridor with a line of its own to a proven path inside of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from viaspline.curve.certificate import certify
from viaspline.curve.path import GUIDE, Path, PathVia, ViaKind
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.disc import STILL, tightest
from viaspline.mission.model import Mission
from viaspline.mission.spline_spec import SplineSpec
from viaspline.mission.strip import Strip, rings_of, strip_of
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import CLEAR, too_close
from viaspline.planning.checking.conflicts import proven as prove_body
from viaspline.planning.corridor.corridor_refusals import (
    no_room,
    refuse_disorder,
    refuse_narrow,
    refuse_sharp,
)
from viaspline.planning.corridor.initial_line import seed
from viaspline.planning.corridor.line_in_strip import SAMPLES_PER_SPAN, SPAN_WIDTHS, Line
from viaspline.planning.corridor.minimum_curvature import fixed, improved, settled
from viaspline.planning.corridor.side_walls import with_side_walls
from viaspline.planning.corridor.strip_line import StripLine, split
from viaspline.planning.corridor.strip_problem import Gate, StripProblem
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import ViaSequence, via_sequence_of
from viaspline.world.world import World

MAX_PROOF_ROUNDS = 25  # times that a line is moved away from where the proof fails
FAILURE_TOLERANCE_M = 1e-4  # to which it is known by how much it fails
MOVE_FACTOR = 1.2  # times as far as it fails a line is moved away
SPANS_PER_GUIDE = 4  # re-plans under way come back to the line at one of the guides
CURVATURE_PART = 0.999  # of the curvature that is allowed, to which a line is held


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
    strip = strip.finer(SPAN_WIDTHS * float(np.median(strip.widths)))
    refuse_narrow(strip, margin)
    rows = [int(strip.nearest_row(place)) for place in places]
    aims = directions or [None] * len(rows)
    gates = tuple(
        Gate(np.array(place, np.float64), row, aim)
        for place, row, aim in zip(places, rows, aims, strict=True)
    )
    others = None
    if world.obstacles or world.bounds is not None or world.fences:
        others = World(world.obstacles, bounds=world.bounds, fences=world.fences)
    limit = None if max_curvature is None else CURVATURE_PART * max_curvature
    problem = StripProblem(strip, margin, others, gates, limit)
    line = proven(settled(seed(problem, world), problem), problem, world)
    spline_path = split(line, problem)
    if max_curvature is not None:
        refuse_sharp(spline_path, max_curvature)
    return spline_path


def find_line(mission: Mission, world: World, requirements: Requirements) -> Solution:
    """A proven path along a mission's corridor.

    Raises:
        NoPathError: When there is none: the corridor is too narrow, or blocked, or its bends are
            too sharp; the place is named.
    """
    strip = strip_of(mission.route)
    assert strip is not None
    sequence = via_sequence_of(mission.model_copy(update={"spline": SplineSpec()}))
    refuse_disorder(sequence, strip)
    aims: list[Floats | None] = [None] * len(sequence.vias)
    aims[0] = sequence.start_tangent
    if not sequence.closed:
        aims[-1] = sequence.end_tangent
    radius = requirements.turn_radius
    walled = with_side_walls(world, strip)
    for margin in _margins(requirements):
        spline_path = line_through(
            strip, margin, places=[(via.at[0], via.at[1]) for via in sequence.vias],
            directions=aims, world=walled,
            max_curvature=None if radius is None else 1.0 / radius,
        )  # fmt: skip
        path = Path(spline_path.spans, _path_vias(sequence, spline_path))
        certificate = prove_body(path, world, requirements)
        if certificate.holds:
            break
    else:
        raise no_room(certificate.tightest_at, certificate.clearance, requirements.kept, strip)
    return Solution(path, certificate, None)


def _margins(requirements: Requirements) -> Floats:
    """What the reference point may have to keep: more for a body that is no disc."""
    if requirements.footprint is None:
        return np.array([requirements.required])
    outer = max(math.hypot(x, y) for x, y in requirements.footprint)
    return requirements.required + np.array([0.0, 0.25, 0.5, 1.0]) * (outer - requirements.radius)


def proven(line: Line, problem: StripProblem, world: World) -> Line:
    """The line moved away from where it comes too close, until none of its spans does.

    Raises:
        NoPathError: When that can't be had.
    """
    for _ in range(MAX_PROOF_ROUNDS):
        line = fixed(line, problem)
        spans = line.spans
        close = np.flatnonzero(too_close(world, spans, problem.margin) != CLEAR)
        if not close.size:
            return line
        extra = line.extra.copy()
        for span in close.tolist():
            lower = tightest(world.packed, spans[span : span + 1], STILL, FAILURE_TOLERANCE_M)[0]
            at = np.arange(SAMPLES_PER_SPAN * span, SAMPLES_PER_SPAN * (span + 1) + 1)
            at = at % extra.size if line.knots.closed else at
            extra[at] += MOVE_FACTOR * max(problem.margin - lower, 0.0) + FAILURE_TOLERANCE_M
        for _ in range(2):
            line, _ = improved(replace(line, extra=extra), problem)
    certificate = certify(PiecewiseCubic(line.spans), world, problem.margin)
    raise no_room(certificate.tightest_at, certificate.clearance, problem.margin, problem.strip)


def _path_vias(sequence: ViaSequence, spline_path: StripLine) -> tuple[PathVia, ...]:
    """The points of the route on the line, and guides between them."""
    kind: ViaKind = "user"
    vias = [
        PathVia(
            via.name, (float(via.at[0]), float(via.at[1])), kind, float(u), via.dwell, via.index
        )
        for via, u in zip(sequence.vias, spline_path.at.tolist(), strict=True)
    ]
    if sequence.closed:
        vias.append(replace(vias[0], u=float(len(spline_path.spans)), index=len(sequence.vias)))
    taken = {via.u for via in vias}
    vias += [
        PathVia(GUIDE, tuple(spline_path.spans[u, 0].tolist()), "detour", float(u))
        for u in range(SPANS_PER_GUIDE, len(spline_path.spans), SPANS_PER_GUIDE)
        if float(u) not in taken
    ]
    return tuple(sorted(vias, key=lambda via: via.u))
