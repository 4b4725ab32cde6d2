"""A vehicle before it is driven: what it says is asked for, and waited for.

Tested through ``links/mavlink/test_vehicle_drive``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Final

from viaspline.links.mavlink.exchange import Said
from viaspline.links.mavlink.message import MavlinkMessage
from viaspline.links.mavlink.requests import ask_for_streams
from viaspline.links.mavlink.telemetry import Telemetry
from viaspline.links.mavlink.vehicle import Vehicle

AGAIN_S: Final = 2.0
"""Streams are asked for so often until they come."""

FRESH_S: Final = 0.5


@dataclass(frozen=True)
class Preparation:
    """What is known of a vehicle so far.

    Attributes:
        vehicle: It.
        telemetry: What it has said.
        asked_at: When streams were asked for last [s].
    """

    vehicle: Vehicle
    telemetry: Telemetry = field(default_factory=Telemetry)
    asked_at: float = -math.inf

    def heard(self, message: MavlinkMessage, now: float) -> Preparation:
        """After a message."""
        return replace(self, telemetry=self.telemetry.heard(message, now))

    def waited(self, now: float) -> tuple[Preparation, Said]:
        """Ask for what doesn't come."""
        if now - self.asked_at < AGAIN_S or not self.lacking(now):
            return self, ()
        return replace(self, asked_at=now), ask_for_streams(self.vehicle)

    def lacking(self, now: float) -> tuple[str, ...]:
        """What keeps it from being driven, in words; nothing if it is ready."""
        missing = self.telemetry.not_ready
        if self.telemetry.beat is None:
            missing = ("it has no heartbeat", *missing)
        elif not missing and now - self.telemetry.pose_at > FRESH_S:
            missing = ("its pose comes too seldom",)
        return missing
