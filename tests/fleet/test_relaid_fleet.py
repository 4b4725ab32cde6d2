"""Fleets along paths that were laid round other robots as they drive."""

from dataclasses import replace

from viaspline.fleet.among_moving import proven_among
from viaspline.fleet.courses import courses_of
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.relaid_fleet import _as_laid
from viaspline.fleet.timing.rides import rides_of
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import plan


def test_who_was_laid_among_other_robots_is_no_plan_among_what_moves() -> None:
    """Read again from a file it was another plan: nothing moves in its mission."""
    fleet = Fleet.model_validate({"separation_m": 1, "fleet": [
        {"name": "a", "route": {"start": [0, 0], "goal": [20, 0]}},
        {"name": "b", "route": {"start": [0, 9], "goal": [20, 9]}},
    ]})  # fmt: skip
    alone = {one.name: plan(one.mission) for one in fleet.members}
    courses = courses_of(alone, fleet.separation_m)
    rides = rides_of(fleet.members, list(alone.values()), courses)
    ways = FleetWays(
        tuple(fleet.members), tuple(alone.values()), courses, crossings_of(courses), rides
    )
    found = {name: replace(proven_among(fleet, one), mission=one.mission)
             for name, one in alone.items()}  # fmt: skip
    assert all(one.timed is not None for one in found.values())
    led = _as_laid(ways, found, alone, fleet)
    assert led is not None
    assert all(one.timed is None for one in led.ways.planar)
