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
from viaspline.links.mavlink.exchange import Failure, Said
from viaspline.links.mavlink.exchange_patience import PatientExchange
from viaspline.links.mavlink.mav_words import ACCEPTED
from viaspline.links.mavlink.message import MavlinkMessage

OUT_OF_ORDER: Final = 13
"""MAV_MISSION_INVALID_SEQUENCE: an item came twice, as happens when messages are lost; the vehicle
asks again for the one that it wants."""


@dataclass(frozen=True)
class MissionUpload(PatientExchange):
    """An upload at one moment.

    The vehicle asks for the items one by one. A list of no items is cleared.

    Attributes:
        items: In order, numbered from 0.
        asked: The item that the vehicle has asked for last; -1 before the first.
        taken: Whether the vehicle has taken all of it.
    """

    items: tuple[MissionItemInt, ...]
    asked: int = -1
    taken: bool = False

    @property
    def is_done(self) -> bool:
        """Whether the vehicle has taken all of it."""
        return self.taken

    def heard(self, message: MavlinkMessage, now: float) -> tuple[MissionUpload, Said]:
        """Take a message: a request for an item, or what came of it all."""
        if self.is_over:
            return self, ()
        if isinstance(message, MissionRequest | MissionRequestInt):
            if message.mission_type != self.kind or message.seq >= len(self.items):
                return self, ()
            asked = replace(self, asked=message.seq, since=now, tries=0)
            return asked, asked.last_said()
        if isinstance(message, MissionAck) and message.mission_type == self.kind:
            return self._answered(message.type), ()
        return self, ()

    @property
    def item(self) -> int | None:
        """The item that is on its way."""
        return self.asked if self.asked >= 0 else None

    def _answered(self, result: int) -> MissionUpload:
        if result == OUT_OF_ORDER:
            return self
        if result != ACCEPTED:
            return replace(self, failure=Failure(self.item, result))
        # Before the last item was asked for, it belongs to what was said before this upload.
        return replace(self, taken=self.asked == len(self.items) - 1)

    def last_said(self) -> Said:
        """How many there are, or the item that was asked for last."""
        to, at = self.vehicle.system, self.vehicle.component
        if not self.items:
            return (MissionClearAll(to, at, self.kind),)
        if self.asked < 0:
            return (MissionCount(len(self.items), to, at, self.kind),)
        return (self.items[self.asked],)
