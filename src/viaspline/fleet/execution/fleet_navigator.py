"""The navigator of a fleet: reports in, grants and commands out; state in, state out."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from math import floor

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.execution.believed_reports import believed
from viaspline.fleet.execution.dead_in_the_way import (
    died,
    hold_before_closed,
    let_past_dead,
)
from viaspline.fleet.execution.driven_fleet import DrivenFleet, driven_fleet_of
from viaspline.fleet.execution.dwells import FleetStations, dwell
from viaspline.fleet.execution.fleet_messages import FleetCommand, ProgressReport
from viaspline.fleet.execution.fleet_orders import decided, drawn_orders, index_of
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.fleet_run import FleetEvent, swapped_events
from viaspline.fleet.execution.fleet_standing import FleetStanding
from viaspline.fleet.execution.fleet_under_way import FleetUnderWay
from viaspline.fleet.execution.granted_commands import commands_of
from viaspline.fleet.execution.opened_rings import without_rings
from viaspline.fleet.execution.rolled_over import rolled_over
from viaspline.fleet.execution.strayed_robots import hold_apart
from viaspline.fleet.execution.ways_from_rest import FleetMissions, check_member
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.still_world import check_still
from viaspline.handed_in import all_of, check_kind, number_from, time_from
from viaspline.kernels.fleet.dispatching import dispatch_step
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.route_spec import Route
from viaspline.robot.warmed import KernelCallback, warm_up

PERIOD_S = 0.1
"""Usual time between two steps."""
STOPS_WITHIN_M = 0.05
"""How far before where it has to stop a robot may come to rest, if nothing else is said."""
SILENT_S = 5.0
"""A robot that isn't heard of for longer is said to be silent."""


