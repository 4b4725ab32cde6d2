"""A vehicle that is driven, at one moment: messages and time in, messages out.

It is taken over (its mode is changed, once), armed if that is asked for, led along its path, and
brought to hold. Nothing is ever sent to a vehicle after a person has changed its mode.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import Final

from viaspline.formats.local_frame import LocalFrame
from viaspline.links.mavlink.drive_orders import DriveOrders, Ended
from viaspline.links.mavlink.exchange import Said
from viaspline.links.mavlink.mav_words import ACCEPTED, PX4, TAKE_OFF
from viaspline.links.mavlink.message import MavlinkMessage
from viaspline.links.mavlink.pilot import Pilot, Steering
from viaspline.links.mavlink.requests import arm, change_mode, take_off
from viaspline.links.mavlink.setpoints import VehicleMotion, setpoint, standstill
from viaspline.links.mavlink.telemetry import ON_GROUND, Telemetry
from viaspline.links.mavlink.vehicle import Modes, Vehicle
from viaspline.links.mavlink.vehicle_state import VehicleState, vehicle_state

STALE_S: Final = 0.5
"""A pose that is older stops the vehicle."""

LOST_S: Final = 3.0
"""A link that is silent for longer, or a pose that is lost for longer, ends the drive."""

AGAIN_S: Final = 1.0
"""What wasn't done is asked for again after this time."""

STOPPING_S: Final = 5.0
"""So long a vehicle may take to come to rest, and to change to its holding mode."""

STANDS_MPS: Final = 0.08
IN_THE_AIR: Final = 0.95
"""Of the height of a take-off, from which on it has taken off."""


