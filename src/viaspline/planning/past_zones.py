"""A path round speed zones, where one through them loses more than the way round takes.

A zone stands in nobody's way, so nothing leads round it by itself. Here zones are taken for
obstacles: a path that leaves them out is laid as any other, and taken where it is sooner.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.curve.path import Path
from viaspline.errors import PlanningError
from viaspline.planning.alternatives.record import Account, ThroughZones
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.checking.driving_time import driving_time
from viaspline.planning.plan_path import find_path, lay_path
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.zone_choices import ZoneChoices
from viaspline.world.world import World

LEAST_SAVED = 0.002
"""Of the time, for which another path is taken."""


def find_path_past_zones(
    sequence: ViaSequence, world: World, requirements: Requirements
) -> Solution:
    """A proven path, round the speed zones that it is sooner without.

    A zone near which a via point lies is driven through. So are all of them under way, where a
    search has a budget.

    Raises:
        NoPathError: When there is none, with the least change that would serve.
        GaveUpError: When a budget ran out before that was known.
    """
    found = find_path(sequence, world, requirements)
    objective = requirements.objective
    if not (objective.is_time and objective.pace.zones) or requirements.budget is not None:
        return found
    assert isinstance(found.account, Account)
    through = found.account.spline_path
    laid = _soonest(ZoneChoices(sequence, world, requirements, through))
    if laid is None:
        return found
    spline_path, account = laid
    path = Path(spline_path.spans, spline_path.vias)
    names = frozenset(account.world.names[len(world) :])
    kept = replace(account, measured_in=world, through=ThroughZones(names, through))
    return Solution(path, proven(path, world, requirements), kept)


def _soonest(choices: ZoneChoices) -> tuple[SplinePath, Account] | None:
    """The soonest path without zones; None where none is sooner than what was laid through them."""
    pace, sequence = choices.requirements.objective.pace, choices.sequence

    def time(laid: SplinePath) -> float:
        return driving_time(laid.spans, pace, laid.rests(sequence))

    best: tuple[SplinePath, Account] | None = None
    bound = (1.0 - LEAST_SAVED) * time(choices.through)
    for zones in choices.worth_a_path():
        try:
            laid = lay_path(sequence, choices.without(zones), choices.requirements)
        except PlanningError:
            continue
        if time(laid[0]) < bound:
            best, bound = laid, time(laid[0])
    return best
