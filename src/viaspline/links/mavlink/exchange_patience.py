"""How long an exchange waits for an answer: then it says its last words again, and gives up.

Tested through ``links/mavlink/test_mission_upload`` and ``links/mavlink/test_mission_download``.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from typing import Self

from viaspline.links.mavlink.exchange import RETRIES, TIMEOUT_S, Failure, Said
from viaspline.links.mavlink.vehicle import Vehicle


@dataclass(frozen=True)
class PatientExchange(ABC):
    """A list of items on its way, of which the last that was said may be lost.

    Attributes:
        vehicle: Whose items they are.
        kind: Its MAV_MISSION_TYPE.
        since: When something was last said that has no answer yet [s].
        tries: How often it was said again.
        failure: Why not all of them came over.
    """

    vehicle: Vehicle
    kind: int
    since: float = field(default=0.0, kw_only=True)
    tries: int = field(default=0, kw_only=True)
    failure: Failure | None = field(default=None, kw_only=True)

    @property
    @abstractmethod
    def is_done(self) -> bool:
        """Whether all items have come over."""

    @property
    @abstractmethod
    def item(self) -> int | None:
        """Which item it is about now; None: the whole list."""

    @abstractmethod
    def last_said(self) -> Said:
        """What is said again if there is no answer."""

    @property
    def is_over(self) -> bool:
        """Whether it is done, or has failed."""
        return self.is_done or self.failure is not None

    def begun(self, now: float) -> tuple[Self, Said]:
        """Say the first."""
        return replace(self, since=now), self.last_said()

    def waited(self, now: float) -> tuple[Self, Said]:
        """Say it again if there is no answer; after some times, give up."""
        if self.is_over or now - self.since < TIMEOUT_S:
            return self, ()
        if self.tries >= RETRIES:
            return replace(self, failure=Failure(self.item, None)), ()
        return replace(self, since=now, tries=self.tries + 1), self.last_said()
