"""A vehicle before it is driven: what it says is asked for, and waited for.

Tested through ``links/mavlink/test_vehicle_runner``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Final

from viaspline.links.mavlink.common_messages import GlobalPositionInt
from viaspline.links.mavlink.exchange import Said
from viaspline.links.mavlink.message import MavlinkMessage
from viaspline.links.mavlink.requests import ask_for_streams
from viaspline.links.mavlink.telemetry import Telemetry
from viaspline.links.mavlink.vehicle import Vehicle

AGAIN_S: Final = 2.0
"""Streams are asked for so often until they come."""

FRESH_S: Final = 0.45
"""A vehicle whose positions come less often isn't driven by them."""


@dataclass(frozen=True)
class Preparation:
    """What is known of a vehicle so far.

    Attributes:
        vehicle: It.
        telemetry: What it has said.
        asked_at: When streams were asked for last [s].
        gap: Between its last two positions [s].
    """

    vehicle: Vehicle
    telemetry: Telemetry = field(default_factory=Telemetry)
    asked_at: float = -math.inf
    gap: float = math.inf

    def heard(self, message: MavlinkMessage, now: float) -> Preparation:
        """After a message."""
        gap = self.gap
        if isinstance(message, GlobalPositionInt):
            gap = now - self.telemetry.position_at
        return replace(self, telemetry=self.telemetry.heard(message, now), gap=gap)

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
        elif not missing and max(now - self.telemetry.pose_at, self.gap) > FRESH_S:
            missing = (f"its position comes too seldom to drive by: each {FRESH_S:g} s at least",)
        return missing
