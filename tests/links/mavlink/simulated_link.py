"""A link to vehicles in simulated time, which may lose what it carries, or break."""

from __future__ import annotations

import random
from collections.abc import Callable

from pymavlink_vehicle import TICK_S, PymavlinkVehicle


class SimulatedLink:
    """A transport whose time passes only while somebody reads; it may lose what it carries."""

    def __init__(self, *vehicles: PymavlinkVehicle, loss: float = 0.0, seed: int = 0) -> None:
        self.vehicles, self.loss = vehicles, loss
        self.random = random.Random(seed)
        self.time = 0.0
        self.is_up, self.is_broken = True, False
        self.events: list[tuple[float, Callable[[], object]]] = []
        self.waiting = b""

    def now(self) -> float:
        return self.time

    def at(self, time: float, happens: Callable[[], object]) -> None:
        """Have something happen at a time [s]."""
        self.events.append((time, happens))

    def _lost(self) -> bool:
        return not self.is_up or self.random.random() < self.loss

    def read(self, timeout: float) -> bytes:
        if self.is_broken:
            raise ConnectionResetError("the other end has closed the connection")
        self.sleep(timeout)
        data, self.waiting = self.waiting, b""
        return data

    def sleep(self, timeout: float) -> None:
        """Until something has come, or that time has passed [s]."""
        end = self.time + max(timeout, TICK_S)
        while self.time < end - 1e-9:
            self.time += TICK_S
            due = [happens for time, happens in self.events if time <= self.time]
            self.events = [event for event in self.events if event[0] > self.time]
            for happens in due:
                happens()
            for vehicle in self.vehicles:
                vehicle.tick()
                said = vehicle.taken()
                self.waiting += b"" if self._lost() else said
            if self.waiting:
                break

    def write(self, data: bytes) -> None:
        if self.is_broken:
            raise BrokenPipeError("the other end has closed the connection")
        for vehicle in self.vehicles:
            if not self._lost():
                vehicle.receive(data)
                said = vehicle.taken()
                self.waiting += b"" if self._lost() else said

    def close(self) -> None:
        self.is_up = False
