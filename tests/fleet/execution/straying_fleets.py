"""Fleets whose robots slip beyond their grants, or are pushed back, looked at by samples."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from overrun_fleets import random_fleet

import viaspline as vs

PERIOD_S = 0.1
ACCEL = 1.0
BODIES_M = 1.0  # between centres of discs of half a metre that touch


@dataclass
class StrayingCart:
    """A cart that obeys commands, but for one slip.

    Attributes:
        path: That it drives.
        slips: After how long it slips [s], and how far on, or back if negative [m].
        answers: Whether it says what it takes itself to be let.
    """

    path: Any
    slips: tuple[float, float]
    answers: bool = True
    place: float = 0.0
    speed: float = 0.0
    holds: float = 0.0
    heard: float = -1.0
    has_slipped: bool = False
    command: Any = None

    def hear(self, command: vs.FleetCommand) -> None:
        if command.time < self.heard:
            return
        self.heard, self.command = command.time, command
        if command.granted >= self.holds or self.stops() <= command.granted:
            self.holds = command.granted

    def stops(self) -> float:
        return self.place + 0.5 * self.speed**2 / ACCEL

    def drive(self, time: float) -> None:
        """As fast as it can to where it was last told, with its brakes kept ready."""
        told, end = self.command, self.path.length
        if told is None:
            return
        aim = min(self.holds, told.granted)
        fits = np.sqrt(max(2.0 * ACCEL * (aim - self.place), 0.0))  # and it stops there
        faster = min(self.speed + ACCEL * PERIOD_S, 2.0, 0.9 * fits)
        speed = max(faster, self.speed - ACCEL * PERIOD_S, 0.0)
        self.place = min(self.place + 0.5 * (speed + self.speed) * PERIOD_S, end)
        self.speed = speed
        if abs(aim - self.place) < 0.02 and speed < 0.2:
            self.place, self.speed = max(self.place, aim), 0.0
        when, far = self.slips
        if time >= when and not self.has_slipped and 0.0 < self.place < end:
            self.has_slipped = True
            self.place = float(np.clip(self.place + far, 0.0, end))

    def report(self, name: str, time: float) -> vs.ProgressReport:
        is_there = self.place >= self.path.length - 1e-6
        says = (self.holds, self.heard) if self.answers else (None, None)
        return vs.ProgressReport(name, time, self.place, self.speed, is_there, *says)


@dataclass
class StrayingDrive:
    """A drive of a fleet in which every robot strays once.

    Attributes:
        nav: Of the fleet.
        random: Of slips and of messages that are lost or late.
        most: How far a slip goes at most [m].
        nearest: How near two centres came, every tenth of a second [m].
        events: All that was told.
    """

    nav: vs.FleetNavigator
    random: np.random.Generator
    most: float
    margin: float = 0.0
    nearest: float = np.inf
    time: float = 0.0
    events: list[Any] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.lost = float(self.random.choice([0.0, 0.2, 0.5]))
        self.late = int(self.random.choice([0, 3, 10]))
        answers = bool(self.random.random() < 0.8)
        self.carts = {
            name: StrayingCart(one.path, self._slip(), answers)
            for name, one in self.nav.paths.items()
        }
        self.under_way: list[Any] = []

    def _slip(self) -> tuple[float, float]:
        far = self.random.uniform(-self.most, self.most)
        return float(self.random.uniform(2.0, 25.0)), float(far)

    def step(self) -> None:
        tick = round(self.time / PERIOD_S)
        for name, cart in self.carts.items():
            if self.random.random() >= self.lost:
                says = cart.report(name, self.time)
                off = self.random.uniform(-self.margin, self.margin)
                says = vs.ProgressReport(
                    name, says.time, says.distance + off, says.speed, says.arrived, says.holds,
                    says.heard,
                )  # fmt: skip
                self.under_way.append((tick + int(self.random.integers(self.late + 1)), says))
        due = [says for when, says in self.under_way if when <= tick]
        self.under_way = [one for one in self.under_way if one[0] > tick]
        commands, self.nav = self.nav.step(due, self.time)
        self.events += self.nav.events
        for name, cart in self.carts.items():
            if self.random.random() >= self.lost:
                cart.hear(commands[name])
            cart.drive(self.time)
        at = np.array([one.path.at_distance(one.place) for one in self.carts.values()])
        gaps = np.hypot(*np.moveaxis(at[:, None] - at[None], -1, 0)) + 9.0 * np.eye(len(at))
        self.nearest = min(self.nearest, float(gaps.min()))
        self.time += PERIOD_S

    def drive(self, longest: float = 400.0) -> None:
        while self.time < longest and not self.nav.reached:
            self.step()


def straying(seed: int, most: float, margin: float = 0.0) -> StrayingDrive | None:
    """A drive of a random fleet; None: not all are served."""
    random = np.random.default_rng(seed)
    plan = vs.plan_fleet(random_fleet(random))
    if not plan.served:
        return None
    nav = vs.FleetNavigator(plan, period=PERIOD_S, margin_m=margin, warm=False)
    drive = StrayingDrive(nav, random, most, margin)
    drive.drive()
    return drive
