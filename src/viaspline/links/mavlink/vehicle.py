"""Who is at the other end: an autopilot, and how its kind names modes and items."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, NamedTuple

from viaspline.links.mavlink.common_messages import Heartbeat
from viaspline.links.mavlink.mav_words import (
    ARDUPILOT,
    AUTOPILOTS,
    COPTERS,
    CUSTOM_MODE,
    PX4,
    ROVERS,
    TYPES,
)


class Modes(NamedTuple):
    """The custom modes that matter here, as a heartbeat shows them.

    Attributes:
        guided: In which it does what it is told.
        hold: In which it stays where it is.
        land: In which it lands; None if it doesn't fly.
        mission: In which it drives the mission on board.
    """

    guided: int
    hold: int
    land: int | None
    mission: int


def _px4(main: int, sub: int = 0) -> int:
    return main << 16 | sub << 24


_ROVER: Final = Modes(guided=15, hold=4, land=None, mission=10)
_COPTER: Final = Modes(guided=4, hold=17, land=9, mission=3)
_PX4: Final = Modes(guided=_px4(6), hold=_px4(4, 3), land=_px4(4, 6), mission=_px4(4, 4))

_ROVER_NAMES: Final[Mapping[int, str]] = {
    0: "MANUAL", 1: "ACRO", 3: "STEERING", 4: "HOLD", 5: "LOITER", 6: "FOLLOW", 7: "SIMPLE",
    8: "DOCK", 9: "CIRCLE", 10: "AUTO", 11: "RTL", 12: "SMART_RTL", 15: "GUIDED",
    16: "INITIALISING",
}  # fmt: skip
_COPTER_NAMES: Final[Mapping[int, str]] = {
    0: "STABILIZE", 1: "ACRO", 2: "ALT_HOLD", 3: "AUTO", 4: "GUIDED", 5: "LOITER", 6: "RTL",
    7: "CIRCLE", 9: "LAND", 11: "DRIFT", 13: "SPORT", 16: "POSHOLD", 17: "BRAKE",
    20: "GUIDED_NOGPS", 21: "SMART_RTL",
}  # fmt: skip
_PX4_NAMES: Final[Mapping[int, str]] = {
    _px4(1): "MANUAL", _px4(2): "ALTITUDE", _px4(3): "POSITION", _px4(4, 2): "TAKEOFF",
    _px4(4, 3): "HOLD", _px4(4, 4): "MISSION", _px4(4, 5): "RETURN", _px4(4, 6): "LAND",
    _px4(5): "ACRO", _px4(6): "OFFBOARD", _px4(7): "STABILIZED",
}  # fmt: skip


@dataclass(frozen=True)
class Vehicle:
    """An autopilot on a link.

    Attributes:
        system: Its number, by which it is spoken to.
        component: The number of its autopilot.
        autopilot: Its MAV_AUTOPILOT.
        kind: Its MAV_TYPE.
    """

    system: int
    component: int
    autopilot: int
    kind: int

    @classmethod
    def of(cls, system: int, component: int, heartbeat: Heartbeat) -> Vehicle:
        """The vehicle whose heartbeat this is."""
        return cls(system, component, heartbeat.autopilot, heartbeat.type)

    def __str__(self) -> str:
        maker = AUTOPILOTS.get(self.autopilot, f"autopilot {self.autopilot}")
        return f"system {self.system} ({maker} {TYPES.get(self.kind, f'type {self.kind}')})"

    @property
    def is_rover(self) -> bool:
        """Whether it drives or swims."""
        return self.kind in ROVERS

    @property
    def is_copter(self) -> bool:
        """Whether it can hover."""
        return self.kind in COPTERS

    @property
    def item_0_is_home(self) -> bool:
        """Whether the first item of its mission is its home, as ArduPilot has it."""
        return self.autopilot == ARDUPILOT

    @property
    def modes(self) -> Modes | None:
        """Its modes; None if they aren't known here.

        >>> Vehicle(1, 1, ARDUPILOT, 10).modes.guided, Vehicle(1, 1, PX4, 2).modes.guided
        (15, 393216)
        """
        if self.autopilot == PX4 and (self.is_rover or self.is_copter):
            return _PX4
        if self.autopilot == ARDUPILOT and (self.is_rover or self.is_copter):
            return _ROVER if self.is_rover else _COPTER
        return None

    def mode_name(self, custom_mode: int) -> str:
        """What people call one of its modes.

        >>> Vehicle(1, 1, ARDUPILOT, 11).mode_name(15), Vehicle(1, 1, PX4, 2).mode_name(67371008)
        ('GUIDED', 'MISSION')
        """
        names = _COPTER_NAMES if self.is_copter else _ROVER_NAMES
        names = _PX4_NAMES if self.autopilot == PX4 else names
        return names.get(custom_mode, f"mode {custom_mode}")

    def mode_params(self, custom_mode: int) -> tuple[float, float, float]:
        """The parameters of MAV_CMD_DO_SET_MODE that lead to one of its modes.

        >>> Vehicle(1, 1, PX4, 2).mode_params(67371008)
        (1.0, 4.0, 4.0)
        """
        if self.autopilot == PX4:
            main, sub = custom_mode >> 16 & 0xFF, custom_mode >> 24
            return float(CUSTOM_MODE), float(main), float(sub)
        return float(CUSTOM_MODE), float(custom_mode), 0.0
