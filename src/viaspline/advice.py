"""Which tension to take: whole plans with many of them, compared in time, then peak curvature."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from viaspline.errors import GeometryError, PlanningError
from viaspline.handed_in import check_kind, numbers_from
from viaspline.kernels.arrays import Floats
from viaspline.machine.measure_drivability import least_radius
from viaspline.mission.model import Mission
from viaspline.mission.spline_spec import LOOSEST_TENSION, POLYLINE_TENSION, SplineSpec
from viaspline.mission.strip import has_line
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.span_tensions import SpanTensions
from viaspline.whole_plan import Plan, in_order, whole_plan
from viaspline.world.world import World

TRIED_TENSIONS = (-0.5, -0.3, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95)
REFERENCES = (0.0, -0.5, 0.5)
"""Tensions that anybody would try by hand: advice is never worse than any of them."""
SPARE_SHARE = 1e-3
"""Part of the time that may be spent on a gentler path."""
SAME_SHARE = 1e-6
"""Part of a time or a curvature by which two plans that are the same may differ."""

Tension = float | tuple[float, ...] | None
"""One for all spans, one for each, or none stated."""


@dataclass(frozen=True, eq=False)
class TensionTrial(ComparedByValue):
    """A tension, and the whole plan with it.

    Attributes:
        tension: One for all spans, one for each; None where none is stated, and turns compete.
        plan: The plan; None if there is none.
        error: Why there is none.
    """

    tension: Tension
    plan: Plan | None
    error: PlanningError | GeometryError | None = None

    def _said(self) -> tuple[object, ...]:
        return self.tension, self.plan, str(self.error)

    def __repr__(self) -> str:
        return f"<TensionTrial: {self.tension}, {self.plan or self.error}>"

    @property
    def level(self) -> float:
        """The tension that all spans have; not a number where they differ or none is stated."""
        return self.tension if isinstance(self.tension, float) else math.nan

    @cached_property
    def cost(self) -> tuple[float, float]:
        """The time of the drive [s], and the peak curvature [1/m]; infinite without a plan."""
        if self.plan is None:
            return np.inf, np.inf
        return self.plan.trajectory.duration, self.plan.path.max_curvature()[0]

    @property
    def drives_well(self) -> bool:
        """Whether there is a plan, whose path drives well."""
        return self.plan is not None and self.plan.drivability.verdict == "good"

    def is_same_as(self, other: TensionTrial) -> bool:
        """Whether it makes no difference which of the two is driven."""
        if self.plan is None or other.plan is None:
            return self.plan is other.plan
        return bool(np.allclose(self.cost, other.cost, rtol=SAME_SHARE, atol=SAME_SHARE))


@dataclass(frozen=True, eq=False)
class TensionAdvice(ComparedByValue):
    """Which tension is suggested, and what it is compared with.

    Compared are whole plans, as ``plan`` makes them: round what stands in the way, proven, timed.
    What can't be planned isn't suggested. The suggested plan is no slower than any with the
    tension -0.5, 0 or 0.5 for all spans, nor than what stands in the mission; and no sharper than
    one of them that is as fast. Another tension than these is taken only if its path drives well,
    and the gentlest of those that cost no more than a thousandth of the time over the fastest.

    Attributes:
        trials: What was planned, one tension for all spans first.
        stands: What stands in the mission; None if that is ``auto``.
        unstated: What comes of none stated, so that lines and turns compete with the spline; it is
            suggested only where that is what stands in the mission.
        chosen: The one that is suggested.
        spans: The via points before and after each span, m of them.
        tensions: Eq. (7)'s t that were looked at, shape (n,).
        effects: What they do to each span of the spline itself; None along a corridor's line.
    """

    trials: tuple[TensionTrial, ...]
    stands: TensionTrial | None
    unstated: TensionTrial
    chosen: TensionTrial
    spans: tuple[tuple[str, str], ...]
    tensions: Floats
    effects: SpanTensions | None

    def __repr__(self) -> str:
        return f"<TensionAdvice: {self.chosen.tension} of {len(self.trials)} tried, {self.plan}>"

    @property
    def plan(self) -> Plan:
        """The plan with what is suggested."""
        assert self.chosen.plan is not None  # else it wouldn't be suggested
        return self.chosen.plan

    @property
    def suggested(self) -> Tension:
        """One for all spans, one for each, or None: state none."""
        return self.chosen.tension

    @property
    def matters(self) -> bool:
        """Whether it makes any difference what tension is taken."""
        return not all(trial.is_same_as(self.chosen) for trial in self.trials)

    @property
    def common(self) -> tuple[TensionTrial, ...]:
        """The trials with one tension for all spans, in order."""
        alike = [trial for trial in self.trials if not math.isnan(trial.level)]
        return tuple(sorted(alike, key=lambda trial: trial.level))

    @property
    def keeps_spline(self) -> bool:
        """Whether the spline itself can be driven with what is suggested, so that no turns are."""
        if self.effects is None or self.suggested is None:
            return False
        return self.effects.fits(self.by_span)

    @property
    def by_span(self) -> Floats:
        """The tension of each span as suggested, shape (m,); not a number if none is stated."""
        value = np.nan if self.suggested is None else self.suggested
        return np.broadcast_to(np.asarray(value, np.float64), (len(self.spans),))


def advise_tension(
    mission: Mission, tensions: Sequence[float] = TRIED_TENSIONS, *, world: World | None = None
) -> TensionAdvice:
    """Plan a mission with one tension after the other, and say which to take.

    Args:
        mission: What stands in it is compared as well.
        tensions: At most 1, at least -199, in order: looked at beside -0.5, 0 and 0.5.
        world: What the mission has on its map, if it is there already; its via points are in the
            order in which they are served then.

    Raises:
        NoPathError: When there is no path.
        GaveUpError: When none was found with any of -0.5, 0, 0.5 and what stands in the mission.
        GeometryError: When the tensions are no such numbers, or the robot can't follow.

    Example:
        >>> mission = Mission.model_validate({
        ...     "route": {"start": [0, 0], "via": [[30, 0], [30, 30]], "goal": [0, 30]},
        ...     "spline": {"tension": -0.5},
        ... })
        >>> advice = advise_tension(mission)
        >>> advice.matters, advice.chosen.cost[0] <= advice.stands.cost[0]
        (True, True)
        >>> straight = Mission.model_validate({"route": {"start": [0, 0], "goal": [30, 0]}})
        >>> advise_tension(straight).matters
        False
    """
    check_kind("mission", mission, Mission, "give Mission.model_validate({...}) or load(file)")
    tried = _checked(tensions)
    if world is None:
        mission, world = in_order(mission)
    check_kind("world", world, World, "give World(obstacles)")
    stands = None if mission.spline.tension == "auto" else _as_it_stands(mission, world)
    basis = [] if stands is None else [stands]
    if has_line(mission.route):  # whose line has no tension
        basis = basis or [_trial(mission, world, 0.0)]
        return _advice(mission, basis, (stands, basis[0]), _best(basis, basis), tried, None)
    by_hand = [t for t in REFERENCES if stands is None or t != stands.tension]
    basis += [_trial(mission, world, t) for t in by_hand]
    best = _best(basis, basis)
    assert best.plan is not None
    effects = _effects(mission, world, tried, best.plan.tracking_error)
    trials = [*basis, *_explored(mission, world, effects, basis)]
    alike = [trial for trial in trials if not math.isnan(trial.level)]
    fastest = min(alike, key=lambda trial: trial.cost, default=best)
    trials += _refined(mission, world, effects, fastest)
    is_bare = stands is not None and stands.tension is None
    unstated = stands if is_bare and stands else _trial(mission, world, None)
    return _advice(mission, trials, (stands, unstated), _best(trials, basis), tried, effects)


def _advice(
    mission: Mission,
    trials: Sequence[TensionTrial],
    beside: tuple[TensionTrial | None, TensionTrial],
    chosen: TensionTrial,
    tried: Floats,
    effects: SpanTensions | None,
) -> TensionAdvice:
    sequence = via_sequence_of(_with(mission, 0.0))
    names = [via.name for via in sequence.vias]
    names += names[:1] if sequence.closed else []
    return TensionAdvice(tuple(trials), *beside, chosen, tuple(pairwise(names)), tried, effects)


def _checked(tensions: Sequence[float]) -> Floats:
    tried = np.array(numbers_from("tensions", tensions))
    is_list = tried.ndim == 1 and tried.size > 0
    if not is_list or not ((tried >= LOOSEST_TENSION) & (tried <= POLYLINE_TENSION)).all():
        raise GeometryError(
            f"tensions have shape {tried.shape}; give a list of numbers from "
            f"{LOOSEST_TENSION:g} to {POLYLINE_TENSION:g}"
        )
    return np.unique(tried)


def _with(mission: Mission, tension: Tension) -> Mission:
    spline = mission.spline.model_copy(update={"tension": tension, "slack": None})
    return mission.model_copy(update={"spline": spline})


def _trial(mission: Mission, world: World, tension: Tension) -> TensionTrial:
    return _planned(_with(mission, tension), world, tension)


def _as_it_stands(mission: Mission, world: World) -> TensionTrial:
    return _planned(mission, world, stated(mission.spline))


def _planned(mission: Mission, world: World, tension: Tension) -> TensionTrial:
    try:
        return TensionTrial(tension, whole_plan(mission, world))
    except (PlanningError, GeometryError) as error:
        return TensionTrial(tension, None, error)


def stated(spline: SplineSpec) -> Tension:
    """The tension that stands in a mission, by either of its names.

    >>> stated(SplineSpec(slack=0.25)), stated(SplineSpec(tension=(0.0, 0.5))), stated(SplineSpec())
    (0.5, (0.0, 0.5), None)
    """
    assert spline.tension != "auto", "what is to be advised doesn't stand there"
    if spline.slack is None:
        return float(spline.tension) if isinstance(spline.tension, int) else spline.tension
    if isinstance(spline.slack, tuple):
        return tuple(1.0 - 2.0 * slack for slack in spline.slack)
    return 1.0 - 2.0 * spline.slack


def _effects(mission: Mission, world: World, tried: Floats, error: float) -> SpanTensions:
    """What tensions do to the spline, which keeps as much as its plan did."""
    plain = _with(mission, 0.0)
    requirements = Requirements.of(plain, error)
    radius = least_radius(mission.robot)
    return SpanTensions.of(via_sequence_of(plain), world, requirements, radius, tried)


def _explored(
    mission: Mission, world: World, effects: SpanTensions, known: Iterable[TensionTrial]
) -> list[TensionTrial]:
    """Plans with one tension for all spans, where the spline itself can be driven on one of them.

    Elsewhere lines and turns are laid, which have no tension; but for the paper's own curve.
    """
    there = {trial.tension for trial in known}
    return [
        _trial(mission, world, t)
        for t in effects.tensions.tolist()
        if t not in there and (effects.fits_any(t) or effects.requirements.is_cardinal)
    ]


def _refined(
    mission: Mission, world: World, effects: SpanTensions, common: TensionTrial
) -> list[TensionTrial]:
    """A tension for each span, fast or gentler, begun at the fastest common one.

    Spans that are blocked with that one get another, with which they aren't, or stay as they are:
    the lines and turns that are laid there may be faster.
    """
    begin = int(effects.nearest(np.nan_to_num(common.level)))
    rows = {
        tuple(effects.tensions[effects.gentle(begin, spare, changed)].tolist())
        for changed in (np.asarray(effects.allowed.any(axis=1)), effects.allowed[:, begin])
        for spare in (0.0, 0.5 * SPARE_SHARE)
    }
    return [_trial(mission, world, row) for row in sorted(rows) if len(set(row)) > 1]


def _best(trials: Sequence[TensionTrial], basis: Sequence[TensionTrial]) -> TensionTrial:
    """The one that is suggested: see ``TensionAdvice``.

    Args:
        trials: What was planned; of equals, the first.
        basis: Those among them than which it must not be worse.
    """
    bar = min(trial.cost[0] for trial in basis)
    if not np.isfinite(bar) and basis[0].error is not None:
        raise basis[0].error
    fair = [trial for trial in trials if trial in basis or trial.drives_well]
    fastest = min(trial.cost[0] for trial in fair)
    limit = min(bar * (1.0 + SAME_SHARE), fastest * (1.0 + SPARE_SHARE))
    near = [trial for trial in fair if trial.cost[0] <= limit]
    peak = min(trial.cost[1] for trial in near)
    return next(trial for trial in near if trial.cost[1] <= peak * (1.0 + SAME_SHARE) + SAME_SHARE)
