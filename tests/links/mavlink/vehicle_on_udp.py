"""A vehicle in real time, which speaks to a port."""

from __future__ import annotations

import contextlib
import socket
import threading
import time

from pymavlink_vehicle import TICK_S, PymavlinkVehicle


class VehicleOnUdp(threading.Thread):
    """A vehicle in real time that speaks to a port, until it is stopped."""

    def __init__(self, vehicle: PymavlinkVehicle, port: int) -> None:
        super().__init__(daemon=True)
        self.vehicle, self.port, self.is_over = vehicle, port, threading.Event()

    def run(self) -> None:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link:
            link.bind(("127.0.0.1", 0))
            link.setblocking(False)
            began, ticks = time.monotonic(), 0
            while not self.is_over.is_set():
                while ticks * TICK_S < time.monotonic() - began:
                    self.vehicle.tick()
                    ticks += 1
                with contextlib.suppress(BlockingIOError, ConnectionRefusedError):
                    while True:
                        self.vehicle.receive(link.recv(4096))
                said = self.vehicle.taken()
                if said:
                    with contextlib.suppress(ConnectionRefusedError):
                        link.sendto(said, ("127.0.0.1", self.port))
                time.sleep(0.004)

    def __enter__(self) -> VehicleOnUdp:
        self.start()
        return self

    def __exit__(self, *_: object) -> None:
        self.is_over.set()
        self.join()
