"""Small fleets planned and driven: robots that cross, meet in a lane, patrol, and are changed.

Tested through ``warming/test_warm_up``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import Any, Final

from viaspline.errors import ViasplineError
from viaspline.fleet.crossing_paths import crossing_paths
from viaspline.fleet.execution.fleet_messages import FleetCommand, ProgressReport
from viaspline.fleet.execution.fleet_navigator import FleetNavigator
from viaspline.fleet.execution.simulate_fleet import simulate_fleet
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.plan_fleet import plan_fleet
from viaspline.fleet.swerved_fleet import swerved_fleet
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.route_spec import Route
from viaspline.warming.mission_kind import MissionKind
from viaspline.warming.small_missions import robot_of

Parts = dict[str, Any]

STEP_S: Final = 0.5
IMPROVE_S: Final = 0.05


def drive_fleets(kind: MissionKind) -> None:
    """Plan and drive small fleets with robots of a kind."""
    for fleet in fleets_of(kind):
        with suppress(ViasplineError):
            plan = plan_fleet(fleet, improve=IMPROVE_S)
            if plan.patrols is None:
                simulate_fleet(fleet, plan=plan)
            drive_and_change(FleetNavigator(plan, warm=False), fleet)
    if not kind.parts:
        _lead_aside()


def _lead_aside() -> None:
    """Lead one of two paths aside that cross at a small angle, as in fleets of many robots."""
    routes = ({"start": [0, 0], "goal": [90, 0]}, {"start": [90, -5], "goal": [0, 5]})
    fleet = Fleet.model_validate(
        {"separation_m": 1, "fleet": [{"name": f"r{k}", "route": r} for k, r in enumerate(routes)]}
    )
    paths = crossing_paths(fleet)
    if paths.laid.kept is not None:
        timed = TimedFleet.by_priority(FleetWays.of(fleet, paths))
        swerved_fleet(timed, paths.laid.kept.rests, fleet.separation_m, STEP_S)


def fleets_of(kind: MissionKind) -> Iterator[Fleet]:
    """The fleets with robots of a kind."""
    robot = {key: value for key, value in robot_of(kind).items() if key != "sensor"}
    for world, routes in _scenes():
        members = [{"name": f"r{k}", "robot": "cart", "route": one} for k, one in enumerate(routes)]
        yield Fleet.model_validate(
            {"world": world, "separation_m": 0.4, "robots": {"cart": robot}, "fleet": members}
        )


def _scenes() -> Iterator[tuple[Parts, list[Parts]]]:
    post = {"circle": {"center": [8, 0.2], "radius": 0.5}}
    crossing: list[Parts] = [
        {"start": [0, 0], "goal": [16, 0]},
        {"start": [10, -6], "via": [{"at": [10, -2], "dwell_s": 1}], "goal": [10, 6]},
        {"start": [16, 2], "goal": [0, 2]},
    ]
    yield {"known": [post]}, crossing
    walls = [[[0, 2], [9, 2], [9, 6], [0, 6]], [[13, 2], [24, 2], [24, 6], [13, 6]]]
    lane = {"bounds": [0, 0, 24, 6], "known": [{"polygon": wall} for wall in walls]}
    yield lane, [{"start": [2, 1], "goal": [22, 1]}, {"start": [22, 1], "goal": [2, 1]}]
    patrols: list[Parts] = [
        {"start": [0, 0], "via": [[12, 0]], "closed": True},
        {"start": [6, 6], "via": [{"at": [6, -6], "dwell_s": 1}], "closed": True},
    ]
    yield {}, patrols


def drive_and_change(nav: FleetNavigator, fleet: Fleet) -> None:
    """Drive robots that do what they are told, and change all that can be changed meanwhile."""
    last, extra = nav.names[-1], fleet.members[0].mission
    away = extra.model_copy(
        update={"route": Route.model_validate({"start": [0, 9], "goal": [16, 9]})}
    )
    back = Route.model_validate({"start": [0, 0], "goal": [0, -5]})
    nav = _drive(nav, 0.0, 8)
    changes: tuple[Callable[[], FleetNavigator], ...] = (
        lambda: nav.stopping(last),
        lambda: nav.resumed(last),
        lambda: nav.with_robot(FleetMember("extra", away)),
        lambda: nav.rerouted(nav.names[0], back),
        lambda: nav.dead(last),
        lambda: nav.replanned(),
        lambda: nav.without(last),
    )
    for k, change in enumerate(changes):
        with suppress(ViasplineError):
            nav = change()
        nav = _drive(nav, STEP_S * (8 + 6 * k), 6)


def _drive(nav: FleetNavigator, start: float, steps: int) -> FleetNavigator:
    commands: Mapping[str, FleetCommand] = {}
    for k in range(steps):
        time = start + k * STEP_S
        reports = [
            ProgressReport(name, time, told.distance, told.speed, path=told.path)
            for name, told in commands.items()
        ]
        commands, nav = nav.step(reports, time)
    return nav
