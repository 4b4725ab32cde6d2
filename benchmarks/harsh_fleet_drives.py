"""Fleets that are driven by FleetNavigator under hard conditions, and what went wrong.

    python benchmarks/harsh_fleet_drives.py [FLEETS] [FIRST] [--kind KIND ...]

Small fleets in the open (swapped places, laps, patrols, stations), each driven twice: up to half of
all messages are lost, what arrives is up to 2 s late and out of order, and up to 13 things happen:
robots die (told at once, late, or never where), are taken out, join, halt, are stopped and sent
elsewhere again and again. Places are looked at every 10 ms without the planner. A drive ends well
if no two robots come nearer than is asked and none stands for no dead one.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from typing import Any

import numpy as np
from odd_fleet_drives import DrivenRobot, NavigatorDrive
from strange_hunt import Found, Job, hunt, told_of

import viaspline as vs
from viaspline.fleet.fleet_plan import FleetPlan

KINDS = ("any", "swapped", "laps", "mixed")
DRIVES = 2
LOST = (0.0, 0.15, 0.5)
LATE_S = (0.0, 0.3, 2.0)
EVENTS = (
    "dead", "dead far", "told late", "out", "more", "elsewhere", "elsewhere", "elsewhere", "halt",
    "halt", "stop", "dead out",
)  # fmt: skip


class HarshDrive(NavigatorDrive):
    """One drive of a plan in which much goes wrong.

    Args:
        plan: What is driven.
        random: Of all that happens.
        field: Places of the plane up to which robots are sent [m].
    """

    def __init__(self, plan: FleetPlan, random: np.random.Generator, field: float) -> None:
        super().__init__(plan, random, field)
        self.lost = float(random.choice(LOST))
        self.late = float(random.choice(LATE_S))
        self.changes = int(random.integers(2, 14))
        self.patience = 2.0 + 2.0 * self.late
        self.reports_due: list[tuple[float, Any]] = []
        self.commands_due: list[tuple[float, Any]] = []
        self.deaths_due: list[tuple[float, DrivenRobot]] = []

    def _reports(self, time: float) -> list[vs.ProgressReport]:
        self._tell_of_deaths(time)
        for one in self.robots.values():
            speaks = one.name in self.nav.names and (not one.is_dead or self.random.random() < 0.5)
            if speaks and self.random.random() > self.lost:
                self.reports_due.append((self._arrives(time), one.report(time)))
        come = [report for due, report in self.reports_due if due <= time]
        self.reports_due = [one for one in self.reports_due if one[0] > time]
        return come

    def _tell(self, commands: Any, time: float) -> None:
        for command in commands.values():
            if self.random.random() > self.lost:
                self.commands_due.append((self._arrives(time), command))
        come = sorted((one for one in self.commands_due if one[0] <= time), key=lambda one: one[0])
        self.commands_due = [one for one in self.commands_due if one[0] > time]
        for _, command in come:
            self.robots[command.name].hear(command, time)

    def _arrives(self, time: float) -> float:
        """When a message that is sent now does [s]."""
        return time + float(self.random.uniform(0.0, self.late))

    def _tell_of_deaths(self, time: float) -> None:
        """Tell of robots that died some time ago, once they stand."""
        for due, one in list(self.deaths_due):
            if time < due or one.speed > 0.0:
                continue
            self.deaths_due.remove((due, one))
            if self.random.random() < 0.5 and len(one.paths) == 1 and not one.patrols:
                self.nav = self.nav.dead(one.name, until_m=min(one.along, one.paths[0].length))
            else:
                self.nav = self.nav.dead(one.name)

    def _something_happens(self, time: float) -> None:
        what = str(self.random.choice(EVENTS))
        if what == "more":
            if self._add(time):
                self.happened[what] = self.happened.get(what, 0) + 1
            return
        one = self._one_for(what)
        if one is None:
            return
        self.happened[what] = self.happened.get(what, 0) + 1
        if what in ("dead", "dead far"):
            one.is_dead = True
            stops = one.along + 0.5 * one.speed**2 / one.accel + 0.05
            if what == "dead far" or one.patrols or len(one.paths) > 1:
                self.nav = self.nav.dead(one.name)
            else:
                self.nav = self.nav.dead(one.name, until_m=min(stops, one.paths[0].length))
        elif what == "told late":
            one.is_dead = True
            self.deaths_due.append((time + float(self.random.uniform(0.0, 15.0)), one))
        elif what in ("out", "dead out"):
            one.is_gone = True
            self.nav = self.nav.without(one.name)
        elif what == "halt":
            one.halts_until = time + float(self.random.uniform(2.0, 30.0))
        elif what == "elsewhere":
            self.nav = self.nav.stopping(one.name)
            self.wants[one.name] = (time, self._somewhere(self.plan.fleet.members[0].mission))
        else:
            self.nav = self.nav.stopping(one.name)
            if one.name not in self.wants:
                self.nav = self.nav.resumed(one.name)

    def _one_for(self, what: str) -> DrivenRobot | None:
        """Whom something happens to; None: to nobody."""
        untold = [one for _, one in self.deaths_due]
        if what == "dead out":
            fit = [
                one for one in self.robots.values()
                if one.is_dead and not one.is_gone and one not in untold
            ]  # fmt: skip
        else:
            fit = [one for one in self.robots.values() if not (one.is_dead or one.is_gone)]
            if what in ("dead", "dead far", "told late", "out"):
                fit = [one for one in fit if not one.arrived]
                if len(fit) < 2:
                    return None
        return fit[int(self.random.integers(len(fit)))] if fit else None


def drawn_fleet(rng: np.random.Generator, kind: str) -> tuple[dict[str, Any], float]:
    """A small fleet in the open, and how wide the field is [m]."""
    count, side = int(rng.integers(2, 8)), float(rng.uniform(8.0, 30.0))
    radius, separation = float(rng.uniform(0.2, 0.6)), float(rng.choice([0.0, 0.3, 1.0]))
    apart = 2.0 * radius + separation + 0.3
    starts, goals = (_places(rng, count, side, apart) for _ in range(2))
    if kind == "swapped":
        goals = [starts[k - 1] for k in range(count)]
    members = [
        _member(rng, kind, side, {"name": f"r{k}", "robot": "disc"}, start, goal)
        for k, (start, goal) in enumerate(zip(starts, goals, strict=True))
    ]
    robot = {
        "radius_m": round(radius, 3),
        "max_speed_mps": round(float(rng.uniform(0.8, 2.5)), 2),
        "max_accel_mps2": round(float(rng.uniform(0.5, 2.0)), 2),
    }
    return {"separation_m": separation, "robots": {"disc": robot}, "fleet": members}, side


def _places(rng: np.random.Generator, count: int, side: float, apart: float) -> list[list[float]]:
    """Places that keep away from each other; fewer in a field that hasn't room for so many."""
    found: list[list[float]] = []
    for _ in range(3000):
        place = rng.uniform(0.0, side, 2).round(2).tolist()
        if len(found) < count and all(math.dist(place, one) > apart for one in found):
            found.append(place)
    return found


