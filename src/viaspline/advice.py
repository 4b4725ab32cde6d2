"""What each span's tension does to length, clearance, curvature and time, and which to take."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.handed_in import check_kind, numbers_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.disc import STILL, tightest
from viaspline.kernels.curve.measure import length_and_curvature
from viaspline.machine.machine_limits import limits_of
from viaspline.mission.model import Mission
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import Leg, ViaSequence, lay, via_sequence_of
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.world.world import World

TRIED_TENSIONS = (-0.5, -0.3, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95)
MAX_TIME_SHARE = 0.02  # part of a span's time that may be spent on a rounder curve
CLEARANCE_TOLERANCE_M = 1e-3  # of a clearance [m]


@dataclass(frozen=True, eq=False)
class TensionAdvice:
    """What tensions do, before any detour, and which are suggested.

    A span's tension changes that span alone: the curve and its tangents' directions elsewhere
    stay. Only the time depends on its neighbours; it is that of the whole drive, from rest to rest
    with its stations, when this one span is changed and all others have the best common tension.

    Suggested is, span by span, of all tensions whose clearance holds and whose bends are no
    sharper than the turning circle, the one with the gentlest peak curvature among those that cost
    no more than 2 % of the span's time over the fastest; the shorter one of equals. Where no
    tension has the clearance a detour is needed, and the clearance is left out; where none keeps
    the turning circle, the roundest is taken. If all suggestions together are slower than the best
    common tension by more than that, the common one is suggested throughout.

    Attributes:
        spans: The via points before and after each span, m of them.
        tensions: Eq. (7)'s t, shape (n,).
        lengths: [m], shape (m, n).
        clearances: Proven distance between the body and everything known [m], shape (m, n);
            infinite when there is nothing.
        curvatures: Proven peak [1/m], shape (m, n).
        durations: Of the whole drive [s], shape (m, n).
        common: The same for all spans at once: lengths, clearances, curvatures and durations,
            shape (4, n).
        best: The best tension for all spans at once.
        suggested: A tension for each span, shape (m,).
        duration: Of the drive with what is suggested [s].
        required: Clearance that was asked for [m].
        turn_radius: Of the tightest circle that the robot can drive [m]; None: no limit.
    """

    spans: tuple[tuple[str, str], ...]
    tensions: Floats
    lengths: Floats
    clearances: Floats
    curvatures: Floats
    durations: Floats
    common: Floats
    best: float
    suggested: Floats
    duration: float
    required: float
    turn_radius: float | None


def advise_tension(
    mission: Mission, tensions: Sequence[float] = TRIED_TENSIONS, *, world: World | None = None
) -> TensionAdvice:
    """Try tensions on a mission, all spans at once and span by span.

    Args:
        mission: Whatever its own tension is.
        tensions: At most 1, in order.
        world: What the mission has on its map, if it is there already.

    Example:
        >>> mission = Mission.model_validate({
        ...     "robot": {"max_lateral_accel_mps2": 0.5},
        ...     "route": {"start": [0, 0], "via": [[30, 0], [30, 30]], "goal": [0, 30]},
        ... })
        >>> advice = advise_tension(mission)
        >>> advice.suggested.shape, bool((advice.curvatures[:, 0] < advice.curvatures[:, -1]).all())
        ((3,), True)
    """
    check_kind("mission", mission, Mission, "give Mission.model_validate({...}) or load(file)")
    plain = mission.spline.model_copy(update={"tension": 0.0, "slack": None})
    mission = mission.model_copy(update={"spline": plain})
    if world is not None:
        check_kind("world", world, World, "give World(obstacles)")
    world = World.known(mission) if world is None else world
    sequence, requirements = via_sequence_of(mission), Requirements.of(mission)
    limits = limits_of(mission.robot)
    tried = np.array(numbers_from("tensions", tensions))
    if tried.ndim != 1 or not tried.size or not np.isfinite(tried).all():
        raise GeometryError(f"tensions have shape {tried.shape}; give a list of finite numbers")
    curves = np.array([_laid(sequence, np.full(len(sequence.legs), t)) for t in tried])
    grouped = curves.reshape(len(tried), len(sequence.legs), sequence.pieces, *curves.shape[2:])
    table = np.array([[_measured(span, world, requirements) for span in row] for row in grouped])
    lengths, clearances, curvatures = table.transpose(2, 1, 0)
    times = np.array([_duration(sequence, row, limits) for row in grouped])
    common = np.vstack((lengths.sum(0), clearances.min(0), curvatures.max(0), times))
    best = _choice(common, MAX_TIME_SHARE * times.min(), requirements)
    durations = np.empty_like(lengths)
    for k in range(len(lengths)):
        for j in range(len(tried)):
            changed = grouped[best].copy()
            changed[k] = grouped[j, k]
            durations[k, j] = times[best] if j == best else _duration(sequence, changed, limits)
    shares = lengths[:, best] / lengths[:, best].sum()
    chosen = np.array([
        _choice(
            np.vstack((lengths[k], clearances[k], curvatures[k], durations[k])),
            MAX_TIME_SHARE * share * times[best], requirements,
        )
        for k, share in enumerate(shares)
    ])  # fmt: skip
    together = _duration(sequence, grouped[chosen, np.arange(len(chosen))], limits)
    if together > (1.0 + MAX_TIME_SHARE) * times[best]:
        chosen, together = np.full(len(chosen), best), float(times[best])
    return TensionAdvice(
        spans=tuple((a.name, b.name) for a, b in map(sequence.ends, range(len(sequence.legs)))),
        tensions=tried, lengths=lengths, clearances=clearances, curvatures=curvatures,
        durations=durations, common=common, best=float(tried[best]), suggested=tried[chosen],
        duration=together, required=requirements.kept, turn_radius=requirements.turn_radius,
    )  # fmt: skip


def with_advice(mission: Mission, world: World) -> Mission:
    """The mission with numbers where its tension is ``auto``.

    Args:
        mission: What is asked for.
        world: What it has on its map.
    """
    if mission.spline.tension != "auto":
        return mission
    corridor = mission.route.corridor
    if corridor is not None and corridor.line is not None:
        tension: float | tuple[float, ...] = 0.0  # the corridor's line has no tension
    else:
        tension = tuple(advise_tension(mission, world=world).suggested.tolist())
    spline = mission.spline.model_copy(update={"tension": tension})
    return mission.model_copy(update={"spline": spline})


def _laid(sequence: ViaSequence, tensions: Floats) -> Floats:
    legs = tuple(
        Leg(leg.points, np.full_like(leg.slack, (1.0 - t) / 2.0))
        for leg, t in zip(sequence.legs, tensions.tolist(), strict=True)
    )
    return lay(replace(sequence, legs=legs))


def _measured(span: Floats, world: World, requirements: Requirements) -> tuple[float, float, float]:
    """Length, proven clearance of the body and peak curvature of a span's cubics."""
    span = np.ascontiguousarray(span)
    lower, upper = tightest(world.packed, span, STILL, CLEARANCE_TOLERANCE_M)[:2]
    length, peak = length_and_curvature(span)
    gap = lower if np.isfinite(lower) else upper
    return float(length), float(gap) - requirements.radius, float(peak)


