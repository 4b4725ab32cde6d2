"""Robots that timing can't serve, laid anew one after the other among those that it does serve.

Tested through ``fleet/laying/test_relay``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from viaspline.errors import GeometryError, PlanningError
from viaspline.fleet.laying.laying_work import Laid, LayingWork
from viaspline.fleet.laying.relay import RELAY_S, relay
from viaspline.fleet.not_served import NotServed, not_served
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.planner import Plan

MAX_TURNS = 3
"""How often a robot that finds no path is laid before those that are in its way."""

MAX_LAYINGS = 200
"""How many times it is a robot's turn."""


@dataclass(frozen=True, eq=False)
class RelaidPaths:
    """What came of laying robots anew.

    Attributes:
        plans: Of all robots that are served, by name, with laws by the clock of the fleet.
        not_served: Those that are to be served and are not.
    """

    plans: dict[str, Plan]
    not_served: tuple[NotServed, ...] = ()


def relay_paths(
    fleet: Fleet, fixed: Mapping[str, Plan], names: Sequence[str],
    known: Mapping[str, Plan] = MappingProxyType({}), work: LayingWork | None = None,
    laid: Callable[[], None] | None = None,
) -> RelaidPaths:  # fmt: skip
    """Lay and time robots one after the other, each among all that are timed by then.

    Who finds no path because of one that is timed goes first, and that one is laid anew after it.
    Each may spend the same share of what is left, and the most robots that were served at once are
    what is handed back.

    Args:
        fleet: What is asked for.
        fixed: Plans of robots that are timed, by name, with laws by the clock of the fleet.
        names: The others that are to be served, the most important first.
        known: Other plans of these, by name, as far as there are any.
        work: What may be spent, and what is known; None: ``RELAY_S`` for each of them.
        laid: Called each time that a robot was laid, or can't be.

    Example:
        >>> fleet = Fleet.model_validate({"separation_m": 1, "fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [30, 0]}},
        ...     {"name": "b", "route": {"start": [30, 0], "goal": [0, 0]}},
        ... ]})
        >>> sorted(relay_paths(fleet, {}, ["a", "b"]).plans)
        ['a', 'b']
    """
    members = {one.name: one for one in fleet.members}
    plans, best = dict(fixed), dict(fixed)
    waiting = list(names)
    failed: dict[str, NotServed] = {}
    turns: Counter[str] = Counter()
    work = LayingWork.of(RELAY_S * len(names)) if work is None else work
    rounds = 0
    while waiting and rounds < MAX_LAYINGS:
        name, rounds = waiting.pop(0), rounds + 1
        with work.share(len(waiting) + 1) as part:
            found = _laid_or_not(fleet, members[name], plans, known.get(name), part)
        if laid is not None:
            laid()
        if isinstance(found, Plan):
            plans = {**plans, name: found}
        else:
            failed[name] = not_served(name, found)
            turns[name] += 1
            before = [one for one in _in_the_way(found, plans) if not _is_patrol(members[one])]
            if before and turns[name] <= MAX_TURNS:
                plans = {key: plan for key, plan in plans.items() if key not in before}
                waiting = [name, *before, *waiting]
        if len(plans) > len(best):
            best = plans
    asked = [key for key in members if key in {*fixed, *names} and key not in best]
    return RelaidPaths(best, tuple(failed.get(key) or _unlaid(key) for key in asked))


def _laid_or_not(
    fleet: Fleet, member: FleetMember, plans: Mapping[str, Plan], before: Plan | None,
    work: LayingWork,
) -> Laid:  # fmt: skip
    """A robot laid among those that are timed, or why it can't be."""
    try:
        return relay(fleet, member, plans, (), before, work)
    except (PlanningError, GeometryError) as error:
        return error


def _is_patrol(member: FleetMember) -> bool:
    """Whether a robot never ends: its laps stay as they are timed."""
    return member.mission.route.is_patrol


def _unlaid(name: str) -> NotServed:
    """What is told of a robot whose turn hadn't come."""
    return NotServed(
        name, "gave up", "it wasn't laid among the others yet",
        "give it a priority above those of the others",
    )  # fmt: skip


def _in_the_way(error: PlanningError | GeometryError, plans: Mapping[str, Plan]) -> list[str]:
    """The robots with a plan that an error names."""
    named = error.obstacles if isinstance(error, PlanningError) else ()
    return [name for name in dict.fromkeys(named) if name in plans]