def _member(
    rng: np.random.Generator, kind: str, side: float, member: dict[str, Any], start: list[float],
    goal: list[float],
) -> dict[str, Any]:  # fmt: skip
    """A robot with its route."""
    via: list[Any] = [
        rng.uniform(0.0, side, 2).round(2).tolist() for _ in range(int(rng.integers(0, 3)))
    ]
    if via and rng.random() < 0.3:
        via[0] = {"at": via[0], "dwell_s": round(float(rng.uniform(0.5, 6.0)), 1)}
    route: dict[str, Any] = {"start": start, "via": via}
    if kind in ("laps", "mixed") and via and rng.random() < 0.5:
        route["closed"] = True
        if rng.random() < 0.6:
            route["laps"] = int(rng.integers(1, 4))
    else:
        route["goal"] = goal
    if rng.random() < 0.3:
        member["depart_s"] = round(float(rng.uniform(0.0, 15.0)), 1)
    if rng.random() < 0.3:
        member["priority"] = float(rng.integers(-1, 3))
    return member | {"route": route, "rest": str(rng.choice(["stay", "stay", "leave"]))}


def run(job: Job) -> Found:
    """The kind of a fleet, how its drives ended, and their faults."""
    seed, kinds, _ = job
    warnings.simplefilter("ignore")
    kind = kinds[seed % len(kinds)]
    return kind, *told_of(looked_at(seed, kind))


def looked_at(seed: int, kind: str) -> Iterator[str | tuple[str, str]]:
    """Faults of all drives of a fleet, and the word for how it ended."""
    data, side = drawn_fleet(np.random.default_rng((seed, KINDS.index(kind), 77)), kind)
    try:
        plan = vs.plan_fleet(vs.Fleet.model_validate(data))
    except vs.ViasplineError as error:
        yield type(error).__name__
        return
    if not plan.plans:
        yield "none served"
        return
    for number in range(DRIVES):
        drive = HarshDrive(plan, np.random.default_rng((seed, number, 5)), side)
        for fault in drive.faults():
            told = f"{fault}, {drive.lost:.0%} lost, up to {drive.late:g} s late"
            yield "drive", f"drive {number}: {told}"
    yield "driven"


if __name__ == "__main__":
    hunt(__doc__.split("\n\n")[0], KINDS, run)
