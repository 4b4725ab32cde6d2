"""What a vehicle has said of itself last, and when."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

from viaspline.links.mavlink.common_messages import (
    Attitude,
    CommandAck,
    EkfStatusReport,
    EstimatorStatus,
    ExtendedSysState,
    GlobalPositionInt,
    Heartbeat,
    Statustext,
)
from viaspline.links.mavlink.mav_words import ACCEPTED, ARMED, COMMANDS, command_result
from viaspline.links.mavlink.message import MavlinkMessage

ON_GROUND: Final = 1
"""MAV_LANDED_STATE."""

_ATTITUDE, _VELOCITY, _RELATIVE, _ABSOLUTE = 1, 2, 8, 16
_CONSTANT_POSITION: Final = 128
_UNINITIALISED: Final = 1024
"""Bits of ESTIMATOR_STATUS_FLAGS, and of EKF_STATUS_FLAGS, the last one of ArduPilot's only."""


@dataclass(frozen=True)
class Telemetry:
    """The last of each kind of message, with the times when they came [s].

    Attributes:
        beat: Its heartbeat.
        beat_at: Then.
        position: Where it is.
        position_at: Then.
        attitude: How it lies.
        attitude_at: Then.
        health: How well it knows where it is.
        landed: Its MAV_LANDED_STATE; None if it doesn't say.
        ack: What came of the last command.
        text: Its last words.
    """

    beat: Heartbeat | None = None
    beat_at: float = -math.inf
    position: GlobalPositionInt | None = None
    position_at: float = -math.inf
    attitude: Attitude | None = None
    attitude_at: float = -math.inf
    health: EkfStatusReport | EstimatorStatus | None = None
    landed: int | None = None
    ack: CommandAck | None = None
    text: str = ""

    def heard(self, message: MavlinkMessage, now: float) -> Telemetry:
        """The telemetry after a message."""
        if isinstance(message, Heartbeat):
            return replace(self, beat=message, beat_at=now)
        if isinstance(message, GlobalPositionInt):
            return replace(self, position=message, position_at=now)
        if isinstance(message, Attitude):
            return replace(self, attitude=message, attitude_at=now)
        if isinstance(message, EkfStatusReport | EstimatorStatus):
            return replace(self, health=message)
        if isinstance(message, ExtendedSysState):
            return replace(self, landed=message.landed_state)
        if isinstance(message, CommandAck):
            return replace(self, ack=message)
        if isinstance(message, Statustext):
            text = message.text.split(b"\0", 1)[0].decode("utf-8", "replace")
            shown = "".join(one for one in text if one.isprintable())
            return replace(self, text=" ".join(shown.split()))
        return self

    @property
    def pose_at(self) -> float:
        """When the older half of the pose came [s]."""
        return min(self.position_at, self.attitude_at)

    @property
    def last_at(self) -> float:
        """When anything of it came [s]."""
        return max(self.beat_at, self.position_at, self.attitude_at)

    @property
    def is_armed(self) -> bool:
        """Whether it says that it is armed."""
        return self.beat is not None and bool(self.beat.base_mode & ARMED)

    @property
    def mode(self) -> int | None:
        """Its custom mode; None before its first heartbeat."""
        return None if self.beat is None else self.beat.custom_mode

    @property
    def not_ready(self) -> tuple[str, ...]:
        """Why it doesn't know well enough where it is, in words; nothing if it does."""
        missing: list[str] = []
        if self.health is None:
            missing.append("it says nothing of its position estimate (EKF)")
        else:
            missing += _unhealthy(self.health)
        if self.attitude is None:
            missing.append("it says nothing of its heading")
        if self.position is None:
            missing.append("it says nothing of its position")
        elif self.position.lat == 0 and self.position.lon == 0:
            missing.append("it has no place on earth: no GPS fix, and no origin is set")
        return tuple(missing)

    @property
    def reason(self) -> str:
        """What it says to what it was asked for, in brackets; nothing if it says nothing."""
        found: list[str] = []
        ack = self.ack
        if ack is not None and ack.result != ACCEPTED and ack.command in COMMANDS:
            found.append(f"{COMMANDS[ack.command]}: {command_result(ack.result)}")
        if self.text:
            found.append(f"it says “{self.text}”")
        return f" ({'; '.join(found)})" if found else ""


def _unhealthy(health: EkfStatusReport | EstimatorStatus) -> list[str]:
    flags = health.flags
    found = []
    if isinstance(health, EkfStatusReport) and flags & _UNINITIALISED:
        found.append("its position estimate (EKF) isn't initialised")
    if not flags & _ATTITUDE:
        found.append("its EKF has no attitude")
    if not flags & _VELOCITY:
        found.append("its EKF has no velocity")
    if not flags & (_RELATIVE | _ABSOLUTE):
        found.append("its EKF has no position")
    if flags & _CONSTANT_POSITION:
        found.append("its EKF takes its position as constant")
    return found
