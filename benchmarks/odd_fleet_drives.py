"""Robots that are driven by FleetNavigator with lost messages, deaths, newcomers and other ways."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from strange_flight_oracle import Upright

import viaspline as vs
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.mission.route_spec import Route

TICK_S = 0.01
PERIOD_S = 0.1
LONGEST_S = 400.0
LOST = 0.15
"""Of all reports, and of all commands."""
SLACK_M = 2e-6
CREEP_M = 0.052
"""Who is so near the end of its grant is taken to stand there: ``stops_within_m`` and rounding."""
SHORT_M = 0.02
"""How far before what it is granted a robot stops."""


@dataclass
class DrivenRobot:
    """A robot that goes along its path, no farther than it is granted.

    Attributes:
        name: Its name.
        paths: Those that it was ever given, in their order.
        laps: How many laps each of these holds.
        rest: ``stay`` or ``leave``.
        accel: By how much it speeds up and brakes [m/s²].
        fastest: [m/s].
        body: Round its place: a circle in the plane, a ball or an upright cylinder in space.
        depart: When it may set out [s].
        patrols: Whether it never ends.
    """

    name: str
    paths: list[Any]
    laps: list[int]
    rest: str
    accel: float
    fastest: float
    body: Upright
    depart: float
    patrols: bool = False
    number: int = 0
    along: float = 0.0
    speed: float = 0.0
    granted: float = 0.0
    heard: float | None = None
    halts_until: float = 0.0
    is_dead: bool = False
    is_gone: bool = False
    arrived: bool = False
    rows: list[tuple[float, int, float]] = field(default_factory=list)

    def hear(self, command: Any, time: float) -> None:
        """Take up a command, if it is newer than the last one."""
        if self.is_dead or (self.heard is not None and command.time < self.heard):
            return
        if command.path > self.number and self.speed > 0.0:
            left = self.granted - self.along
            assert left <= CREEP_M, f"{self.name} gets another path {left} m before its grant ends"
            return  # it creeps on to where its grant ends, and takes up another path once it stands
        self.heard = command.time
        if command.path > self.number:
            self.number, self.along, self.granted = command.path, 0.0, 0.0
            self.arrived = False
        if command.path < self.number:
            return
        if command.granted >= self.granted or self._stops_at() <= command.granted:
            self.granted = command.granted

    def _stops_at(self) -> float:
        return self.along + 0.5 * self.speed**2 / self.accel + self.speed * TICK_S

    def tick(self, time: float) -> None:
        """Drive on for a tick."""
        room = self.granted - SHORT_M - self.along
        if self._ends() <= self.granted:
            room = self._ends() - self.along
        halted = self.is_dead or time < self.halts_until or time < self.depart
        wanted = 0.0 if halted else min(self.fastest, np.sqrt(max(1.9 * self.accel * room, 0.0)))
        change = self.accel * TICK_S
        self.speed = max(min(wanted, self.speed + change), self.speed - change, 0.0)
        gone = min(self.speed * TICK_S, max(room, 0.0))
        self.speed = gone / TICK_S if gone < self.speed * TICK_S else self.speed
        if room < 1e-4 and not halted:
            gone, self.speed = max(room, 0.0), 0.0
        self.along += gone
        self.arrived = not self.patrols and self.along >= self._ends() - 1e-9
        if self.arrived and self.rest == "leave":
            self.is_gone = True

    def _ends(self) -> float:
        """Where its drive does [m]."""
        return np.inf if self.patrols else float(self.paths[self.number].length)

    def report(self, time: float) -> vs.ProgressReport:
        """What it says of itself."""
        return vs.ProgressReport(
            self.name, time, self.along, self.speed, self.arrived, self.granted, self.heard,
            self.number,
        )  # fmt: skip

    def record(self, time: float) -> None:
        """Keep where it is."""
        self.rows.append((time, self.number, np.nan if self.is_gone else self.along))

    def places(self, times: Any) -> Any:
        """Where it was, (t, 3); not a number where it wasn't there."""
        found = np.full((len(times), 3), np.nan)
        rows = np.array(self.rows).reshape(-1, 3)  # a newcomer has none yet
        at = np.rint(rows[:, 0] / TICK_S).astype(int)
        for number, path in enumerate(self.paths):
            mine = (rows[:, 1] == number) & np.isfinite(rows[:, 2])
            along = rows[mine, 2]
            if self.patrols:
                lap = path.length / self.laps[number]
                along = np.mod(along, lap)
            if mine.any():
                found[at[mine]] = in_space(np.array(path.at_distance(along)))
        return found


def in_space(places: Any) -> Any:
    """Places with a height, which is 0 in the plane, (n, 3) [m]."""
    return np.column_stack([places, np.zeros((len(places), 3 - places.shape[1]))])


