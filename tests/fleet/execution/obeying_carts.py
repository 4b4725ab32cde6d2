"""Carts that obey the commands of a fleet's navigator, and streets that cross."""

from __future__ import annotations

from dataclasses import dataclass

from straight_drives import CROSS, driven_on

from viaspline.fleet.execution.fleet_messages import FleetCommand, ProgressReport
from viaspline.fleet.execution.fleet_navigator import FleetNavigator

STREETS = [*CROSS, ((0.0, 30.0), (40.0, 30.0))]


@dataclass
class Cart:
    """A robot that obeys commands: in steps of a tenth of a second, with 1 m/s² to stop."""

    name: str
    length: float
    place: float = 0.0
    speed: float = 0.0
    holds: float = 0.0
    heard: float = -1.0

    def report(self, time: float) -> ProgressReport:
        arrived = self.place >= self.length - 1e-6
        return ProgressReport(
            self.name, time, self.place, self.speed, arrived, self.holds, self.heard
        )

    def hear(self, command: FleetCommand) -> None:
        self.heard = command.time
        if command.granted >= self.holds or self.place + self.speed**2 / 2 <= command.granted:
            self.holds = command.granted

    def drive(self, command: FleetCommand) -> None:
        self.place = max(self.place, min(command.distance, self.holds))
        self.speed = command.speed


def carts_of(nav: FleetNavigator) -> list[Cart]:
    return [Cart(name, float(nav._fleet.lengths[i])) for i, name in enumerate(nav.names)]


def start(lines=STREETS, **more) -> FleetNavigator:  # type: ignore[no-untyped-def]
    return FleetNavigator.of(driven_on(lines), **more)
