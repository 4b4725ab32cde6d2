"""A list of items on its way to a vehicle: the mission protocol from the ground station's end.

Source: https://mavlink.io/en/services/mission.html
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from viaspline.links.mavlink.common_messages import (
    MissionAck,
    MissionClearAll,
    MissionCount,
    MissionItemInt,
    MissionRequest,
    MissionRequestInt,
)
from viaspline.links.mavlink.exchange import RETRIES, TIMEOUT_S, Failure, Said
from viaspline.links.mavlink.mav_words import ACCEPTED
from viaspline.links.mavlink.message import MavlinkMessage
from viaspline.links.mavlink.vehicle import Vehicle

OUT_OF_ORDER: Final = 13
"""MAV_MISSION_INVALID_SEQUENCE: an item came twice, as happens when messages are lost; the vehicle
asks again for the one that it wants."""


@dataclass(frozen=True)
class MissionUpload:
    """An upload at one moment.

    The vehicle asks for the items one by one. A list of no items is cleared.

    Attributes:
        vehicle: Whose items they are.
        kind: Its MAV_MISSION_TYPE.
        items: In order, numbered from 0.
        asked: The item that the vehicle has asked for last; -1 before the first.
        since: When something was last said that has no answer yet [s].
        tries: How often it was said again.
        is_done: Whether the vehicle has taken all of it.
        failure: Why it hasn't.
    """

    vehicle: Vehicle
    kind: int
    items: tuple[MissionItemInt, ...]
    asked: int = -1
    since: float = 0.0
    tries: int = 0
    is_done: bool = False
    failure: Failure | None = None

    @property
    def is_over(self) -> bool:
        """Whether it is done, or has failed."""
        return self.is_done or self.failure is not None

    def begun(self, now: float) -> tuple[MissionUpload, Said]:
        """Say how many items there are."""
        return replace(self, since=now), self._last_said()

    def heard(self, message: MavlinkMessage, now: float) -> tuple[MissionUpload, Said]:
        """Take a message: a request for an item, or what came of it all."""
        if self.is_over:
            return self, ()
        if isinstance(message, MissionRequest | MissionRequestInt):
            if message.mission_type != self.kind or message.seq >= len(self.items):
                return self, ()
            asked = replace(self, asked=message.seq, since=now, tries=0)
            return asked, asked._last_said()
        if isinstance(message, MissionAck) and message.mission_type == self.kind:
            return self._answered(message.type), ()
        return self, ()

    def waited(self, now: float) -> tuple[MissionUpload, Said]:
        """Say it again if there is no answer; after some times, give up."""
        if self.is_over or now - self.since < TIMEOUT_S:
            return self, ()
        if self.tries >= RETRIES:
            return replace(self, failure=Failure(self._item, None)), ()
        return replace(self, since=now, tries=self.tries + 1), self._last_said()

    @property
    def _item(self) -> int | None:
        return self.asked if self.asked >= 0 else None

    def _answered(self, result: int) -> MissionUpload:
        if result == OUT_OF_ORDER:
            return self
        if result != ACCEPTED:
            return replace(self, failure=Failure(self._item, result))
        # Before the last item was asked for, it belongs to what was said before this upload.
        return replace(self, is_done=self.asked == len(self.items) - 1)

    def _last_said(self) -> Said:
        to, at = self.vehicle.system, self.vehicle.component
        if not self.items:
            return (MissionClearAll(to, at, self.kind),)
        if self.asked < 0:
            return (MissionCount(len(self.items), to, at, self.kind),)
        return (self.items[self.asked],)