def body_of(robot: Any) -> Upright:
    """What counts as a robot's body beside others."""
    if robot.footprint is not None:
        return Upright(float(np.hypot(*np.array(robot.footprint, float).T).max()), 0.0, 0.0)
    if not robot.is_spatial:
        return Upright(float(robot.radius_m), 0.0, 0.0)
    return Upright.of(
        {"radius_m": robot.radius_m}
        | ({} if robot.half_height_m is None else {"half_height_m": robot.half_height_m})
    )


def gaps(one: Upright, other: Upright, offset: Any) -> Any:
    """Free space between two bodies that are so far off each other, (n,) [m]."""
    both = Upright(one.radius + other.radius, one.half + other.half, one.margin + other.margin)
    return both.free(np.hypot(offset[:, 0], offset[:, 1]), np.abs(offset[:, 2]))


class NavigatorDrive:
    """One drive of a plan.

    Attributes:
        changes: How many things happen.
        patience: How long it is waited before one that stands is sent elsewhere [s].

    Args:
        plan: What is driven.
        random: Of all that happens.
        field: Places of the plane up to which robots are sent [m].
    """

    changes = 4
    patience = 2.0

    def __init__(self, plan: FleetPlan, random: np.random.Generator, field: float = 22.0) -> None:
        self.plan, self.random, self.field = plan, random, field
        self.nav = vs.FleetNavigator(plan, warm=False)
        self.happened: dict[str, int] = {}
        self.robots: dict[str, DrivenRobot] = {}
        members = {one.name: one for one in plan.fleet.members}
        for name, one in plan.plans.items():
            self.robots[name] = self._robot(members[name], one)
        self.standing = {n: m for n, m in members.items() if n not in plan.plans}
        self.wants: dict[str, Any] = {}

    def _robot(self, member: vs.FleetMember, plan: vs.Plan) -> DrivenRobot:
        robot = member.mission.robot
        return DrivenRobot(
            member.name, [plan.path], [plan.mission.route.laps], member.rest,
            0.9 * robot.max_accel_mps2, robot.max_speed_mps * float(self.random.uniform(0.6, 1.0)),
            body_of(robot), member.mission.route.depart_s, member.mission.route.is_patrol,
        )  # fmt: skip

    def faults(self) -> Iterator[str]:
        """Drive, and say what was wrong."""
        steps = int(LONGEST_S / PERIOD_S)
        plan_end = max(one.trajectory.end_time for one in self.plan.plans.values())
        last = 0.7 * min(plan_end, LONGEST_S)
        events = sorted(self.random.uniform(0.0, last, self.changes).tolist())
        step = 0
        for step in range(steps):
            time = round(step * PERIOD_S, 6)
            while events and events[0] <= time:
                events.pop(0)
                self._something_happens(time)
            reports = self._reports(time)
            commands, self.nav = self.nav.step(reports, time)
            self._send_elsewhere(time)
            if self.nav.blocked and step % 20 == 0:
                self.nav = self.nav.replanned()
                self._take_new_paths()
            self._tell(commands, time)
            self._drive_on(time)
            if self._is_over():
                break
        yield from self._wrong_at_end((step + 1) * PERIOD_S)

    def _reports(self, time: float) -> list[vs.ProgressReport]:
        """Those that come in: some are lost."""
        return [
            one.report(time)
            for one in self.robots.values()
            if (not one.is_dead or self.random.random() < 0.5) and self.random.random() > LOST
            and (one.name in self.nav.names)
        ]  # fmt: skip

    def _tell(self, commands: Any, time: float) -> None:
        """What robots hear of what they are told."""
        for name, command in commands.items():
            if self.random.random() > LOST:
                self.robots[name].hear(command, time)

    def _drive_on(self, time: float) -> None:
        """Drive all robots for a period."""
        for tick in range(round(PERIOD_S / TICK_S)):
            now = time + tick * TICK_S
            for one in self.robots.values():
                one.record(now)
                if not one.is_gone:
                    one.tick(now)

    def _is_over(self) -> bool:
        return all(
            one.arrived or one.is_dead or one.is_gone or one.patrols for one in self.robots.values()
        )

    def _wrong_at_end(self, end: float) -> Iterator[str]:
        held = set(self.nav.blocked)
        for one in self.robots.values():
            over = one.arrived or one.is_dead or one.is_gone or one.patrols
            if not over and one.name not in held and not self._follows_held(one.name, held):
                at = f"{one.along:.2f} of {one.paths[one.number].length:.2f} m"
                yield f"drive: {one.name} stands at {at} for no dead one: {self.happened}"
        times = np.arange(0, round(end / TICK_S)) * TICK_S
        names = list(self.robots)
        places = {name: self.robots[name].places(times) for name in names}
        bodies = {name: one.body for name, one in self.robots.items()}
        for name, member in self.standing.items():
            places[name] = np.tile(self._home(member), (len(times), 1))
            bodies[name] = body_of(member.mission.robot)
        for i, one in enumerate(names):
            for other in [*names[:i], *self.standing]:
                gap = gaps(bodies[one], bodies[other], places[one] - places[other])
                if (
                    np.isfinite(gap).any()
                    and np.nanmin(gap) < self.plan.fleet.separation_m - SLACK_M
                ):
                    k = int(np.nanargmin(gap))
                    yield (
                        f"drive: {one} and {other} {gap[k]:.4f} m apart at {times[k]:.2f} s: "
                        f"{self.happened}"
                    )

    def _home(self, member: vs.FleetMember) -> Any:
        """Where a robot stands that isn't served."""
        return np.resize([*member.mission.route.start.at, 0.0], 3)

    def _follows_held(self, name: str, held: set[str]) -> bool:
        """Whether somebody whom it waits for is held, or has no way."""
        return any(event.kind == "has no way" for event in self.nav.events) or bool(held)

    def _something_happens(self, time: float) -> None:
        alive = [
            one for one in self.robots.values() if not (one.is_dead or one.is_gone or one.arrived)
        ]
        what = str(
            self.random.choice(["dead", "dead far", "out", "more", "elsewhere", "halt", "halt"])
        )
        if not alive or (what in ("dead", "dead far", "out") and len(alive) < 2):
            return
        one = alive[int(self.random.integers(len(alive)))]
        if what in ("dead", "dead far"):
            one.is_dead = True
            stops = one.along + 0.5 * one.speed**2 / one.accel + 0.05
            length = one.paths[one.number].length
            if what == "dead far" or one.patrols or len(one.paths) > 1:
                self.nav = self.nav.dead(one.name)
            else:
                self.nav = self.nav.dead(one.name, until_m=min(stops, length))
        elif what == "out":
            one.is_gone = True
            self.nav = self.nav.without(one.name)
        elif what == "halt":
            one.halts_until = time + float(self.random.uniform(2.0, 20.0))
        elif what == "elsewhere" and not one.patrols:
            self.nav = self.nav.stopping(one.name)
            self.wants[one.name] = (time, self._somewhere(self.plan.fleet.members[0].mission))
        elif what == "more" and not self._add(time):
            return
        self.happened[what] = self.happened.get(what, 0) + 1

    def _somewhere(self, like: vs.Mission) -> list[float]:
        """A random place of the field; in space with a height as one of the fleet's starts."""
        members = self.plan.fleet.members
        ends = np.array([one.mission.route.start.at[:2] for one in members])
        low, high = np.minimum(ends.min(axis=0), 0.5), np.maximum(ends.max(axis=0), self.field)
        place = self.random.uniform(low, high).round(2).tolist()
        if len(like.route.start.at) == 3:
            place.append(float(like.route.start.at[2]))
        return place

    def _add(self, time: float) -> bool:
        like = self.plan.fleet.members[0].mission
        start, goal = self._somewhere(like), self._somewhere(like)
        data = {"world": like.world, "robot": like.robot, "route": {"start": start, "goal": goal}}
        name = f"new {len(self.robots)}"
        here = (
            [
                one.places(np.arange(0, round(time / TICK_S)) * TICK_S)
                for one in self.robots.values()
            ]
            if time
            else []
        )
        for one, places in zip(self.robots.values(), here, strict=False):
            near = np.hypot(*(places[-1, :2] - start[:2])) if len(places) else np.inf
            if near < one.body.radius + one.body.margin + 3.0:
                return False
        try:
            member = vs.FleetMember(name, vs.Mission.model_validate(data))
            self.nav = self.nav.with_robot(member)
        except (vs.MissionError, vs.PlanningError):
            return False
        self.robots[name] = self._robot(member, self.nav.paths[name])
        self.robots[name].depart = time
        return True

    def _send_elsewhere(self, time: float) -> None:
        for name, (since, goal) in list(self.wants.items()):
            one = self.robots[name]
            if one.is_dead or one.is_gone or time > since + 60.0:
                del self.wants[name]
                if not (one.is_dead or one.is_gone):
                    self.nav = self.nav.resumed(name)
                continue
            if one.speed > 0.0 or time < since + self.patience:
                continue
            try:
                route = Route.model_validate({"start": [0.0] * len(goal), "goal": goal})
                self.nav = self.nav.rerouted(name, route)
                self.happened["sent elsewhere"] = self.happened.get("sent elsewhere", 0) + 1
            except vs.PlanningError:
                self.nav = self.nav.resumed(name)
            except (vs.GeometryError, vs.MissionError) as error:
                if "stand" not in str(error):
                    self.nav = self.nav.resumed(name)
                    del self.wants[name]
                continue
            del self.wants[name]
            self._take_new_paths()

    def _take_new_paths(self) -> None:
        for name, plan in self.nav.paths.items():
            one = self.robots.get(name)
            if one is not None and plan.path is not one.paths[-1]:
                one.paths.append(plan.path)
                one.laps.append(1)
                one.patrols = False
