"""A path that bends less than lines and turns, where a part of the time buys that."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.curve.measure import bending
from viaspline.planning.checking.driving_time import driving_time
from viaspline.planning.problem.path_pace import Pace
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.work_budget import STRIP_BODY_SPAN_S, STRIP_S, STRIP_SPAN_S
from viaspline.planning.turning.bendable_run import BendableRun, LaidRun, RunsOfPath
from viaspline.planning.turning.driven_price import DrivenPrice
from viaspline.planning.turning.driven_problem import DrivenProblem
from viaspline.planning.turning.gentle_strip import gentle_strips
from viaspline.planning.turning.laid_turns import through_spans
from viaspline.planning.turning.lane_turns import BESIDE_LANE
from viaspline.planning.turning.strip_body import strip_bodies
from viaspline.planning.turning.tension_search import GENTLE_SHARE, TIME_KNOWN, RunPrice

LEAST_RUN = 4.0  # of a run that has room to bend less, in required distances
STRAIGHT = 1e-9  # bending times length, of what need not bend less
SHARPER = 1e-3  # by which a path is no sharper yet: as well as that is known
STRAIGHT_SPAN = 1e-7  # by which a straight one's controls are off, in required distances


def gentler_path(problem: DrivenProblem, laid: SplinePath) -> SplinePath | None:
    """A clear path on the same sides that bends less; None where there is none.

    That is for a path that is chosen by time. Lines between via points that it keeps to stay as
    they are, and so do headings that are given, and those at ends where a body has no room for
    another. No turn becomes sharper that the robot has to slow down for, unless that is sooner, nor
    sharper than the robot itself.

    Args:
        problem: What is to be driven.
        laid: A path that serves it.
    """
    if not _may_be_bent(problem):
        return None
    path = _in_runs(problem, laid)
    least = DrivenPrice(problem).least(problem.shortest_row) if len(path.runs) == 1 else None
    bent = [None if run.stays else _gentler_run(problem, run, least) for run in path.runs]
    if all(one is None for one in bent):
        return None
    whole = path.joined([one or run.laid for one, run in zip(bent, path.runs, strict=True)])
    found = through_spans(
        problem.sequence, whole.spans, whole.joints, whole.detours.tolist()
    )  # fmt: skip
    latest = (1.0 + GENTLE_SHARE + TIME_KNOWN) * problem.cost(laid)
    if not problem.keeps_sides(found) or problem.cost(found) > latest:
        return None
    return found


def _may_be_bent(problem: DrivenProblem) -> bool:
    needs, sequence = problem.requirements, problem.sequence
    if not needs.objective.is_time or needs.has_own_tension:
        return False
    has_headings = sequence.start_tangent is not None or sequence.end_tangent is not None
    return needs.budget is None or not has_headings  # under way there is no time for it


def _in_runs(problem: DrivenProblem, laid: SplinePath) -> RunsOfPath:
    """A path in the runs that may be bent each by itself, without heights."""
    sequence, at_vias = problem.sequence, set(laid.joints.tolist())
    detours = [int(via.u) for via in laid.vias if via.u not in at_vias]
    planar = LaidRun(
        np.ascontiguousarray(laid.spans[:, :, :2]), laid.joints, np.array(detours, np.int64)
    )
    stands = np.array([sequence.stands(k) for k in range(len(laid.joints))])
    given = (
        sequence.start_tangent is not None or not _may_turn(problem, planar.spans[0, 0]),
        sequence.end_tangent is not None or not _may_turn(problem, planar.spans[-1, 3]),
    )
    return RunsOfPath.of(planar, _on_lanes(problem, laid), stands, given, sequence.closed)


def _may_turn(problem: DrivenProblem, place: Floats) -> bool:
    """Whether the body keeps clear at a place in whichever direction it stands."""
    needs = problem.requirements
    return needs.footprint is None or bool(problem.world.distance(place) >= needs.around)


def _on_lanes(problem: DrivenProblem, laid: SplinePath) -> Flags:
    """Which spans of a path lie straight on the lines that their legs are to keep to, (m,)."""
    found: Flags = np.zeros(len(laid.spans), np.bool_)
    required = problem.requirements.required
    for leg, lane in enumerate(problem.kept_lanes.lines):
        if lane is not None:
            left = lane.seen(laid.leg(leg))[..., 1]
            is_beside = np.abs(left).max(axis=1) < BESIDE_LANE * required
            bend = np.abs(np.diff(left, 2, axis=1)).max(axis=1)
            first, last = laid.joints[leg], laid.joints[leg + 1]
            found[first:last] = is_beside & (bend < STRAIGHT_SPAN * required)
    return found


def _gentler_run(problem: DrivenProblem, run: BendableRun, least: float | None) -> LaidRun | None:
    """A run bent less; None where it can't be.

    Args:
        problem: What is to be driven.
        run: The run.
        least: The least time in which it can be driven [s], if that is known.
    """
    is_short = run.length < LEAST_RUN * problem.requirements.required
    curved = bending(run.laid.spans)
    if is_short or curved[0] * run.length < STRAIGHT:
        return None
    price = _price_of(problem, run, curved, least)
    for bent in _strips(run, problem, price):
        peak = bending(bent.spans)[1]
        is_round = peak * problem.requirements.outer_radius <= 1.0
        is_taken = peak <= price.sharp or (is_round and price.is_sooner(bent.spans, bent.joints))
        if is_taken and problem.is_drivable(bent.spans):
            return bent
    return None


def _price_of(
    problem: DrivenProblem, run: BendableRun, curved: tuple[float, float], least: float | None
) -> RunPrice:
    """What a run may be exchanged for; see ``_gentler_run``, and ``bending`` for *curved*."""
    needs = problem.requirements
    pace, stands = needs.objective.pace, run.stands

    def time(spans: Floats, joints: Ints) -> float:
        rests = np.zeros(len(spans) + 1, np.bool_)
        rests[joints] = stands
        return driving_time(spans, pace, rests)

    before, sharpest = curved
    least_radius = max(pace.widest_radius, (1.0 + SHARPER) * needs.outer_radius)
    fast = 1.0 / least_radius if pace.widest_radius > 0.0 else 0.0
    as_sharp = (1.0 + SHARPER) * max(sharpest, fast)
    own = max(needs.outer_radius, needs.turn_radius or 0.0)
    pointed, limit = pace.slowing, max(as_sharp, 1.0 / own if own > 0.0 else np.inf)
    now = time(run.laid.spans, run.laid.joints)
    if needs.budget is not None:  # under way there is no time for more than bending it less
        pointed = limit = np.inf
    if least is None:
        is_under_way = needs.budget is not None
        least = now / (1.0 + GENTLE_SHARE) if is_under_way else _least_time(run, pace)
    return RunPrice(
        time_of=time,
        time=now,
        bending=before,
        least=least,
        slowing=pace.slowing,
        pointed=pointed,
        sharp=as_sharp,
        limit=limit,
    )


def _least_time(run: BendableRun, pace: Pace) -> float:
    """The time along straight lines through a run's via points and detours [s]."""
    laid = run.laid
    at = np.union1d(laid.joints, laid.detours)
    places = np.concatenate((laid.spans[:, 0], laid.spans[-1:, 3]))[at]
    lengths = np.linalg.norm(np.diff(places, axis=0), axis=1)
    return float(lengths.sum()) / pace.speed


def _strips(run: BendableRun, problem: DrivenProblem, price: RunPrice) -> Iterator[LaidRun]:
    """The strips in the place of a run, by what is kept beside them: the usual first."""
    needs = problem.requirements
    each = STRIP_SPAN_S if needs.footprint is None else STRIP_BODY_SPAN_S
    for body in strip_bodies(needs, run.length):
        needs.spend(STRIP_S + each * len(run.laid.spans))
        yield from gentle_strips(run, problem.world, body, price)
