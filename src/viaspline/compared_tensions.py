"""Whole plans with one tension after the other, and the one that is the best of them.

Tested through ``test_advice``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from viaspline.driven_plan import driven_plan
from viaspline.errors import GeometryError, PlanningError
from viaspline.kernels.arrays import Floats
from viaspline.machine.measure_drivability import least_radius
from viaspline.mission.model import Mission
from viaspline.mission.spline_spec import SplineSpec
from viaspline.mission.stated_tension import (
    REFERENCES,
    SAME_SHARE,
    SPARE_SHARE,
    StatedTension,
    best_stated,
    with_tension,
)
from viaspline.mission.strip import has_line
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.shared_searches import SharedSearches
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.span_tensions import SpanTensions
from viaspline.whole_plan import Plan
from viaspline.world.world import World

TRIED_TENSIONS = (-0.5, -0.3, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95)
MORE_AMONG_S = 4.0
"""What paths past what moves may spend with all tensions but these [s of the reference machine]: as
much as those with one of them."""


@dataclass(frozen=True, eq=False)
class TensionTrial(ComparedByValue):
    """A tension, and the whole plan with it.

    Attributes:
        tension: One for all spans, one for each; None where none is stated, and turns compete.
        plan: The plan; None if there is none.
        error: Why there is none.
    """

    tension: StatedTension
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


def advised_plan(mission: Mission, world: World) -> Plan:
    """The plan with what is suggested: ``advise_tension(mission).plan``, and nothing beside it.

    Args:
        mission: Its via points in the order in which they are served.
        world: What it has on its map.

    Raises:
        NoPathError, GaveUpError, GeometryError: As ``advise_tension``.
    """
    plan = compared_tensions(mission, world, np.array(TRIED_TENSIONS)).chosen.plan
    assert plan is not None  # else it wouldn't be suggested
    return plan


@dataclass(frozen=True)
class ComparedTensions:
    """What is planned to be compared.

    Attributes:
        stands: What stands in the mission; None if that is ``auto``.
        basis: What the suggestion must not be worse than.
        trials: All that may be suggested.
        effects: What tensions do to each span; None along a corridor's line.
    """

    stands: TensionTrial | None
    basis: Sequence[TensionTrial]
    trials: Sequence[TensionTrial]
    effects: SpanTensions | None

    @property
    def chosen(self) -> TensionTrial:
        """The one that is suggested."""
        return _best(self.trials, self.basis)


def compared_tensions(mission: Mission, world: World, tried: Floats) -> ComparedTensions:
    """Plan with one tension after the other.

    Args:
        mission: Its via points in the order in which they are served.
        world: What it has on its map.
        tried: Tensions that are looked at beside the references, in order, (n,).
    """
    stands = None if mission.spline.tension == "auto" else _as_it_stands(mission, world)
    basis = [] if stands is None else [stands]
    if has_line(mission.route):  # whose line has no tension
        basis = basis or [_planned(with_tension(mission, 0.0), world, 0.0)]
        return ComparedTensions(stands, basis, basis, None)
    by_hand = [t for t in REFERENCES if stands is None or t != stands.tension]
    shared = SharedSearches()
    as_usual = _Trials(mission, world, WorkBudget(math.inf, shared=shared))
    basis += [as_usual.of(t) for t in by_hand]
    best = _best(basis, basis)
    assert best.plan is not None
    effects = _effects(mission, world, tried, best.plan.tracking_error)
    more = _Trials(mission, world, WorkBudget(MORE_AMONG_S, shared=shared))
    trials = [*basis, *_explored(more, effects, basis)]
    alike = [trial for trial in trials if not math.isnan(trial.level)]
    fastest = min(alike, key=lambda trial: trial.cost, default=best)
    trials += _refined(more, effects, fastest)
    shared.forget()
    return ComparedTensions(stands, basis, trials, effects)


def _as_it_stands(mission: Mission, world: World) -> TensionTrial:
    return _planned(mission, world, stated(mission.spline))


def _planned(
    mission: Mission, world: World, tension: StatedTension, spending: WorkBudget | None = None
) -> TensionTrial:
    try:
        return TensionTrial(tension, driven_plan(mission, world, spending))
    except (PlanningError, GeometryError) as error:
        return TensionTrial(tension, None, error)


def stated(spline: SplineSpec) -> StatedTension:
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
    plain = with_tension(mission, 0.0)
    requirements = Requirements.of(plain, error)
    radius = least_radius(mission.robot)
    return SpanTensions.of(via_sequence_of(plain), world, requirements, radius, tried)


@dataclass(frozen=True)
class _Trials:
    """Trials that have searches in common.

    Attributes:
        mission: Of which.
        world: What it has on its map.
        spending: What their paths past what moves may spend together.
    """

    mission: Mission
    world: World
    spending: WorkBudget

    def of(self, tension: StatedTension) -> TensionTrial:
        """The one with a tension."""
        mission = with_tension(self.mission, tension)
        return _planned(mission, self.world, tension, self.spending)


def _explored(
    more: _Trials, effects: SpanTensions, known: Iterable[TensionTrial]
) -> list[TensionTrial]:
    """Plans with one tension for all spans, where the spline itself can be driven on one of them.

    Elsewhere lines and turns are laid, which have no tension; but for the paper's own curve.
    """
    there = {trial.tension for trial in known}
    return [
        more.of(t)
        for t in effects.tensions.tolist()
        if t not in there and (effects.fits_any(t) or effects.requirements.is_cardinal)
    ]


def _refined(more: _Trials, effects: SpanTensions, common: TensionTrial) -> list[TensionTrial]:
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
    return [more.of(row) for row in sorted(rows) if len(set(row)) > 1]


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
    return fair[best_stated([trial.cost for trial in fair], bar)]