class FleetNavigator(FleetStanding):
    """Drives the plan of a fleet in a person's own control room; immutable.

    Every step takes what robots have reported, and gives a command for each of them and the
    navigator of the next step. It has no clock and no network: time is what the caller says it is,
    and reports that never come, or come late, are simply not there.

    What it keeps to is the order in which the plan has robots pass wherever their paths come near
    each other, and not its times: each may drive as soon and as fast as those before it let it.
    A robot is let into a crossing when the ones that are to pass before it have *reported* that
    they have left it. Where a report is lost, those who wait for it wait longer, and that is all:
    what a robot has been granted is never taken away from it, unless it says itself that it does
    without. The graph of who waits for whom has no cycle, so any delay that ends is a wait.

    An order that a delay has made foolish is swapped, where neither robot is in the crossing, the
    first one says that it will stop before it, and the graph stays without a cycle.

    Patrols that never end go on and on: their distances are counted over all laps, and orders come
    again every period, once all patrols have driven one and all others have arrived. Until then a
    patrol gets no farther than its plan.

    A robot that comes to rest a little before where it has to stop opens what it would have opened
    there only if that is behind it. So the graph is one of robots that stop ``stops_within_m``
    short: however near to that they come to rest, nobody waits for ever. Where that needs it, a
    robot passes before one that is to pass before it by the plan; ``events`` tells of it.

    A robot that comes farther than it was let, or is pushed back, is believed, and ``events`` tell
    how near others may come to it: see ``strayed_robots``. One that says that it is farther than it
    can have driven is believed once it has gone on saying so for a second.

    A robot is let beyond a station when it has stood there for its time, by its reports.

    Args:
        plan: What is driven.
        margin_m: How much farther than it says a robot has to be until others take it to have
            passed [m]. The tracking error of its plan is kept in any case, round its body.
        stops_within_m: How far before the end of what it is granted, or before a station, a robot
            may come to rest [m]; at its goal it says that it has arrived.
        period: Usual time between two steps [s].
        warm: Load, and on a machine's first run compile, all that any step can need: see
            ``Navigator.warm``.
        progress: Hears the name of every kernel that has to be compiled for that.

    Raises:
        GeometryError: The laws of the plan keep no order, or with the margin and what robots stop
            short there is none without a cycle; or something moves in its world that waits for
            nobody.

    Example:
        >>> import viaspline as vs
        >>> plan = vs.plan_fleet(vs.Fleet.model_validate({"separation_m": 1, "fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
        ...     {"name": "b", "route": {"start": [20, -20], "goal": [20, 20]}},
        ... ]}))
        >>> nav = FleetNavigator(plan)
        >>> reports = [ProgressReport("a", 0.0, 0.0), ProgressReport("b", 0.0, 0.0)]
        >>> commands, nav = nav.step(reports, 0.0)
        >>> commands["a"].granted, commands["b"].waits_for, commands["b"].granted < 20
        (40.0, 'a', True)
    """

    def __init__(
        self, plan: FleetPlan, *, margin_m: float = 0.0, stops_within_m: float = STOPS_WITHIN_M,
        period: float = PERIOD_S, warm: bool = True, progress: KernelCallback | None = None,
    ) -> None:  # fmt: skip
        check_kind("plan", plan, FleetPlan, "give plan_fleet(fleet)")
        check_still(plan.fleet)
        warm_up(plan.fleet, progress, warm)
        self._begin(driven_fleet_of(plan), margin_m, stops_within_m, period)
        self._missions = FleetMissions.of(plan)

    @classmethod
    def of(
        cls, fleet: DrivenFleet, *, margin_m: float = 0.0, stops_within_m: float = STOPS_WITHIN_M,
        period: float = PERIOD_S,
    ) -> FleetNavigator:  # fmt: skip
        """The navigator of a fleet that was planned by other means."""
        navigator = object.__new__(cls)
        navigator._begin(fleet, margin_m, stops_within_m, period)
        navigator._missions = None
        return navigator

    def _begin(
        self, fleet: DrivenFleet, margin_m: float, stops_within_m: float, period: float
    ) -> None:
        self._margin = _length("margin_m", margin_m)
        self._short = _length("stops_within_m", stops_within_m)
        short = np.full(len(fleet.names), self._margin + self._short)
        leaders, by_second = decided(fleet)
        drawn = drawn_orders(fleet, leaders, by_second, short)
        orders = without_rings(drawn, fleet.rides.depart)
        self._fleet, self._stations = fleet, FleetStations.of(fleet)
        self._period = time_from("period", period)
        events = swapped_events(fleet.names, leaders, orders.leaders, 0.0)
        self._state = replace(FleetProgressState.at_start(fleet, orders), events=tuple(events))

    def _with(self, state: FleetProgressState) -> FleetNavigator:
        navigator = object.__new__(FleetNavigator)
        navigator.__dict__.update(self.__dict__)
        navigator._state = state
        return navigator

    def _as(self, under_way: FleetUnderWay) -> FleetNavigator:
        """The navigator of a fleet that was changed."""
        navigator = self._with(under_way.state)
        navigator._fleet, navigator._missions = under_way.fleet, under_way.missions
        navigator._stations = FleetStations.of(under_way.fleet)
        return navigator

    def step(
        self, reports: Iterable[ProgressReport], time: float
    ) -> tuple[dict[str, FleetCommand], FleetNavigator]:
        """What every robot is to do from now on until it hears more.

        Args:
            reports: What has come in since the last step, in any order.
            time: Now [s], never less than in the step before.

        Returns:
            A command for each robot that drives, and the navigator for the next step.

        Raises:
            GeometryError: Time runs backwards or is no number, or a report is something else.
        """
        time = number_from("time", time)
        if not self._state.time <= time < np.inf:
            raise GeometryError(f"time {time} s is before the last step's, {self._state.time} s")
        given = all_of("reports", reports, ProgressReport, "give ProgressReport(name, time, …)")
        fleet, state = self._fleet, self._state.copied(time)
        packed, orders = state.packed, state.orders.packed
        robots, table, events = believed(fleet, state, given, self._margin)
        let_past_dead(state)
        dwell(self._stations, state, self._short)
        hold_before_closed(state)
        before = packed.leaders.copy()
        strayed = {event.name for event in events if event.kind == "strayed"}
        events += hold_apart(state, fleet, self._margin, strayed)
        swaps = np.isfinite(self._state.time) and floor(time) > floor(self._state.time)
        grants = dispatch_step(
            fleet.courses.packed, fleet.alone, orders, packed, robots, table,
            bool(swaps), time,
        )  # fmt: skip
        events += swapped_events(fleet.names, before, packed.leaders, time)
        events += state.silences(SILENT_S, fleet.rides.depart)
        commands = commands_of(fleet, self._stations, state, grants, self._period)
        state = replace(state, events=tuple(events))
        return commands, self._with(rolled_over(state, fleet, self._stations))

    def without(self, name: str) -> FleetNavigator:
        """The fleet without a robot that was taken out of the world: nobody waits for it.

        Raises:
            GeometryError: There is no such robot.
        """
        robot = index_of(self._fleet.names, name)
        words = f"{name} is taken out"
        event = FleetEvent("taken out", self._state.time, name, words)
        return self._with(self._state.taken_out(robot, event))

    def dead(self, name: str, until_m: float | None = None) -> FleetNavigator:
        """The fleet with a robot that stands where it is for ever: it is an obstacle now.

        Whoever was to pass after it where it will never come to goes first. Those whose way it
        stands in are stopped before it: ``blocked`` names them, and who waits for them. They need
        other paths: ``replanned`` lays some, or plan them anew and use ``with_plan``. Where it may
        stand beyond what it was granted, others may have been let in: ``events`` names them, and
        they are asked to stop, which whoever can't any more, or doesn't hear of it, won't.

        Args:
            name: Of the robot.
            until_m: How far along its path it may stand at most [m]; if it isn't given, as far as
                it was let go. It is at its last report or farther in any case.

        Raises:
            GeometryError: There is no such robot, or the place isn't on its path.
        """
        robot = index_of(self._fleet.names, name)
        most = float(self._state.packed.promised[robot])
        driven = float(self._state.driven[robot])
        until = most if until_m is None else number_from("until_m", until_m) - driven
        if not 0.0 <= until <= self._fleet.lengths[robot]:
            raise GeometryError(
                f"until_m is {until}; give a place on the path of {name}, which is "
                f"{self._fleet.lengths[robot]:.2f} m long"
            )
        return self._with(died(self._state, robot, until))

    def with_plan(self, plan: FleetPlan) -> FleetNavigator:
        """The fleet with another plan: robots are added, taken out or have other paths.

        Who keeps its path goes on as it was, and in the order that holds among such robots. Who
        has another path, or is new, begins it at its start.

        Raises:
            GeometryError: A robot is to pass before one that may be in the crossing already, or
                the orders have a cycle.
        """
        check_kind("plan", plan, FleetPlan, "give plan_fleet(fleet)")
        check_still(plan.fleet)
        navigator = self.with_fleet(driven_fleet_of(plan))
        navigator._missions = FleetMissions.of(plan)
        return navigator

    def with_fleet(self, fleet: DrivenFleet) -> FleetNavigator:
        """``with_plan`` for a fleet that was planned by other means."""
        navigator = self._as(self._under_way.along(fleet))
        navigator._missions = None
        return navigator

    def with_robot(self, member: FleetMember) -> FleetNavigator:
        """The fleet with one robot more, which stands at its start from now on.

        Its path is laid round the places where others rest, and it is timed among those that are
        under way, so that none of them is later for it: who is let in before it stays so. Only the
        orders of crossings with its path are new.

        Args:
            member: The robot; it departs now at the earliest.

        Raises:
            PlanningError: It has no path, or can't be timed along it: who is in its way.
            GeometryError: There is a robot of that name already, or this navigator has no plan.
        """
        check_member(member, flies=self._fleet.flies)
        if member.name in self.names:
            raise GeometryError(f"there is a robot {member.name!r} already; give another name")
        words = f"{member.name} is added"
        event = FleetEvent("added", self._under_way.now, member.name, words)
        return self._as(self._under_way.joined(member, event))

    def stopping(self, name: str) -> FleetNavigator:
        """The fleet with a robot that is asked to stop as soon as it can.

        It stands there until it is sent elsewhere with ``rerouted``, or on with ``resumed``.

        Raises:
            GeometryError: There is no such robot.
        """
        return self._as(self._under_way.stopping(name, self._period))

    def resumed(self, name: str) -> FleetNavigator:
        """The fleet with a robot that was asked to stop, and goes on.

        Raises:
            GeometryError: There is no such robot.
        """
        robot = index_of(self.names, name)
        state = self._state.copied(self._state.time)
        state.stops_at[robot] = np.inf
        return self._with(replace(state, events=self._state.events))

    def rerouted(self, name: str, route: Route) -> FleetNavigator:
        """The fleet with a robot that is sent elsewhere, from where it stands.

        Nobody else is touched but those whose paths its old or its new one crosses.

        Args:
            name: Of the robot. It has to stand at the end of what it is granted: at its start,
                where it waits, at its goal, or where it was asked to with ``stopping``.
            route: Its other route; it begins where the robot stands, whatever its start says.

        Raises:
            PlanningError: It has no path, or can't be timed along it: who is in its way.
            GeometryError: There is no such robot, it doesn't stand, or this navigator has no plan.
        """
        check_kind("route", route, Route, "give Route.model_validate({...})")
        return self._as(self._under_way.rerouted(name, route))

    def replanned(self) -> FleetNavigator:
        """The fleet with other paths for those that wait for a dead robot, from where they stand.

        Those of ``blocked`` that stand where they wait for one that never gets on are laid anew one
        after the other, round such robots, to what is left of their routes; those that wait behind
        them only if they stand in their way. Those that are still on their way to where they will
        wait are left for the next call. Who has no way stays where it is; an event says why.

        Raises:
            GeometryError: This navigator has no plan.
        """
        return self._as(self._under_way.replanned())


def _length(name: str, value: float) -> float:
    """A length of 0 or more [m]."""
    length = number_from(name, value)
    if not 0.0 <= length < np.inf:
        raise GeometryError(f"{name} is {length}; give a number of 0 or more")
    return length
