"""A conversation on a link: the only place that reads the clock and moves bytes.

Tested through ``links/mavlink/test_upload_mission``.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Final, TypeVar

from viaspline.errors import LinkError
from viaspline.links.mavlink.common_messages import Heartbeat, MissionAck
from viaspline.links.mavlink.exchange import Said
from viaspline.links.mavlink.find_vehicle import VehicleSearch
from viaspline.links.mavlink.frames import FrameReader, Heard, frame_of
from viaspline.links.mavlink.mav_words import GROUND_STATION, MISSION_CANCELLED, NO_AUTOPILOT
from viaspline.links.mavlink.message import MavlinkMessage
from viaspline.links.mavlink.mission_download import MissionDownload
from viaspline.links.mavlink.mission_upload import MissionUpload
from viaspline.links.mavlink.transport import Transport
from viaspline.links.mavlink.vehicle import Vehicle

OWN_SYSTEM: Final = 245
OWN_COMPONENT: Final = 190
"""Who speaks here: neither number is a usual ground station's or autopilot's."""

BEAT_S: Final = 1.0
"""Between two heartbeats of our own."""

_LOOK_S: Final = 0.05
_OLD_BYTES: Final = 2048
"""What is read at once of what has been waiting; less than that has just come."""
_ACTIVE: Final = 4
_VERSION: Final = 3

Listed = TypeVar("Listed", MissionUpload, MissionDownload)


class Conversation:
    """Messages out and in, with a heartbeat of our own; no thread.

    Args:
        transport: It carries them.
        name: How the link is called in messages.
        clock: Seconds that never run backwards.
        sleep: Lets some of them pass.
        system: Our own number.
    """

    def __init__(
        self,
        transport: Transport,
        name: object,
        *,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], object] = time.sleep,
        system: int = OWN_SYSTEM,
    ) -> None:
        self.name, self.now, self.system = str(name), clock, system
        self._transport, self._sleep = transport, sleep
        self._reader = FrameReader()
        self._sequence = 0
        self._next_beat = -float("inf")

    def say(self, messages: Said) -> None:
        """Send messages.

        Raises:
            OSError: The link is broken.
        """
        for message in messages:
            frame = frame_of(
                message, system=self.system, component=OWN_COMPONENT, sequence=self._sequence
            )
            self._sequence += 1
            self._transport.write(frame)

    def listen(self, timeout: float) -> tuple[Heard, ...]:
        """What has come within a time [s], and a heartbeat of our own if it is due.

        Raises:
            OSError: The link is broken.
        """
        now = self.now()
        if now >= self._next_beat:
            self._next_beat = now + BEAT_S
            self.say((Heartbeat(0, GROUND_STATION, NO_AUTOPILOT, 0, _ACTIVE, _VERSION),))
        self._reader, heard = self._reader.fed(self._transport.read(timeout))
        return heard

    def said_by(self, vehicle: Vehicle, heard: tuple[Heard, ...]) -> Iterator[MavlinkMessage]:
        """What a vehicle's autopilot has said to us, or to everyone."""
        for one in heard:
            meant = getattr(one.message, "target_system", 0) in (0, self.system)
            if meant and (one.system, one.component) == (vehicle.system, vehicle.component):
                yield one.message

    def find(self, wanted: int | None, patience: float) -> tuple[Vehicle, Heartbeat]:
        """The vehicle that is meant, and its last heartbeat.

        Args:
            wanted: Its system; None: the only one.
            patience: How long it is waited for [s].

        Raises:
            LinkError: Nobody answers, or it isn't clear who is meant, or the link breaks.
        """
        search, began = VehicleSearch(wanted), self.now()
        while True:
            now = self.now()
            found = search.found(self.name, now)
            if found is not None:
                return found
            if now - began > patience and (search.first_at is None or wanted is not None):
                raise search.nobody(self.name, patience)
            with self.breaking():
                for heard in self.listen(_LOOK_S):
                    search = search.heard(heard, self.now())

    def carried_out(self, exchange: Listed, vehicle: Vehicle) -> Listed:
        """An exchange with a vehicle, from its beginning to its end.

        Broken off from outside, it tells the vehicle so.

        Raises:
            LinkError: The link breaks.
        """
        try:
            with self.breaking():
                exchange, said = exchange.begun(self.now())
                self.say(said)
                while not exchange.is_over:
                    for message in self.said_by(vehicle, self.listen(_LOOK_S)):
                        exchange, said = exchange.heard(message, self.now())
                        self.say(said)
                    exchange, said = exchange.waited(self.now())
                    self.say(said)
        except BaseException:
            to, at = vehicle.system, vehicle.component
            with suppress(OSError):
                self.say((MissionAck(to, at, MISSION_CANCELLED, exchange.kind),))
            raise
        return exchange

    def forget(self) -> None:
        """Pass over all that has come and wasn't read: it is old."""
        with self.breaking():
            while len(self._transport.read(0.0)) >= _OLD_BYTES:
                pass
        self._reader = FrameReader()

    def rest(self, duration: float) -> None:
        """Let some time pass [s]."""
        self._sleep(duration)

    def close(self) -> None:
        """Let go of the link."""
        self._transport.close()

    @contextmanager
    def breaking(self) -> Iterator[None]:
        """Within the block a link that breaks is an error in words.

        Raises:
            LinkError: It breaks.
        """
        try:
            yield
        except OSError as error:
            why = (error.strerror or str(error)).lower()
            problem = f"the link broke ({why})"
            raise LinkError(self.name, problem, "look at the cable or the network") from None
