"""The colours of a fleet's robots.

Up to twenty robots have a colour each. Of a larger fleet those have one that there is most to say
of: the nearest two, and who waits longest and for whom. The others have the pale colour of their
kind, so that nobody is taken for another one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.timelines import Timeline
from viaspline.mission.fleet.fleet import Fleet

ROBOT_COLOURS: Final = (
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#0000ff", "#443311",
    "#440088", "#ee0055", "#ee22ff", "#660033", "#99bb55", "#bb0099", "#00626e", "#994433",
    "#ccaa77", "#4488ff", "#7a7a00", "#225500",
)  # fmt: skip
"""Okabe and Ito's without those that are too pale for a line on white paper, then each as far from
all before it as there is one, for common kinds of colour blindness as well."""

KIND_COLOURS: Final = ("#9db4c8", "#c6b795", "#a6c2a2", "#c1aac6", "#b9bec4")
"""Of robots that aren't told apart, by their kinds; the last one is of all further kinds."""

MAX_TOLD_APART: Final = len(ROBOT_COLOURS)
"""Robots of a fleet, beyond which not all have a colour of their own."""
MAX_HIGHLIGHTED: Final = 12
"""Robots of such a fleet that have one."""
ONE_KIND: Final = "robots"


@dataclass(frozen=True)
class FleetColours:
    """What colour each robot of a fleet has.

    Attributes:
        of: By name, in the order of the plan.
        told: The names of those that have one of their own, in the order of the plan.
        kinds: The colours of the others, by the names of their kinds.
    """

    of: Mapping[str, str]
    told: tuple[str, ...]
    kinds: Mapping[str, str]

    @property
    def all_told(self) -> bool:
        """Whether colours tell all robots apart."""
        return len(self.told) == len(self.of)


def fleet_colours(
    names: Sequence[str], fleet: Fleet, timelines: Sequence[Timeline], certificate: FleetCertificate
) -> FleetColours:
    """The colours of robots.

    Args:
        names: Those that are shown.
        fleet: Of which they are.
        timelines: Who waits for whom.
        certificate: Who comes nearest to whom.
    """
    if len(names) <= MAX_TOLD_APART:
        return FleetColours(dict(zip(names, colours_of(len(names)), strict=True)), tuple(names), {})
    chosen = _most_to_say_of(names, timelines, certificate)
    own = dict(zip(chosen, colours_of(len(chosen)), strict=True))
    kind_of = {one.name: one.robot or ONE_KIND for one in fleet.fleet}
    found = list(dict.fromkeys(kind_of[name] for name in names if name not in own))
    last = len(KIND_COLOURS) - 1
    kinds = {kind: KIND_COLOURS[min(number, last)] for number, kind in enumerate(found)}
    return FleetColours(
        {name: own[name] if name in own else kinds[kind_of[name]] for name in names}, chosen, kinds
    )


def _most_to_say_of(
    names: Sequence[str], timelines: Sequence[Timeline], certificate: FleetCertificate
) -> tuple[str, ...]:
    """The nearest two, then who waits and for whom, the longest waits first; in their order."""
    waits = [(wait.lost, one.name, wait.other) for one in timelines for wait in one.waits]
    pairs = [(name, other) for _, name, other in sorted(waits, key=lambda one: -one[0])]
    there, chosen = frozenset(names), dict[str, None]()
    for pair in (certificate.pair or (), *pairs):
        new = [name for name in pair if name in there and name not in chosen]
        if len(chosen) + len(new) <= MAX_HIGHLIGHTED:
            chosen |= dict.fromkeys(new)
    return tuple(name for name in names if name in chosen)


def colours_of(count: int) -> list[str]:
    """A colour for each of so many robots, at most twenty.

    Example:
        >>> colours_of(2)
        ['#0072b2', '#d55e00']
    """
    return list(ROBOT_COLOURS[:count])
