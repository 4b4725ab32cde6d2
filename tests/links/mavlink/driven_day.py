"""A day of driving a vehicle in simulated time, with whatever goes wrong on it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from pymavlink_vehicle import ORIGIN, PymavlinkVehicle
from simulated_link import SimulatedLink

from viaspline.formats.local_frame import LocalFrame
from viaspline.links.mavlink.conversation import Conversation
from viaspline.links.mavlink.drive_orders import DriveOrders, Ended
from viaspline.links.mavlink.pilot import Steering
from viaspline.links.mavlink.setpoints import VehicleMotion
from viaspline.links.mavlink.vehicle_drive import VehicleDrive
from viaspline.links.mavlink.vehicle_runner import VehicleRunner, prepared
from viaspline.links.mavlink.vehicle_state import VehicleState


@dataclass(frozen=True)
class AheadPilot:
    """Drives straight on at 1 m/s, for so many metres."""

    metres: float = 1e6
    allowed_m: float = 1.0
    takeoff_m: float | None = None
    lands: bool = False
    does: Callable[[float], object] = lambda time: None

    def too_far(self, state: VehicleState) -> str | None:
        return None

    def steered(self, state: VehicleState, time: float) -> tuple["AheadPilot", Steering]:
        assert time < 120.0, "it drives on and on"
        self.does(time)
        motion = VehicleMotion(1.0, 0.0, (1.0, 0.0, 0.0), 0.0)
        return self, Steering(motion, abs(state.y), state.x >= self.metres)


class Day:
    """A vehicle, its link, and a drive over it."""

    def __init__(self, vehicle: PymavlinkVehicle, *others: PymavlinkVehicle) -> None:
        self.vehicle, self.told = vehicle, list[str]()
        self.link = SimulatedLink(vehicle, *others)
        self.talk = Conversation(self.link, "udp:test", clock=self.link.now, sleep=self.link.sleep)

    def drive(self, pilot: Any = None, *, arms: bool = True, patience: float = 5.0) -> Ended:
        found, _ = self.talk.find(self.vehicle.system, 10.0)
        telemetry = prepared(self.talk, found, patience, self.told.append)
        assert found.modes is not None
        orders, frame = DriveOrders(arms, patience), LocalFrame(*ORIGIN)
        drive = VehicleDrive(found, found.modes, pilot or AheadPilot(), frame, orders, telemetry)
        self.runner = VehicleRunner(self.talk, drive, self.told.append)
        return self.runner.run()

    def commands(self, number: int) -> list[Any]:
        """The commands of a kind that the vehicle was given."""
        heard = self.vehicle.heard
        return [one for one in heard if getattr(one, "command", None) == number]


def all_but(answer: Callable[[Any], None], unknown: int) -> Callable[[Any], None]:
    """An answer to every command but one."""
    return lambda message: None if message.command == unknown else answer(message)