def _duration(sequence: ViaSequence, spans: Floats, limits: Limits) -> float:
    """Of the whole drive over the cubics of all spans, (m, pieces, 4, d), with its stations [s]."""
    curve = PiecewiseCubic(spans.reshape(-1, *spans.shape[2:]))
    ends = sequence.pieces * np.arange(len(spans) + 1)
    vias = [*sequence.vias, sequence.vias[0]] if sequence.closed else sequence.vias
    stops = [
        Station(float(curve.distance(float(u))), via.dwell, via.name)
        for via, u in zip(vias, ends, strict=True)
        if via.dwell > 0.0
    ]
    return retime(curve, limits, stops).duration


def _choice(rows: Floats, spare: float, requirements: Requirements) -> int:
    """Which tension is suggested: see ``TensionAdvice``."""
    length, clearance, curvature, duration = rows
    allowed = clearance >= requirements.kept - PROOF_SLACK_M
    if not allowed.any():
        allowed = np.ones(length.size, np.bool_)
    if requirements.turn_radius is not None:
        round_enough = allowed & (curvature <= 1.0 / requirements.turn_radius)
        if not round_enough.any():
            return int(np.where(allowed, curvature, np.inf).argmin())
        allowed = round_enough
    fast = allowed & (duration <= duration[allowed].min() + spare)
    order = np.lexsort((length, np.round(curvature, 9), ~fast))
    return int(order[0])
