"""Robots led over a lattice, all at once: who passes whom is known before paths are laid.

Tested through ``fleet/test_led_fleet``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.late_share import WELL_SERVED_SHARE, late_share
from viaspline.fleet.lattice_order.lattice_paths import SHAPES, lattice_order
from viaspline.fleet.lattice_order.no_lattice_order import NoLatticeOrder
from viaspline.fleet.lattice_order.time_in_order import time_in_order
from viaspline.fleet.laying.alone_paths import AlonePaths
from viaspline.fleet.laying.resting_places import all_rests
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.timing.rides import FleetRides
from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.planner import Plan

LEAST_LED = 10
"""Fewer robots aren't led over a lattice where their own paths serve all."""
DENSE_RESTS = 3.0
"""Resting places of others that the path of a robot leads over if it is alone, in the mean: of so
many there may be no way round, or long ones."""


def led_at_once(fleet: Fleet, alone: AlonePaths) -> TimedFleet | None:
    """Lead the robots of a dense fleet over a lattice.

    Args:
        fleet: What is asked for.
        alone: What each does if it is alone; all have a path.

    Returns:
        None if not all can be led so.
    """
    led = led_fleet(fleet.members, alone.plans, fleet.separation_m)
    return None if isinstance(led, NoLatticeOrder) or led.blocked else led


def led_fleet(
    members: Sequence[FleetMember], plans: Mapping[str, Plan], separation: float
) -> TimedFleet | NoLatticeOrder:
    """Lead robots over a lattice, all of them.

    Args:
        members: The robots.
        plans: As each would drive if it were alone, by name, in their order.
        separation: Free space between any two bodies [m].
    """
    leaving = [one.name for one in members if one.rest == "leave"]
    order = lattice_order(plans, separation, leaving=leaving)
    if isinstance(order, NoLatticeOrder):
        return order
    best: TimedFleet | None = None
    for shape in SHAPES:
        laid = order.paths(shape)
        ways = FleetWays.laid(members, laid.plans, separation)
        steps = list(laid.steps.values())
        timing = time_in_order(ways.courses, ways.crossings, ways.rides, steps)
        found = TimedFleet(ways, timing)
        if best is None or found.rank < best.rank:
            best = found
        if not best.blocked:
            break
    assert best is not None  # there are shapes
    return best


def may_be_led_sooner(rides: FleetRides, arrivals: Floats) -> bool:
    """Whether robots that are all served along their own paths are many, and late.

    Args:
        rides: How each drives alone.
        arrivals: When each arrives [s], (n,).
    """
    return len(arrivals) >= LEAST_LED and late_share(rides, arrivals) > WELL_SERVED_SHARE


def is_dense(fleet: Fleet, alone: AlonePaths) -> bool:
    """Whether there are many robots, whose paths lead over many resting places of others.

    Args:
        fleet: What is asked for.
        alone: What each robot does if it is alone. One that has no path, or something that moves,
            is nothing for a lattice.
    """
    plans = alone.plans
    if fleet.world.moving or len(plans) < max(LEAST_LED, len(fleet.members)):
        return False
    reaches = [alone.reach(fleet, one) for one in fleet.members]
    rests = all_rests(fleet.members, reaches, {})
    met = 0
    for member, reach in zip(fleet.members, reaches, strict=True):
        own = rests.of_robot(member.name)
        met += rests.near(plans[member.name].path.spans, reach, own).size
    return met >= DENSE_RESTS * len(fleet.members)