@dataclass(frozen=True)
class VehicleDrive:
    """A drive at one moment.

    Attributes:
        vehicle: Who is driven.
        modes: Its modes.
        pilot: Who steers.
        frame: The mission's.
        orders: What is asked for.
        telemetry: What the vehicle has said last.
        phase: ``take over``, ``arm``, ``take off``, ``drive``, ``settle``, ``land``, ``hold`` or
            ``over``.
        since: When the phase began [s].
        asked_at: When something was asked for last [s].
        first_mode: The mode before it was taken over.
        time: How long it was led [s].
        ticked_at: The last moment [s].
        led: Whether it was led then.
        ending: How it will have ended when it holds.
        farthest: How far it was off its path [m].
        news: What has happened in the last step, in words.
    """

    vehicle: Vehicle
    modes: Modes
    pilot: Pilot
    frame: LocalFrame
    orders: DriveOrders
    telemetry: Telemetry
    phase: str = "take over"
    since: float = -math.inf
    asked_at: float = -math.inf
    first_mode: int | None = None
    time: float = 0.0
    ticked_at: float = 0.0
    led: bool = False
    ending: Ended | None = None
    farthest: float = 0.0
    news: tuple[str, ...] = field(default=())

    @property
    def ended(self) -> Ended | None:
        """How it has ended; None while it goes on."""
        return self.ending if self.phase == "over" else None

    def begun(self, now: float) -> VehicleDrive:
        """The drive at its beginning."""
        return replace(self, since=now, ticked_at=now, first_mode=self.telemetry.mode)

    def heard(self, message: MavlinkMessage, now: float) -> VehicleDrive:
        """The drive after a message."""
        return replace(self, telemetry=self.telemetry.heard(message, now))

    def ticked(self, now: float) -> tuple[VehicleDrive, Said]:
        """What to say now."""
        here = replace(self, news=())
        if here.phase == "over":
            return here, ()
        taken = here._taken_by_a_person()
        if taken is not None:
            return here._over(taken), ()
        if here.phase != "hold" and now - here.telemetry.last_at > LOST_S:
            words = f"the link was lost: nothing was heard for {LOST_S:g} s"
            here = here._holding(Ended(False, words), now)
        step = {
            "take over": VehicleDrive._take_over, "arm": VehicleDrive._arm,
            "take off": VehicleDrive._take_off, "drive": VehicleDrive._drive,
            "settle": VehicleDrive._settle, "land": VehicleDrive._land, "hold": VehicleDrive._hold,
        }[here.phase]  # fmt: skip
        after, said = step(here, now)
        return replace(after, ticked_at=now, led=here.phase == "drive" and after.led), said

    def interrupted(self, now: float) -> VehicleDrive:
        """The drive that somebody has broken off: it stops and holds."""
        if self.phase == "over":
            return self
        if self.phase == "take over" and self.asked_at == -math.inf:
            return self._over(Ended(False, "interrupted before the vehicle was taken over"))
        return self if self.phase == "hold" else self._holding(Ended(False, "interrupted"), now)

    # what it does in each phase

    def _take_over(self, now: float) -> tuple[VehicleDrive, Said]:
        if self.telemetry.mode == self.modes.guided:
            name = self.vehicle.mode_name(self.modes.guided)
            return self._in_phase("arm", now, f"the vehicle is in {name}"), self._still(now)
        if now - self.since > self.orders.patience:
            name = self.vehicle.mode_name(self.modes.guided)
            words = (
                f"it didn't change to {name} in {self.orders.patience:g} s{self.telemetry.reason}"
            )
            return self._over(Ended(False, words)), ()
        # PX4 is only taken over by who sends setpoints already.
        if now - self.since < AGAIN_S or now - self.asked_at < AGAIN_S:
            return self, self._still(now)
        said = (*self._still(now), change_mode(self.vehicle, self.modes.guided))
        return replace(self, asked_at=now), said

    def _arm(self, now: float) -> tuple[VehicleDrive, Said]:
        if self.telemetry.is_armed:
            is_off = self.pilot.takeoff_m is not None and not self._is_in_the_air()
            phase = "take off" if is_off else "drive"
            return self._in_phase(phase, now, "the vehicle is armed"), self._still(now)
        if now - self.since > self.orders.patience:
            words = f"it couldn't be armed in {self.orders.patience:g} s{self.telemetry.reason}"
            if not self.orders.arms:
                words = "it isn't armed, and nobody has asked for that: arm it, or give --arm"
            return self._holding(Ended(False, words), now), self._still(now)
        if not self.orders.arms or now - self.asked_at < AGAIN_S:
            return self, self._still(now)
        return replace(self, asked_at=now), (*self._still(now), arm(self.vehicle))

    def _take_off(self, now: float) -> tuple[VehicleDrive, Said]:
        if not self.telemetry.is_armed:
            return self._over(Ended(False, "it was disarmed while it took off")), ()
        if self._is_in_the_air():
            return self._in_phase("drive", now, "in the air"), self._still(now)
        height = self.pilot.takeoff_m
        assert height is not None
        if now - self.since > self.orders.patience + 2.0 * height:
            words = f"it didn't take off{self.telemetry.reason}"
            return self._holding(Ended(False, words), now), self._still(now)
        if self.vehicle.autopilot == PX4:  # its take-off is a mode of its own
            state = self._state(now)
            return self, self._do(
                VehicleMotion(0.0, 0.0, (0.0, 0.0, 1.0), state.heading), state, now
            )
        if now - self.asked_at < AGAIN_S or self._has_left_the_ground():
            return self, ()
        return replace(self, asked_at=now), (take_off(self.vehicle, height),)

    def _drive(self, now: float) -> tuple[VehicleDrive, Said]:
        if not self.telemetry.is_armed:
            return self._over(Ended(False, "it was disarmed under way")), ()
        lost = self._lost_pose(now)
        if lost:
            return self._stopped(lost, now)
        state = self._state(now)
        time = self.time + (now - self.ticked_at if self.led else 0.0)
        pilot, steering = self.pilot.steered(state, time)
        after = replace(
            self, pilot=pilot, time=time, led=True, since=now, news=steering.news,
            farthest=max(self.farthest, steering.beside),
        )  # fmt: skip
        return after._led_on(steering, state, now)

    def _led_on(
        self, steering: Steering, state: VehicleState, now: float
    ) -> tuple[VehicleDrive, Said]:
        """What comes of what the pilot has decided."""
        if steering.beside > self.pilot.allowed_m:
            off = f"{steering.beside:.2f} m off its path"
            words = f"it was {off}, and {self.pilot.allowed_m:.2f} m are proven clear"
            return self._holding(Ended(False, words), now), self._still(now)
        if not steering.is_over:
            return self, self._do(steering.motion, state, now)
        if steering.failed is not None:
            return self._holding(Ended(False, steering.failed), now), self._still(now)
        phase = "land" if self.pilot.lands else "settle"
        return self._in_phase(phase, now, "at the end of its path"), self._still(now)

    def _stopped(self, lost: str, now: float) -> tuple[VehicleDrive, Said]:
        """Standing still while it isn't known where it is; after a while, for good."""
        stops = replace(self, led=False, news=(f"{lost}: it stops",) if self.led else ())
        if now - self.since <= LOST_S:  # since it was led last
            return stops, self._still(now)
        words = f"{lost}, for more than {LOST_S:g} s"
        return stops._holding(Ended(False, words), now), self._still(now)

    def _settle(self, now: float) -> tuple[VehicleDrive, Said]:
        position = self.telemetry.position
        assert position is not None
        speed = math.hypot(position.vx, position.vy) / 100.0
        rests = now - self.since > AGAIN_S and speed < STANDS_MPS
        if rests or now - self.since > STOPPING_S:
            return self._holding(Ended(True, "it has reached its goal"), now), self._still(now)
        return self, self._still(now)

    def _land(self, now: float) -> tuple[VehicleDrive, Said]:
        assert self.modes.land is not None
        if not self.telemetry.is_armed or self.telemetry.landed == ON_GROUND:
            return self._over(Ended(True, "it has landed")), ()
        if self.telemetry.mode == self.modes.land:
            return self, ()
        if now - self.asked_at < AGAIN_S:
            return self, self._still(now)
        said = (*self._still(now), change_mode(self.vehicle, self.modes.land))
        return replace(self, asked_at=now), said

    def _hold(self, now: float) -> tuple[VehicleDrive, Said]:
        assert self.ending is not None
        if self.telemetry.mode not in (self.modes.guided, self.modes.hold, self.modes.land):
            # It was never taken over, or a person has it again: its heartbeat will tell.
            return (
                (self, ()) if now - self.since <= 1.2 * AGAIN_S else (self._over(self.ending), ())
            )
        if self.telemetry.mode == self.modes.hold and self.telemetry.beat_at >= self.since:
            name = self.vehicle.mode_name(self.modes.hold)
            return self._over(Ended(self.ending.reached, f"{self.ending.words}; {name}")), ()
        if now - self.since > STOPPING_S:
            name = self.vehicle.mode_name(self.modes.hold)
            words = (
                f"{self.ending.words}; it was told to stop, and hasn't said that it is in {name}"
            )
            return self._over(Ended(self.ending.reached, words)), self._still(now)
        if now - self.asked_at < AGAIN_S:
            return self, self._still(now)
        said = (*self._still(now), change_mode(self.vehicle, self.modes.hold))
        return replace(self, asked_at=now), said

    # what it knows

    def _taken_by_a_person(self) -> Ended | None:
        """Whether a mode is on that nobody here has asked for."""
        ours = {
            "take over": (self.first_mode, self.modes.guided),
            "land": (self.modes.guided, self.modes.land),
            "hold": (self.modes.guided, self.modes.hold, self.modes.land, self.first_mode),
        }.get(self.phase, (self.modes.guided,))
        mode = self.telemetry.mode
        if mode is None or mode in ours:
            return None
        name = self.vehicle.mode_name(mode)
        return Ended(False, f"its mode was changed to {name}: it isn't driven from here any more")

    def _lost_pose(self, now: float) -> str:
        """Why it can't be led now; nothing if it can."""
        age = now - self.telemetry.pose_at
        if age > STALE_S:
            return f"its last pose is {age:.1f} s old"
        return "; ".join(self.telemetry.not_ready)

    def _is_in_the_air(self) -> bool:
        height, position = self.pilot.takeoff_m, self.telemetry.position
        assert position is not None
        return height is None or position.relative_alt / 1e3 >= IN_THE_AIR * height

    def _has_left_the_ground(self) -> bool:
        ack = self.telemetry.ack
        return ack is not None and ack.command == TAKE_OFF and ack.result == ACCEPTED

    # what it says

    def _state(self, now: float) -> VehicleState:
        return vehicle_state(self.telemetry, self.frame, now)

    def _do(self, motion: VehicleMotion, state: VehicleState, now: float) -> Said:
        return (setpoint(self.vehicle, motion, state.heading, now),)

    def _still(self, now: float) -> Said:
        """Be still, wherever it is."""
        state = self._state(self.telemetry.attitude_at)
        return self._do(standstill(state), state, now)

    # where it goes on

    def _in_phase(self, phase: str, now: float, news: str) -> VehicleDrive:
        return replace(self, phase=phase, since=now, asked_at=-math.inf, news=(*self.news, news))

    def _holding(self, ending: Ended, now: float) -> VehicleDrive:
        return replace(self, phase="hold", since=now, asked_at=-math.inf, ending=ending)

    def _over(self, ending: Ended) -> VehicleDrive:
        return replace(self, phase="over", ending=ending)
