"""Fleets in which a robot slips beyond what it was granted and dies there, looked at by samples."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from stepped_fleets import APART_M, PERIOD_S, Drive, fleet

import viaspline as vs

SIDE_M = 30.0
SAMPLE_M = 0.01


def random_fleet(rng: np.random.Generator) -> vs.Fleet:
    """Robots on straight and bent ways through one field, with homes apart from each other."""
    homes: list[Any] = []
    count = int(rng.integers(2, 6))
    while len(homes) < 2 * count:
        place = rng.uniform(0.0, SIDE_M, 2).round(2)
        if all(np.hypot(*(place - one)) > 3.0 for one in homes):
            homes.append(place)
    routes = [
        {
            "start": homes[2 * k].tolist(),
            "goal": homes[2 * k + 1].tolist(),
            "via": rng.uniform(0.0, SIDE_M, (int(rng.integers(0, 3)), 2)).round(2).tolist(),
        }
        for k in range(count)
    ]
    return fleet(*routes)


@dataclass
class Overrun:
    """A drive in which a robot has slipped and is dead.

    Attributes:
        drive: Of the fleet.
        dead: Its name.
        near: How near others came to it, sampled every centimetre of their ways [m]; where they
            couldn't help it any more isn't counted.
    """

    drive: Drive
    dead: str
    near: dict[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.stands_at = self.drive.where()[self.dead]
        self.free_from = {
            name: (self.drive.number[name], self._stops(name)) for name in self.drive.driving()
        }

    def _stops(self, name: str) -> float:
        """How far a robot may get before it can have stopped [m]."""
        speed = self.drive.speed[name] + 2.0 * PERIOD_S
        return self.drive.place[name] + 0.5 * speed**2 + 2.0 * speed * PERIOD_S

    def step(self) -> None:
        """Drive on, and look at all places through which robots may have come."""
        before = dict(self.drive.place), dict(self.drive.number)
        self.drive.step(dead=(self.dead,))
        for name in self.drive.driving():
            if name == self.dead:
                continue
            number, since = self.drive.number[name], 0.0
            if before[1][name] == number:
                since = before[0][name]
            if number == self.free_from[name][0]:
                since = max(since, self.free_from[name][1])
            path, until = self.drive.nav.paths[name].path, self.drive.place[name]
            if until <= since:
                continue
            along = np.linspace(since, until, 2 + int((until - since) / SAMPLE_M))
            gaps = np.hypot(*(np.asarray(path.at_distance(along)) - self.stands_at).T)
            self.near[name] = min(self.near.get(name, np.inf), float(gaps.min()))

    def nearest(self) -> float:
        """The least of what others came near it by themselves [m]."""
        return min(self.near.values(), default=np.inf)


def overrun(rng: np.random.Generator) -> Overrun | None:
    """A fleet under way one of whose robots slipped beyond its grant and died; None: none could."""
    plan = vs.plan_fleet(random_fleet(rng))
    if not plan.served:
        return None
    drive = Drive(vs.FleetNavigator(plan, period=PERIOD_S))
    ends = max(one.trajectory.end_time for one in plan.plans.values())
    drive.until(float(rng.uniform(0.0, 0.9 * ends)) + PERIOD_S)
    slips = [
        name
        for name in drive.driving()
        if drive.holds[name] < plan.plans[name].path.length - 0.01 and not drive.nav.reached
    ]
    if not slips:
        return None
    name = slips[int(rng.integers(len(slips)))]
    length = plan.plans[name].path.length
    drive.place[name] = min(drive.holds[name] + float(rng.exponential(2.0)), length)
    until = min(drive.place[name] + float(rng.choice([0.0, 0.5, 4.0])), length)
    drive.take(drive.nav.dead(name, until))
    return Overrun(drive, name)


def faults(found: Overrun) -> list[str]:
    """What goes wrong afterwards: who comes too near, or stands for nobody."""
    drive, told = found.drive, []
    for number in range(600):
        found.step()
        if number % 8 == 7 and drive.nav.blocked:
            drive.take(drive.nav.replanned())
        if drive.nav.reached:
            break
    if found.nearest() < APART_M - 1e-6:
        told.append(f"{found.near} near {found.dead}")
    held = drive.nav.blocked
    for name in drive.driving():
        over = drive.place[name] >= drive.nav.paths[name].path.length - 1e-6
        if not over and name != found.dead and name not in held:
            told.append(f"{name} stands at {drive.place[name]:.2f} m for nobody: {held}")
    return told
