"""Robots past the places where others rest, in place of long ways round them.

A path round all places where others rest can be timed whatever they do. Where that way is long, the
path that the robot would take alone may be sooner: it passes where another one isn't yet, or isn't
any more. No path has to be laid for that.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from viaspline.fleet.laying.kept_paths import KeptPaths, PathAlone
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.timing.time_paths import MANY
from viaspline.planner import Plan

LONG_WAY_SHARE = 0.1
"""A way round is long if it takes longer by this share than the path alone,"""
LONG_WAY_S = 1.0
"""and by so much [s]."""
MOST_TRIED = 12
"""So many times a robot is tried on its path alone."""
LEAST_GAIN_S = 0.5
"""What is saved in all, each robot weighed by its priority, at least [s]."""


@dataclass(frozen=True, eq=False)
class WaysRound:
    """Robots that are led round others, those with the longest ways first.

    Attributes:
        alone: The path that each would take alone, by name.
        long: Those whose ways are long.
        short: The others.
    """

    alone: Mapping[str, Plan]
    long: tuple[str, ...]
    short: tuple[str, ...]

    @classmethod
    def of(cls, laid: Mapping[str, Plan], kept: KeptPaths | None) -> WaysRound:
        """The ways of a fleet; none of many robots, or where some have no path.

        Args:
            laid: Its paths, by name.
            kept: What was found out while they were laid, if that is known.
        """
        kept_alone = {} if kept is None else kept.alone
        alone = {k: one.plan for k, one in kept_alone.items() if isinstance(one, PathAlone)}
        if len(laid) >= MANY or set(alone) != set(kept_alone) or set(alone) != set(laid):
            return cls(alone, (), ())
        takes = {name: plan.trajectory.duration for name, plan in alone.items()}
        longer = {name: plan.trajectory.duration - takes[name] for name, plan in laid.items()}
        led = [name for name, plan in laid.items() if plan is not alone[name]]
        led.sort(key=lambda name: -longer[name])
        is_long = {k: longer[k] > max(LONG_WAY_SHARE * takes[k], LONG_WAY_S) for k in led}
        return cls(
            alone, tuple(k for k in led if is_long[k]), tuple(k for k in led if not is_long[k])
        )


def straight_fleet(timed: TimedFleet, kept: KeptPaths | None, separation: float) -> TimedFleet:
    """A fleet of which some robots take the paths that they would take alone, if all are sooner.

    Those with long ways are tried; if that helps, all others that are led round somebody as well,
    for whom there may be more room now.

    Args:
        timed: All served, along the paths that were laid.
        kept: What was found out while these were laid, if that is known.
        separation: Free space between any two bodies [m].

    Returns:
        A fleet of the same robots, which serves all of them as well.
    """
    names = timed.ways.courses.names
    round_others = WaysRound.of(dict(zip(names, timed.ways.planar, strict=True)), kept)
    tried = round_others.long[:MOST_TRIED]
    best = _straightened(timed, tried, round_others.alone, separation)
    if best is timed:
        return timed
    more = round_others.short[: MOST_TRIED - len(tried)]
    return _straightened(best, more, round_others.alone, separation)


def _straightened(
    timed: TimedFleet, names: tuple[str, ...], alone: Mapping[str, Plan], separation: float
) -> TimedFleet:
    """The fleet with some robots on their paths alone, one after the other, where that helps."""
    for name in names:
        robot = timed.ways.courses.names.index(name)
        ways = timed.ways.with_path(robot, alone[name], separation)
        takes = ways.rides.alone.copy()
        takes[robot] = alone[name].trajectory.duration
        ways = replace(ways, rides=replace(ways.rides, alone=takes))
        found = TimedFleet.by_priority(ways)
        if not found.blocked and found.rank[1] < timed.rank[1] - LEAST_GAIN_S:
            timed = found
    return timed
