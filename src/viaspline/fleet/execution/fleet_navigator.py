"""The navigator of a fleet: reports in, grants and commands out; state in, state out."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.execution.carried_over import carried_over
from viaspline.fleet.execution.driven_fleet import DrivenFleet, driven_fleet_of
from viaspline.fleet.execution.fleet_messages import FleetCommand, ProgressReport
from viaspline.fleet.execution.fleet_orders import index_of, orders_of
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.fleet_run import FleetEvent
from viaspline.fleet.execution.judged_reports import judged
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.handed_in import all_of, check_kind, number_from, time_from
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.dispatching import dispatch_step, speeds_ahead
from viaspline.kernels.fleet.order_flow import expected_shifts
from viaspline.mission.fleet.fleet import FleetMember

PERIOD_S = 0.1
"""Usual time between two steps."""
SILENT_S = 5.0
"""A robot that isn't heard of for longer is said to be silent."""


class FleetNavigator:
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

    Args:
        plan: What is driven.
        margin_m: How much farther than it says a robot has to be until others take it to have
            passed [m]. The tracking error of its plan is kept in any case, round its body.
        period: Usual time between two steps [s].

    Raises:
        GeometryError: The laws of the plan keep no order, or with the margin one with a cycle.

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
        self, plan: FleetPlan, *, margin_m: float = 0.0, period: float = PERIOD_S
    ) -> None:
        check_kind("plan", plan, FleetPlan, "give plan_fleet(fleet)")
        self._begin(driven_fleet_of(plan), number_from("margin_m", margin_m), period)
        self._plan: FleetPlan | None = plan

    @classmethod
    def of(
        cls, fleet: DrivenFleet, *, margin_m: float = 0.0, period: float = PERIOD_S
    ) -> FleetNavigator:
        """The navigator of a fleet that was planned by other means."""
        navigator = object.__new__(cls)
        navigator._begin(fleet, margin_m, period)
        navigator._plan = None
        return navigator

    def _begin(self, fleet: DrivenFleet, margin: float, period: float) -> None:
        if not 0.0 <= margin < np.inf:
            raise GeometryError(f"margin_m is {margin}; give a number of 0 or more")
        orders = orders_of(fleet, np.full(len(fleet.names), margin))
        self._fleet, self._margin = fleet, margin
        self._period = time_from("period", period)
        self._state = FleetProgressState.at_start(fleet, orders)

    def _with(self, state: FleetProgressState) -> FleetNavigator:
        navigator = object.__new__(FleetNavigator)
        navigator.__dict__.update(self.__dict__)
        navigator._state = state
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
        state = self._state.copied(time)
        believed, events = self._believed(state, given)
        fleet, packed, orders = self._fleet, state.packed, state.orders.packed
        before = packed.leaders.copy()
        robots = np.array([robot for robot, _ in believed], np.int64)
        table = np.array([row for _, row in believed], float).reshape(-1, 3)
        swaps = np.floor(time) > np.floor(self._state.time) if np.isfinite(self._state.time) else False
        grants, sequence = dispatch_step(
            fleet.courses.packed, fleet.laws_alone(), orders, packed, robots, table,
            state.sequence, bool(swaps), time,
        )  # fmt: skip
        for c in np.flatnonzero(before != packed.leaders).tolist():
            one, two = (fleet.names[r] for r in (packed.leaders[c], before[c]))
            words = f"{one} passes before {two}, which is late"
            events.append(FleetEvent("swapped", time, one, words, two))
        events += state.silences(SILENT_S)
        commands = self._commands(state, grants)
        return commands, self._with(replace(state, sequence=sequence, events=tuple(events)))

    def _believed(
        self, state: FleetProgressState, reports: tuple[ProgressReport, ...]
    ) -> tuple[list[tuple[int, tuple[float, float, float]]], list[FleetEvent]]:
        """The reports that can be true, in the order of their times, and why the others can't."""
        known, rows, events = state.known(self._fleet), [], []
        for report in sorted(reports, key=_order):
            event = judged(report, known, state.time)
            if event is not None:
                events.append(event)
                continue
            robot = known.names[report.name]
            place = min(max(report.distance - self._margin, 0.0), float(known.lengths[robot]))
            if report.arrived:
                gone = bool(self._fleet.rides.vanishes[robot])
                place = np.inf if gone else float(known.lengths[robot])
                if not state.arrived[robot]:
                    words = f"{report.name} arrives"
                    events.append(FleetEvent("arrived", report.time, report.name, words))
                state.arrived[robot] = True
            state.heard[robot], state.silent[robot] = report.time, False
            state.speeds[robot] = abs(report.speed)
            known.progress[robot] = max(known.progress[robot], place)
            holds = np.inf if report.holds is None else report.holds
            rows.append((robot, (report.time, place, holds)))
        return rows, events

    def _commands(self, state: FleetProgressState, grants: Floats) -> dict[str, FleetCommand]:
        """What each robot that drives is to do."""
        fleet, orders, packed = self._fleet, state.orders.packed, state.packed
        speeds = speeds_ahead(
            fleet.courses.packed, fleet.rides, packed.progress, state.speeds, grants, self._period
        )
        sets_out = fleet.rides.depart < state.time + self._period
        commands = {}
        for robot, name in enumerate(fleet.names):
            if state.out[robot]:
                continue
            bar = int(packed.head[robot])
            waits, opens = None, None
            if packed.recall[robot] >= 0:
                pair = orders.robots[packed.recall[robot]]
                waits = fleet.names[int(pair[0] if pair[1] == robot else pair[1])]
            elif bar < orders.first[robot + 1]:
                waits, opens = fleet.names[orders.other[bar]], float(orders.passed[bar])
            commands[name] = FleetCommand(
                name=name,
                granted=float(grants[robot]),
                speed=float(speeds[robot]) if sets_out[robot] else 0.0,
                waits_for=waits,
                opens_at=opens,
                arrived=bool(state.arrived[robot]),
            )
        return commands

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
        other paths: plan them anew, and give ``with_plan`` what comes of it.

        Args:
            name: Of the robot.
            until_m: How far along its path it may stand at most [m]; if it isn't given, as far as
                it was let go. It is at its last report or farther in any case.

        Raises:
            GeometryError: There is no such robot, or the place isn't on its path.
        """
        robot = index_of(self._fleet.names, name)
        most = float(self._state.packed.promised[robot])
        until = most if until_m is None else number_from("until_m", until_m)
        if not 0.0 <= until <= self._fleet.lengths[robot]:
            raise GeometryError(
                f"until_m is {until}; give a place on the path of {name}, which is "
                f"{self._fleet.lengths[robot]:.2f} m long"
            )
        words = f"{name} is dead and stands in the way"
        event = FleetEvent("dead", self._state.time, name, words)
        return self._with(self._state.with_dead(robot, until, event))

    def with_plan(self, plan: FleetPlan) -> FleetNavigator:
        """The fleet with another plan: robots are added, taken out or have other paths.

        Who keeps its path goes on as it was, and in the order that holds among such robots. Who
        has another path, or is new, begins it at its start.

        Raises:
            GeometryError: A robot is to pass before one that may be in the crossing already, or
                the orders have a cycle.
        """
        check_kind("plan", plan, FleetPlan, "give plan_fleet(fleet)")
        navigator = self.with_fleet(driven_fleet_of(plan))
        navigator._plan = plan
        return navigator

    def with_fleet(self, fleet: DrivenFleet) -> FleetNavigator:
        """``with_plan`` for a fleet that was planned by other means."""
        navigator = self._with(carried_over(self._state, self._fleet, fleet))
        navigator._fleet, navigator._plan = fleet, None
        return navigator

    def with_robot(
        self, member: FleetMember, planned: Callable[[FleetPlan, FleetMember], FleetPlan]
    ) -> FleetNavigator:
        """The fleet with one robot more.

        Args:
            member: The robot.
            planned: Plans it among the others, whose paths and laws stay as they are.

        Raises:
            GeometryError: As ``with_plan``; or this navigator has no plan.
        """
        if self._plan is None:
            raise GeometryError("this navigator has no FleetPlan; give one to FleetNavigator")
        return self.with_plan(planned(self._plan, member))

    @property
    def plan(self) -> FleetPlan | None:
        """What is driven; None if it was planned by other means."""
        return self._plan

    @property
    def names(self) -> tuple[str, ...]:
        """All robots of the fleet, those that don't drive any more as well."""
        return self._fleet.names

    @property
    def time(self) -> float:
        """Of the last step [s]; minus infinity before the first one."""
        return self._state.time

    @property
    def events(self) -> tuple[FleetEvent, ...]:
        """What happened in the last step, or when the fleet was changed after it."""
        return self._state.events

    @property
    def progress(self) -> dict[str, float]:
        """How far each robot has come at least [m]; infinite: it has left the world."""
        return dict(zip(self.names, self._state.packed.progress.tolist(), strict=True))

    @property
    def reached(self) -> bool:
        """Whether all robots that drive have arrived."""
        return bool((self._state.arrived | self._state.out).all())

    @property
    def blocked(self) -> dict[str, str]:
        """Robots that will never get on for a dead one, and for whom each of them waits."""
        stuck = self._state.stuck()
        others = self._state.orders.packed.other
        return {self.names[r]: self.names[others[stuck[r]]] for r in np.flatnonzero(stuck >= 0)}

    def expected(self) -> dict[str, float]:
        """When each robot will arrive, if none is delayed any more [s]; infinite: never.

        Inertia is left out, so it is a little sooner than they will.
        """
        state, orders = self._state, self._state.orders.packed
        begin = np.where(state.packed.fixed, np.inf, state.packed.begin)
        last = expected_shifts(
            orders, state.packed.leaders, state.sequence, state.packed.head, begin
        )[1]
        ends = self._fleet.courses.packed.first[1:] - 1
        arrive = last + self._fleet.laws_alone().arrive[ends]
        arrive[self._state.stuck() >= 0] = np.inf
        return dict(zip(self.names, arrive.tolist(), strict=True))


def _order(report: ProgressReport) -> tuple[float, str]:
    """By time; a report whose time is no number has its place as well."""
    return (report.time if report.time == report.time else -np.inf, str(report.name))
