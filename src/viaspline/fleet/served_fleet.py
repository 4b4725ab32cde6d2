"""Robots timed along their paths, with other paths where that leaves some without a law.

Tested through ``fleet/test_plan_fleet``.
"""

from __future__ import annotations

from viaspline.fleet.crossing_paths import CrossingPaths
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.laying.alone_paths import AlonePaths
from viaspline.fleet.laying.laying_work import LayingWork
from viaspline.fleet.led_fleet import is_dense, led_at_once, led_fleet, may_be_led_sooner
from viaspline.fleet.relaid_fleet import relaid_fleet
from viaspline.fleet.rerouted_fleet import rerouted_fleet
from viaspline.fleet.straight_fleet import straight_fleet
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.told_progress import FleetProgress, untold
from viaspline.fleet.unserved.pair_refusal import cannot_both_be_served
from viaspline.mission.fleet.fleet import Fleet

REROUTE_S, RELAY_S = 10.0, 32.0
"""What a plan may spend where priority alone leaves robots without a law: on other paths, timed
like all of them; and on paths that are laid in space and time at once [s of the reference machine].
"""
TRIAL_REROUTE_S, TRIAL_RELAY_S = 2.0, 4.0
"""As much, to find out whether something would help [s of the reference machine]."""


def served_fleet(
    fleet: Fleet, paths: CrossingPaths, reroute: float, work: LayingWork,
    tell: FleetProgress = untold,
) -> TimedFleet:  # fmt: skip
    """Time robots by priority; where that leaves some without a law, look for other ways.

    Robots that rest densely are led over a lattice at once, if all can be. Else they are timed
    along paths round all resting places, some of them once more (``time_paths``); who is led a long
    way round is tried on the path that it would take alone. Where that leaves any out, or serves
    many badly, all are led over a lattice as well. Else some are laid off the stretches on which
    they are in each other's way, else among the others that move as it is known, unless it is
    proven that this is of no use.

    Args:
        fleet: What is asked for.
        paths: Of the very fleet.
        reroute: What may be spent on other paths, timed like all of them [s of the reference
            machine].
        work: What may be spent on paths that are laid in space and time at once.
        tell: Told what is being done.
    """
    kept, led = paths.laid.kept, None
    if kept is not None and is_dense(fleet, alone := AlonePaths.of_kept(kept)):
        led = led_at_once(fleet, alone)
    return led or served_along(fleet, paths, reroute, work, tell)


def served_along(
    fleet: Fleet, paths: CrossingPaths, reroute: float, work: LayingWork,
    tell: FleetProgress = untold,
) -> TimedFleet:  # fmt: skip
    """As ``served_fleet``, where robots aren't led over a lattice at once; tells what it does."""
    ways = FleetWays.of(fleet, paths)
    timed = TimedFleet.by_priority(ways)
    if not timed.blocked:
        timed = straight_fleet(timed, paths.laid.kept, fleet.separation_m)
    if not timed.blocked and not may_be_led_sooner(ways.rides, timed.arrivals()):
        return timed
    tell("searching for an order", 0.0)
    led = led_fleet(
        ways.members, dict(zip(ways.courses.names, ways.planar, strict=True)), fleet.separation_m
    )
    if isinstance(led, TimedFleet) and not led.blocked:
        return min(timed, led, key=lambda one: one.rank)
    if not timed.blocked:
        return timed
    if paths.laid.kept is not None:
        timed = rerouted_fleet(
            timed, paths.laid.kept, fleet.separation_m, reroute,
            progress=lambda share: tell("looking for other paths", share),
        )  # fmt: skip
    pairs = timed.timing.blocked.items()
    if not all(cannot_both_be_served(fleet, timed, *pair) for pair in pairs):
        timed = relaid_fleet(fleet, timed, work, tell) or timed
    return timed.past_standing_ones() if timed.blocked else timed
