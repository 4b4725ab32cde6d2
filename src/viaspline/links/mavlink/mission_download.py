"""A list of items on its way from a vehicle: the mission protocol from the ground station's end.

Source: https://mavlink.io/en/services/mission.html
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from viaspline.links.mavlink.common_messages import (
    MissionAck,
    MissionCount,
    MissionItemInt,
    MissionRequestInt,
    MissionRequestList,
)
from viaspline.links.mavlink.exchange import Failure, Said
from viaspline.links.mavlink.exchange_patience import PatientExchange
from viaspline.links.mavlink.mav_words import ACCEPTED
from viaspline.links.mavlink.message import MavlinkMessage


@dataclass(frozen=True)
class MissionDownload(PatientExchange):
    """A download at one moment: item after item is asked for.

    Attributes:
        count: How many there are; None before it is known.
        items: Those that have come.
    """

    count: int | None = None
    items: tuple[MissionItemInt, ...] = ()

    @property
    def is_done(self) -> bool:
        """Whether all items have come."""
        return len(self.items) == self.count

    def heard(self, message: MavlinkMessage, now: float) -> tuple[MissionDownload, Said]:
        """Take a message: how many items there are, one of them, or a refusal."""
        if self.is_over:
            return self, ()
        if isinstance(message, MissionCount) and message.mission_type == self.kind:
            if self.count is not None:
                return self, ()
            return self._after(replace(self, count=message.count), now)
        if isinstance(message, MissionItemInt) and message.mission_type == self.kind:
            if self.count is None or message.seq != len(self.items):
                return self, ()
            return self._after(replace(self, items=(*self.items, message)), now)
        refused = isinstance(message, MissionAck) and message.mission_type == self.kind
        if refused and isinstance(message, MissionAck) and message.type != ACCEPTED:
            return replace(self, failure=Failure(self.item, message.type)), ()
        return self, ()

    @property
    def item(self) -> int | None:
        """The item that is on its way."""
        return None if self.count is None else len(self.items)

    def _after(self, next_one: MissionDownload, now: float) -> tuple[MissionDownload, Said]:
        moved = replace(next_one, since=now, tries=0)
        return moved, moved.last_said()

    def last_said(self) -> Said:
        """The last request or item, or the thanks."""
        to, at = self.vehicle.system, self.vehicle.component
        if self.count is None:
            return (MissionRequestList(to, at, self.kind),)
        if self.is_done:
            return (MissionAck(to, at, ACCEPTED, self.kind),)
        return (MissionRequestInt(len(self.items), to, at, self.kind),)
