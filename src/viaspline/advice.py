"""Which tension to take: whole plans with many of them, compared in time, then peak curvature."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from viaspline.compared_tensions import (
    TRIED_TENSIONS,
    ComparedTensions,
    TensionTrial,
    compared_tensions,
)
from viaspline.errors import GeometryError
from viaspline.handed_in import check_kind, numbers_from
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.spline_spec import LOOSEST_TENSION, POLYLINE_TENSION
from viaspline.mission.stated_tension import StatedTension, with_tension
from viaspline.planning.problem.via_sequence import via_sequence_of
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.span_tensions import SpanTensions
from viaspline.whole_plan import Plan, in_order
from viaspline.world.world import World


@dataclass(frozen=True, eq=False)
class TensionAdvice(ComparedByValue):
    """Which tension is suggested, and what it is compared with.

    Compared are whole plans, as ``plan`` makes them: round what stands in the way, proven, timed.
    What can't be planned isn't suggested. The suggested plan is no slower than any with the
    tension -0.5, 0 or 0.5 for all spans, nor than with none stated, nor than what stands in the
    mission; and no sharper than one of them that is as fast. Another tension than these is taken
    only if its path drives well, and the gentlest of those that cost no more than a thousandth of
    the time over the fastest.

    Attributes:
        trials: What was planned, one tension for all spans first.
        stands: What stands in the mission; None if that is ``auto``.
        chosen: The one that is suggested.
        spans: The via points before and after each span, m of them.
        tensions: Eq. (7)'s t that were looked at, shape (n,).
        effects: What they do to each span of the spline itself; None along a corridor's line.
    """

    trials: tuple[TensionTrial, ...]
    stands: TensionTrial | None
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
    def suggested(self) -> StatedTension:
        """One for all spans, one for each, or None: state none."""
        return self.chosen.tension

    @property
    def matters(self) -> bool:
        """Whether it makes any difference what tension is taken, or that one is stated."""
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
    if mission.is_spatial:
        raise GeometryError(
            "a tension is advised for a mission in the plane, and this one has heights; in space "
            "spline: {tension: auto} takes the soonest of a few"
        )
    tried = _checked(tensions)
    if world is None:
        mission, world = in_order(mission)
    check_kind("world", world, World, "give World(obstacles)")
    compared = compared_tensions(mission, world, tried)
    return _advice(mission, compared, tried)


def _advice(mission: Mission, compared: ComparedTensions, tried: Floats) -> TensionAdvice:
    sequence = via_sequence_of(with_tension(mission, 0.0))
    names = [via.name for via in sequence.vias]
    names += names[:1] if sequence.closed else []
    return TensionAdvice(
        tuple(compared.trials), compared.stands, compared.chosen,
        tuple(pairwise(names)), tried, compared.effects,
    )  # fmt: skip


def _checked(tensions: Sequence[float]) -> Floats:
    tried = np.array(numbers_from("tensions", tensions))
    is_list = tried.ndim == 1 and tried.size > 0
    if not is_list or not ((tried >= LOOSEST_TENSION) & (tried <= POLYLINE_TENSION)).all():
        raise GeometryError(
            f"tensions have shape {tried.shape}; give a list of numbers from "
            f"{LOOSEST_TENSION:g} to {POLYLINE_TENSION:g}"
        )
    return np.unique(tried)
