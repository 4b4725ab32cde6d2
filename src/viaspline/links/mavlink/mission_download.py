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
from viaspline.links.mavlink.exchange import RETRIES, TIMEOUT_S, Failure, Said
from viaspline.links.mavlink.mav_words import ACCEPTED
from viaspline.links.mavlink.message import MavlinkMessage
from viaspline.links.mavlink.vehicle import Vehicle


@dataclass(frozen=True)
class MissionDownload:
    """A download at one moment: item after item is asked for.

    Attributes:
        vehicle: Whose items they are.
        kind: Its MAV_MISSION_TYPE.
        count: How many there are; None before it is known.
        items: Those that have come.
        since: When something was last said that has no answer yet [s].
        tries: How often it was said again.
        failure: Why not all of them came.
    """

    vehicle: Vehicle
    kind: int
    count: int | None = None
    items: tuple[MissionItemInt, ...] = ()
    since: float = 0.0
    tries: int = 0
    failure: Failure | None = None

    @property
    def is_done(self) -> bool:
        """Whether all items have come."""
        return len(self.items) == self.count

    @property
    def is_over(self) -> bool:
        """Whether it is done, or has failed."""
        return self.is_done or self.failure is not None

    def begun(self, now: float) -> tuple[MissionDownload, Said]:
        """Ask how many items there are."""
        return replace(self, since=now), self._last_said()

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
            return replace(self, failure=Failure(self._item, message.type)), ()
        return self, ()

    def waited(self, now: float) -> tuple[MissionDownload, Said]:
        """Ask again if there is no answer; after some times, give up."""
        if self.is_over or now - self.since < TIMEOUT_S:
            return self, ()
        if self.tries >= RETRIES:
            return replace(self, failure=Failure(self._item, None)), ()
        return replace(self, since=now, tries=self.tries + 1), self._last_said()

    @property
    def _item(self) -> int | None:
        return None if self.count is None else len(self.items)

    def _after(self, next_one: MissionDownload, now: float) -> tuple[MissionDownload, Said]:
        moved = replace(next_one, since=now, tries=0)
        return moved, moved._last_said()

    def _last_said(self) -> Said:
        to, at = self.vehicle.system, self.vehicle.component
        if self.count is None:
            return (MissionRequestList(to, at, self.kind),)
        if self.is_done:
            return (MissionAck(to, at, ACCEPTED, self.kind),)
        return (MissionRequestInt(len(self.items), to, at, self.kind),)
