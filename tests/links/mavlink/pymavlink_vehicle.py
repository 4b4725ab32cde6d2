"""A vehicle that speaks through pymavlink, an implementation that isn't ours, in simulated time.

It moves as a unicycle whose speed and yaw rate follow their commands with a lag, or hovers; it is
as fussy as autopilots are: only in its guided mode does it move, only armed, and no longer than
three seconds after the last command.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from typing import Any

os.environ["MAVLINK20"] = "1"
from pymavlink.dialects.v20 import ardupilotmega as dialect

ROVER, BOAT, COPTER = 10, 11, 2
ARDUPILOT, PX4 = 3, 12
TICK_S = 0.01
HEALTHY = 1 | 2 | 4 | 8 | 16 | 32 | 256 | 512
ORIGIN = (47.1, 8.2)


def metres_per_degree(latitude: float) -> tuple[float, float]:
    """Of latitude and of longitude on the WGS 84 ellipsoid, by its radii of curvature."""
    a, e2 = 6378137.0, 6.69437999014e-3
    w = 1.0 - e2 * math.sin(math.radians(latitude)) ** 2
    meridian, normal = a * (1 - e2) / w**1.5, a / math.sqrt(w)
    return math.radians(meridian), math.radians(normal * math.cos(math.radians(latitude)))


class _Out:
    """Where pymavlink writes its frames."""

    def __init__(self) -> None:
        self.data = b""

    def write(self, data: bytes) -> None:
        self.data += bytes(data)


class PymavlinkVehicle:
    """An autopilot with its board, its modes and its motion."""

    def __init__(
        self, *, system: int = 1, autopilot: int = ARDUPILOT, kind: int = ROVER,
        at: tuple[float, float] = (0.0, 0.0), heading: float = 0.0, lag: float = 0.2,
    ) -> None:  # fmt: skip
        self.system, self.autopilot, self.kind = system, autopilot, kind
        self.out = _Out()
        self.link = dialect.MAVLink(self.out, srcSystem=system, srcComponent=1)
        self.parser = dialect.MAVLink(None)
        self.parser.robust_parsing = True
        # its board
        self.board: dict[int, list[Any]] = {0: [], 1: [], 2: []}
        self.coming: list[Any] = []
        self.expected: tuple[int, int] | None = None  # list, count
        self.asked_at = 0.0
        self.refuses: tuple[int, int] | None = None  # item, result
        self.keeps_old = autopilot == PX4
        self.unsupported: set[int] = set()
        self.changes: Callable[[Any], Any] = lambda item: item
        # its state
        self.mode = 0 if autopilot == ARDUPILOT else 1 << 16
        self.armed, self.arms = False, True
        self.takes_mode = True
        self.ekf = HEALTHY
        self.has_position, self.beats = True, True
        self.x, self.y, self.up, self.heading = *at, 0.0, heading
        self.speed = self.rate = self.climb = 0.0
        self.velocity = (0.0, 0.0)
        self.lag = lag
        self.target: Any = None
        self.target_at = -math.inf
        self.taking_off: float | None = None
        self.now = 0.0
        self.intervals: dict[int, float] = {}
        self.last_sent: dict[int, float] = {}
        self.heard: list[Any] = []
        self.setpoints: list[tuple[float, Any]] = []
        self.trace: list[tuple[float, float, float, float]] = []

    # what it says

    def taken(self) -> bytes:
        """What it has said since it was asked last."""
        data, self.out.data = self.out.data, b""
        return data

    def _due(self, number: int, interval: float) -> bool:
        if self.now - self.last_sent.get(number, -math.inf) < interval - 1e-9:
            return False
        self.last_sent[number] = self.now
        return True

    def _speak(self) -> None:
        boot = int(self.now * 1000)
        if self.beats and self._due(0, 1.0):
            base = 1 | (128 if self.armed else 0)
            self.link.heartbeat_send(self.kind, self.autopilot, base, self.mode, 4, 3)
        for number, interval in self.intervals.items():
            if not self._due(number, interval):
                continue
            if number == 33 and self.has_position:
                self._say_position(boot)
            elif number == 30:
                yaw = math.remainder(math.pi / 2 - self.heading, math.tau)
                self.link.attitude_send(boot, 0.0, 0.0, yaw, 0.0, 0.0, -self.rate)
            elif number == 193 and self.autopilot == ARDUPILOT:
                self.link.ekf_status_report_send(self.ekf, 0.1, 0.1, 0.1, 0.1, 0.0)
            elif number == 230 and self.autopilot == PX4:
                self.link.estimator_status_send(boot * 1000, self.ekf, *([0.1] * 8))
            elif number == 245:
                self.link.extended_sys_state_send(0, 1 if self.up < 0.1 else 2)

    def _say_position(self, boot: int) -> None:
        north, east = metres_per_degree(ORIGIN[0])
        lat, lon = ORIGIN[0] + self.y / north, ORIGIN[1] + self.x / east
        if self.kind == COPTER:
            vx, vy = self.velocity
        else:
            vx, vy = self.speed * math.cos(self.heading), self.speed * math.sin(self.heading)
        down = -self.climb
        compass = math.degrees(math.pi / 2 - self.heading) % 360.0
        self.link.global_position_int_send(
            boot, round(lat * 1e7), round(lon * 1e7), 400_000 + round(self.up * 1e3),
            round(self.up * 1e3), round(vy * 100), round(vx * 100), round(down * 100),
            int(compass * 100),
        )  # fmt: skip

    # what it hears

    def receive(self, data: bytes) -> None:
        for message in self.parser.parse_buffer(data) or []:
            if message.get_type() == "BAD_DATA":
                continue
            if getattr(message, "target_system", self.system) not in (0, self.system):
                continue
            self.heard.append(message)
            answer = getattr(self, f"_on_{message.get_type().lower()}", None)
            if answer is not None:
                answer(message)

    def _on_mission_count(self, message: Any) -> None:
        if message.mission_type in self.unsupported:
            self._ack(message.mission_type, 3)
            return
        self.expected, self.coming = (message.mission_type, message.count), []
        if not self.keeps_old:
            self.board[message.mission_type] = self.board[message.mission_type][: message.count]
        self._ask()

    def _ask(self) -> None:
        assert self.expected is not None
        self.asked_at = self.now
        self.link.mission_request_int_send(245, 190, len(self.coming), self.expected[0])

    def _on_mission_item_int(self, message: Any) -> None:
        if self.expected is None or message.mission_type != self.expected[0]:
            self._ack(message.mission_type, 1)
            return
        kind, count = self.expected
        if message.seq != len(self.coming):
            self._ack(kind, 13)
            return
        if self.refuses is not None and kind == 0 and message.seq == self.refuses[0]:
            self._ack(kind, self.refuses[1])
            self.expected = None
            return
        self.coming.append(self.changes(message))
        if not self.keeps_old:  # as ArduPilot has it
            board = self.board[kind]
            board[len(self.coming) - 1 : len(self.coming)] = [self.coming[-1]]
        if len(self.coming) == count:
            self.board[kind] = list(self.coming)
            self.expected = None
            self._ack(kind, 0)
        else:
            self._ask()

    def _on_mission_clear_all(self, message: Any) -> None:
        if message.mission_type in self.unsupported:
            self._ack(message.mission_type, 3)
            return
        self.board[message.mission_type] = []
        self._ack(message.mission_type, 0)

    def _on_mission_request_list(self, message: Any) -> None:
        if message.mission_type in self.unsupported:
            self._ack(message.mission_type, 3)
            return
        count = len(self.board[message.mission_type])
        self.link.mission_count_send(245, 190, count, message.mission_type)

    def _on_mission_request_int(self, message: Any) -> None:
        item = self.board[message.mission_type][message.seq]
        self.link.mission_item_int_send(
            245, 190, message.seq, item.frame, item.command, item.current, item.autocontinue,
            item.param1, item.param2, item.param3, item.param4, item.x, item.y, item.z,
            message.mission_type,
        )  # fmt: skip

    def _ack(self, kind: int, result: int) -> None:
        self.link.mission_ack_send(245, 190, result, kind)

    def _on_request_data_stream(self, message: Any) -> None:
        rate = message.req_message_rate
        streams = {6: (33,), 10: (30,), 12: (193,), 2: ()}
        for number in streams.get(message.req_stream_id, ()):
            if self.autopilot == ARDUPILOT and rate:
                self.intervals.setdefault(number, 1.0 / rate)

    def _on_command_long(self, message: Any) -> None:
        command, result = message.command, 0
        if command == 511:
            self.intervals[int(message.param1)] = message.param2 / 1e6
        elif command == 176:
            result = 0 if self._takes_mode(message) else 4
        elif command == 400:
            result = 0 if self.arms else 4
            self.armed = self.armed or (self.arms and message.param1 == 1.0)
        elif command == 22:
            result = 0 if self.armed else 4
            self.taking_off = message.param7 if self.armed else None
        else:
            result = 3
        self.link.command_ack_send(command, result, 0, 0, 245, 190)

    def _takes_mode(self, message: Any) -> bool:
        if not self.takes_mode or not int(message.param1) & 1:
            return False
        if self.autopilot == PX4:
            wanted = int(message.param2) << 16 | int(message.param3) << 24
            if wanted == 6 << 16 and self.now - self.target_at > 0.5:
                return False
            self.mode = wanted
        else:
            self.mode = int(message.param2)
        return True

    def _on_set_position_target_local_ned(self, message: Any) -> None:
        self.setpoints.append((self.now, message))
        self.target, self.target_at = message, self.now

    # how it moves

    @property
    def is_guided(self) -> bool:
        if self.autopilot == PX4:
            return self.mode == 6 << 16
        return self.mode == (4 if self.kind == COPTER else 15)

    def tick(self) -> None:
        """A hundredth of a second."""
        self.now += TICK_S
        if self.expected is not None and self.now - self.asked_at > 1.0:
            self._ask()
        if self.kind == COPTER:
            self._fly()
        else:
            self._drive()
        self.trace.append((self.now, self.x, self.y, self.up))
        self._speak()

    def _commanded(self) -> Any:
        is_fresh = self.now - self.target_at < 3.0
        return self.target if self.armed and self.is_guided and is_fresh else None

    def _drive(self) -> None:
        wanted, target = (0.0, 0.0), self._commanded()
        if target is not None and self.autopilot == ARDUPILOT:
            # As its rovers take it: the sign of vx is the direction, yaw rate clockwise.
            assert target.type_mask & 0b110111111111 == 0b010111000111
            speed = math.copysign(math.hypot(target.vx, target.vy), target.vx)
            wanted = (speed, -target.yaw_rate)
        elif target is not None:
            # As PX4's rovers take it: a speed, and a bearing that the body turns to.
            assert target.coordinate_frame == 1
            speed = math.hypot(target.vx, target.vy)
            bearing = math.atan2(target.vx, target.vy) if speed else self.heading
            wanted = (speed, 2.0 * math.remainder(bearing - self.heading, math.tau))
        share = TICK_S / max(self.lag, TICK_S)
        self.speed += share * (wanted[0] - self.speed)
        self.rate += share * (wanted[1] - self.rate)
        self.heading += self.rate * TICK_S
        self.x += self.speed * math.cos(self.heading) * TICK_S
        self.y += self.speed * math.sin(self.heading) * TICK_S

    def _fly(self) -> None:
        wanted, climb, target = (0.0, 0.0), 0.0, self._commanded()
        if self.mode in (9, 4 << 16 | 6 << 24):  # LAND
            climb = -0.7
            self.armed = self.armed and self.up > 0.0
        if self.taking_off is not None and self.armed and self.is_guided:
            climb = min(max(self.taking_off - self.up, -1.0), 1.0)
            if abs(self.taking_off - self.up) < 0.05:
                self.taking_off = None
        elif target is not None and (self.up > 0.05 or self.autopilot == PX4):
            assert target.coordinate_frame == 1
            assert target.type_mask & 0b110111111111 == 0b100111000111
            wanted, climb = (target.vy, target.vx), -target.vz
            heading = math.pi / 2 - target.yaw
            turn = math.remainder(heading - self.heading, math.tau)
            self.heading += min(max(turn, -1.0 * TICK_S), 1.0 * TICK_S)
        share = TICK_S / max(self.lag, TICK_S)
        vx, vy = self.velocity
        self.velocity = (vx + share * (wanted[0] - vx), vy + share * (wanted[1] - vy))
        self.climb += share * (climb - self.climb)
        self.x += self.velocity[0] * TICK_S
        self.y += self.velocity[1] * TICK_S
        self.up = max(self.up + self.climb * TICK_S, 0.0)


def items_like(count: int, kind: int = 0) -> Sequence[Any]:
    """Way points in a row, as pymavlink has them."""
    return [
        dialect.MAVLink_mission_item_int_message(
            1, 1, k, 3, 16, 0, 1, 0.0, 0.0, 0.0, 0.0, 471000000 + 100 * k, 82000000, 5.0, kind
        )
        for k in range(count)
    ]
