"""Fleets of carts whose robots do, step by step, what the navigator tells them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

import viaspline as vs
from viaspline.mission.fleet.fleet import FleetMember

APART_M = 2.0  # between centres: discs of half a metre, and a metre between them
KINDS = {"cart": {"radius_m": 0.5, "clearance_m": 0.1, "max_speed_mps": 2.0}}
PERIOD_S = 0.5


def fleet(*routes: Any, **keys: Any) -> vs.Fleet:
    robots = [{"name": f"r{k}", "route": route} for k, route in enumerate(routes)]
    return vs.Fleet.model_validate({"separation_m": 1.0, "robots": KINDS, "fleet": robots, **keys})


CROSS = ({"start": [0, 0], "goal": [40, 0]}, {"start": [20, -20], "goal": [20, 20]})
ASIDE = {"start": [0, 40], "goal": [40, 40]}


@dataclass
class Drive:
    """Robots that do what the navigator tells them, and are looked at every half a second.

    A robot that is dead stands where it died.
    """

    nav: vs.FleetNavigator
    time: float = 0.0

    def __post_init__(self) -> None:
        self.place = dict.fromkeys(self.nav.names, 0.0)
        self.speed = dict.fromkeys(self.nav.names, 0.0)
        self.holds = dict.fromkeys(self.nav.names, 0.0)
        self.number = dict.fromkeys(self.nav.names, 0)
        self.at: dict[str, Any] = {}
        self.nearest = np.inf
        self.granted: dict[str, float] = {}
        self.heard = -1.0

    def driving(self) -> list[str]:
        """Those that have a plan; the others stand at their starts."""
        return [name for name in self.nav.names if name in self.nav.paths]

    def where(self) -> dict[str, np.ndarray]:
        paths = self.nav.paths
        for name in self.driving():
            path = paths[name].path
            self.at[name] = np.asarray(path.at_distance(min(self.place[name], path.length)))
        return self.at

    def step(self, dead: tuple[str, ...] = ()) -> dict[str, vs.FleetCommand]:
        reports = [
            vs.ProgressReport(
                name, self.time, self.place[name], self.speed[name],
                self.place[name] >= self.nav.paths[name].path.length - 1e-6,
                self.holds[name], self.heard, self.number[name],
            )
            for name in self.driving() if name not in dead
        ]  # fmt: skip
        commands, self.nav = self.nav.step(reports, self.time)
        assert not [one for one in self.nav.events if one.kind == "refused"]
        self.heard = self.time
        for name, command in commands.items():
            if name in dead:
                continue
            if command.path != self.number[name]:
                self.number[name], self.place[name] = command.path, 0.0
                self.speed[name] = self.holds[name] = 0.0
            stops = self.place[name] + self.speed[name] ** 2 / 2.0
            if command.granted >= self.holds[name] or stops <= command.granted:
                self.holds[name] = command.granted
            self.place[name] = max(self.place[name], min(command.distance, self.holds[name]))
            self.speed[name] = command.speed
        self.time += PERIOD_S
        at = np.array(list(self.where().values()))
        gaps = np.hypot(*np.moveaxis(at[:, None] - at[None], -1, 0)) + 9.0 * np.eye(len(at))
        self.nearest = min(self.nearest, float(gaps.min()))
        return commands

    def take(self, nav: vs.FleetNavigator) -> None:
        """A navigator of a fleet that was changed."""
        self.nav = nav
        for name in nav.names:
            for table in (self.place, self.speed, self.holds):
                table.setdefault(name, 0.0)
            self.number.setdefault(name, 0)

    def until(self, seconds: float, dead: tuple[str, ...] = ()) -> None:
        while self.time < seconds and not self.nav.reached:
            self.step(dead)


def start(*routes: Any, **keys: Any) -> Drive:
    plan = vs.plan_fleet(fleet(*routes, **keys))
    assert plan.served
    return Drive(vs.FleetNavigator(plan, period=PERIOD_S))


def member(name: str, route: Any) -> FleetMember:
    return FleetMember(name, fleet(route).members[0].mission)
