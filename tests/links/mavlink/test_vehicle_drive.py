"""Bad days of a drive: each ends as it should, and nobody moves who shouldn't."""

import math
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pytest

sys.path.insert(0, str(Path(__file__).parent))
from pymavlink_vehicle import (
    ARDUPILOT,
    COPTER,
    HEALTHY,
    ORIGIN,
    PX4,
    PymavlinkVehicle,
    SimulatedLink,
)

from viaspline.errors import LinkError
from viaspline.formats.local_frame import LocalFrame
from viaspline.links.mavlink.conversation import Conversation
from viaspline.links.mavlink.drive_orders import DriveOrders, Ended
from viaspline.links.mavlink.pilot import Steering
from viaspline.links.mavlink.setpoints import VehicleMotion
from viaspline.links.mavlink.vehicle_drive import VehicleDrive
from viaspline.links.mavlink.vehicle_runner import VehicleRunner, prepared
from viaspline.links.mavlink.vehicle_state import VehicleState


@dataclass(frozen=True)
class AheadPilot:
    """Drives straight on at 1 m/s, for so many metres."""

    metres: float = 1e6
    allowed_m: float = 1.0
    takeoff_m: float | None = None
    lands: bool = False
    does: Callable[[float], object] = lambda time: None

    def too_far(self, state: VehicleState) -> str | None:
        return None

    def steered(self, state: VehicleState, time: float) -> tuple["AheadPilot", Steering]:
        assert time < 120.0, "it drives on and on"
        self.does(time)
        motion = VehicleMotion(1.0, 0.0, (1.0, 0.0, 0.0), 0.0)
        return self, Steering(motion, abs(state.y), state.x >= self.metres)


class Day:
    """A vehicle, its link, and a drive over it."""

    def __init__(self, vehicle: PymavlinkVehicle, *others: PymavlinkVehicle) -> None:
        self.vehicle, self.told = vehicle, list[str]()
        self.link = SimulatedLink(vehicle, *others)
        self.talk = Conversation(self.link, "udp:test", clock=self.link.now, sleep=self.link.sleep)

    def drive(self, pilot: Any = None, *, arms: bool = True, patience: float = 5.0) -> Ended:
        found, _ = self.talk.find(self.vehicle.system, 10.0)
        telemetry = prepared(self.talk, found, patience, self.told.append)
        assert found.modes is not None
        orders, frame = DriveOrders(arms, patience), LocalFrame(*ORIGIN)
        drive = VehicleDrive(found, found.modes, pilot or AheadPilot(), frame, orders, telemetry)
        self.runner = VehicleRunner(self.talk, drive, self.told.append)
        return self.runner.run()

    def commands(self, number: int) -> list[Any]:
        """The commands of a kind that the vehicle was given."""
        heard = self.vehicle.heard
        return [one for one in heard if getattr(one, "command", None) == number]


def test_streams_are_asked_for_both_ways() -> None:
    day = Day(PymavlinkVehicle())
    assert day.drive(AheadPilot(metres=1.0)).reached
    kinds = {message.get_type() for message in day.vehicle.heard}
    assert {"REQUEST_DATA_STREAM", "HEARTBEAT", "SET_POSITION_TARGET_LOCAL_NED"} <= kinds
    asked = {int(one.param1): one.param2 for one in day.commands(511)}
    assert asked == {30: 50000.0, 33: 50000.0, 193: 500000.0, 245: 500000.0}


@pytest.mark.parametrize("old", [False, True])
def test_autopilots_that_know_only_one_way_are_understood(old: bool) -> None:
    vehicle = PymavlinkVehicle()
    if old:
        vehicle._on_command_long = _only(vehicle._on_command_long, 511)  # type: ignore[method-assign]
    else:
        vehicle._on_request_data_stream = lambda message: None  # type: ignore[method-assign]
    assert Day(vehicle).drive(AheadPilot(metres=1.0)).reached


def _only(answer: Callable[[Any], None], unknown: int) -> Callable[[Any], None]:
    """An answer to every command but one."""
    return lambda message: None if message.command == unknown else answer(message)


def test_it_is_never_armed_unless_that_is_asked_for() -> None:
    day = Day(PymavlinkVehicle())
    ended = day.drive(arms=False)
    assert not ended.reached
    assert "arm it, or give --arm" in ended.words
    assert day.commands(400) == []
    assert not day.vehicle.armed
    assert (day.vehicle.x, day.vehicle.y) == (0.0, 0.0)
    assert day.vehicle.mode == 4  # HOLD


def test_a_person_may_arm_it() -> None:
    day = Day(PymavlinkVehicle())
    day.link.at(6.0, lambda: setattr(day.vehicle, "armed", True))
    assert day.drive(AheadPilot(metres=2.0), arms=False).reached
    assert day.commands(400) == []


def test_a_vehicle_that_refuses_to_be_armed_says_why() -> None:
    vehicle = PymavlinkVehicle()
    vehicle.arms = False
    day = Day(vehicle)
    day.link.at(5.0, lambda: vehicle.link.statustext_send(2, b"PreArm: Compass not healthy"))
    ended = day.drive()
    assert "couldn't be armed in 5 s (to be armed: failed; it says “PreArm: Compass" in ended.words
    assert vehicle.setpoints[-1][1].vx == 0.0


def test_a_vehicle_that_does_not_change_its_mode_is_left_alone() -> None:
    vehicle = PymavlinkVehicle()
    vehicle.takes_mode = False
    ended = Day(vehicle).drive()
    assert ended.words.startswith(
        "it didn't change to GUIDED in 5 s (the change of its mode: failed"
    )
    assert not vehicle.armed


@pytest.mark.parametrize(("autopilot", "manual"), [(ARDUPILOT, 0), (ARDUPILOT, 4), (PX4, 2 << 16)])
def test_a_persons_mode_switch_always_wins(autopilot: int, manual: int) -> None:
    vehicle = PymavlinkVehicle(autopilot=autopilot)
    day = Day(vehicle)
    day.link.at(12.0, lambda: setattr(vehicle, "mode", manual))
    ended = day.drive()
    assert not ended.reached
    assert "it isn't driven from here any more" in ended.words
    assert vehicle.mode == manual
    # from when its heartbeat has told of the switch on, nothing is sent
    assert max(time for time, _ in vehicle.setpoints) < 13.1
    heard = len(vehicle.heard)
    day.link.read(2.0)
    assert len(vehicle.heard) == heard


def test_a_mode_switch_while_it_is_taken_over_wins_too() -> None:
    vehicle = PymavlinkVehicle()
    vehicle.takes_mode = False
    day = Day(vehicle)
    day.link.at(6.0, lambda: setattr(vehicle, "mode", 3))
    assert "its mode was changed to STEERING" in day.drive().words
    assert vehicle.mode == 3


def test_a_lost_link_stops_it_and_the_words_say_so() -> None:
    vehicle = PymavlinkVehicle()
    day = Day(vehicle)
    day.link.at(12.0, lambda: setattr(day.link, "is_up", False))
    ended = day.drive()
    assert ended.words.startswith("the link was lost: nothing was heard for 3 s")
    assert "hasn't said that it is in HOLD" in ended.words
    day.link.read(3.0)
    assert vehicle.speed < 0.01  # its own limit of three seconds


def test_what_it_says_is_lost_but_it_hears_and_so_it_stops_at_once() -> None:
    vehicle = PymavlinkVehicle()
    day = Day(vehicle)
    silenced: list[float] = []

    def silence() -> None:
        vehicle.beats, vehicle.intervals = False, {}
        silenced.append(vehicle.now)

    day.link.at(12.0, silence)
    ended = day.drive()
    assert "its last pose is" in ended.words or "the link was lost" in ended.words
    after = [one.vx for time, one in vehicle.setpoints if time > silenced[0] + 0.6]
    assert after
    assert set(after) == {0.0}
    assert vehicle.mode == 4  # it was told to hold, and it heard


def test_a_short_gap_stops_it_and_it_goes_on() -> None:
    vehicle = PymavlinkVehicle()
    day = Day(vehicle)
    day.link.at(10.0, lambda: setattr(vehicle, "has_position", False))
    day.link.at(11.5, lambda: setattr(vehicle, "has_position", True))
    ended = day.drive(AheadPilot(metres=12.0))
    assert ended.reached
    assert any("its last pose is 0.5" in words for words in day.told)
    gap = [one.vx for time, one in vehicle.setpoints if 10.6 < time < 11.4]
    assert set(gap) == {0.0}
    assert day.runner.drive.time < vehicle.now - 1.0  # the clock of the drive has stood still


def test_an_ekf_that_fails_under_way_stops_it() -> None:
    vehicle = PymavlinkVehicle()
    day = Day(vehicle)
    day.link.at(12.0, lambda: setattr(vehicle, "ekf", HEALTHY & ~(8 | 16)))
    ended = day.drive()
    assert ended.words.startswith("its EKF has no position, for more than 3 s; HOLD")
    assert vehicle.speed < 0.01


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (HEALTHY | 1024, "isn't initialised"),
        (HEALTHY | 128, "takes its position as constant"),
        (HEALTHY & ~1, "has no attitude"),
        (HEALTHY & ~2, "has no velocity"),
    ],
)
def test_an_ekf_that_is_not_ready_is_waited_for_and_then_refused(flags: int, words: str) -> None:
    vehicle = PymavlinkVehicle()
    vehicle.ekf = flags
    with pytest.raises(LinkError, match=f"isn't ready after 5 s: .*{words}"):
        Day(vehicle).drive()
    assert vehicle.setpoints == []
    vehicle = PymavlinkVehicle()
    vehicle.ekf = flags
    day = Day(vehicle)
    day.link.at(3.0, lambda: setattr(vehicle, "ekf", HEALTHY))
    assert day.drive(AheadPilot(metres=1.0)).reached
    assert any(words in told for told in day.told)


def test_a_vehicle_without_an_origin_is_refused() -> None:
    vehicle = PymavlinkVehicle()

    def nowhere(boot: int) -> None:
        vehicle.link.global_position_int_send(boot, 0, 0, 0, 0, 0, 0, 0, 0)

    vehicle._say_position = nowhere  # type: ignore[method-assign]
    with pytest.raises(LinkError, match="it has no place on earth: no GPS fix, and no origin"):
        Day(vehicle).drive()
    vehicle = PymavlinkVehicle()
    vehicle.has_position = False
    with pytest.raises(LinkError, match="it says nothing of its position"):
        Day(vehicle).drive()


def test_ctrl_c_stops_it_and_has_it_hold() -> None:
    vehicle = PymavlinkVehicle()
    day = Day(vehicle)

    def interrupt(time: float) -> None:
        if time > 2.0:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        day.drive(AheadPilot(does=interrupt))
    assert vehicle.mode == 4
    assert vehicle.setpoints[-1][1].vx == 0.0
    assert "interrupted; HOLD" in day.told
    day.link.read(2.0)
    assert vehicle.speed < 0.01


def test_a_defect_stops_it_too() -> None:
    vehicle = PymavlinkVehicle()

    def breaks(time: float) -> None:
        if time > 2.0:
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        Day(vehicle).drive(AheadPilot(does=breaks))
    assert vehicle.mode == 4


def test_ctrl_c_after_a_persons_switch_sends_nothing() -> None:
    vehicle = PymavlinkVehicle()
    day = Day(vehicle)
    assert not day.link.events
    day.link.at(12.0, lambda: setattr(vehicle, "mode", 0))
    day.drive()
    drive = day.runner.drive
    assert drive.interrupted(99.0).ticked(99.0)[1] == ()


def test_it_can_be_stopped_at_once_from_outside() -> None:
    vehicle = PymavlinkVehicle()
    day = Day(vehicle)
    seen: list[int] = []

    def outside(time: float) -> None:
        if time > 2.0 and not seen:
            seen.append(len(vehicle.heard))
            day.runner.stop_at_once()
            assert vehicle.mode == 4
            assert vehicle.setpoints[-1][1].vx == 0.0

    assert "HOLD" in day.drive(AheadPilot(does=outside)).words
    assert seen


def test_off_its_path_by_more_than_is_proven_it_is_stopped() -> None:
    vehicle = PymavlinkVehicle(heading=0.2)
    ended = Day(vehicle).drive(AheadPilot(allowed_m=0.5))
    assert not ended.reached
    assert "off its path, and 0.50 m are proven clear; HOLD" in ended.words
    assert abs(vehicle.y) < 0.9


def test_disarmed_under_way_it_is_left_alone() -> None:
    vehicle = PymavlinkVehicle()
    day = Day(vehicle)
    day.link.at(12.0, lambda: setattr(vehicle, "armed", False))
    ended = day.drive()
    assert ended == Ended(False, "it was disarmed under way")
    assert not vehicle.armed
    assert len(day.commands(400)) == 1


def test_only_the_vehicle_that_is_meant_is_driven() -> None:
    first, second = PymavlinkVehicle(system=1), PymavlinkVehicle(system=2)
    day = Day(first, second)
    assert day.drive(AheadPilot(metres=2.0)).reached
    assert first.x > 2.0
    assert (second.x, second.armed, second.setpoints) == (0.0, False, [])


def test_signs_are_those_of_north_east_down_and_clockwise() -> None:
    # A rover that is turned left, as seen from above, has its yaw rate below 0 in NED.
    for kind, autopilot in ((10, ARDUPILOT), (10, PX4), (COPTER, ARDUPILOT)):
        vehicle = PymavlinkVehicle(kind=kind, autopilot=autopilot, heading=0.0)
        vehicle.up, vehicle.armed = (10.0 if kind == COPTER else 0.0), True

        @dataclass(frozen=True)
        class Left(AheadPilot):
            def steered(self, state: VehicleState, time: float) -> tuple[AheadPilot, Steering]:
                turn, up = 0.4, 0.3
                velocity = (math.cos(turn * time), math.sin(turn * time), up)
                motion = VehicleMotion(1.0, turn, velocity, turn * time)
                return self, Steering(motion, 0.0, time > 2.0)

        assert Day(vehicle).drive(Left()).reached
        assert vehicle.y > 0.3
        assert vehicle.heading > 0.4
        if kind == COPTER:
            assert vehicle.up > 10.3


def test_backwards_is_a_speed_below_nothing() -> None:
    @dataclass(frozen=True)
    class Back(AheadPilot):
        def steered(self, state: VehicleState, time: float) -> tuple[AheadPilot, Steering]:
            return self, Steering(VehicleMotion(-0.5, 0.0, (-0.5, 0.0, 0.0), 0.0), 0.0, time > 3.0)

    vehicle = PymavlinkVehicle()
    assert Day(vehicle).drive(Back()).reached
    assert vehicle.x < -1.0


def test_a_copter_on_the_ground_that_does_not_take_off_is_given_up() -> None:
    vehicle = PymavlinkVehicle(kind=COPTER)
    vehicle._on_command_long = _only(vehicle._on_command_long, 22)  # type: ignore[method-assign]
    ended = Day(vehicle).drive(AheadPilot(takeoff_m=3.0))
    assert ended.words.startswith("it didn't take off")
    assert vehicle.up == 0.0


def test_a_drive_that_is_over_says_nothing() -> None:
    day = Day(PymavlinkVehicle())
    day.drive(AheadPilot(metres=1.0))
    drive = day.runner.drive
    assert drive.ticked(1e3) == (replace(drive, news=()), ())


def test_a_link_that_breaks_is_an_error_in_words() -> None:
    vehicle = PymavlinkVehicle()
    day = Day(vehicle)
    day.link.at(8.0, lambda: setattr(day.link, "is_broken", True))
    with pytest.raises(LinkError, match=r"the link broke .* own failsafe"):
        day.drive()
    assert "it may not have heard that it is to stop" in day.told
    day.link.is_broken = False
    day.link.sleep(0.01)
    while day.link.time < 16.0:
        day.link.sleep(1.0)
        day.link.waiting = b""
    assert vehicle.speed < 0.01


def test_a_link_that_breaks_for_a_moment_is_gone_on_with() -> None:
    vehicle = PymavlinkVehicle()
    day = Day(vehicle)
    day.link.at(8.0, lambda: setattr(day.link, "is_broken", True))
    day.link.at(9.0, lambda: setattr(day.link, "is_broken", False))
    assert day.drive(AheadPilot(metres=8.0)).reached


def test_a_pose_that_comes_too_seldom_is_refused() -> None:
    vehicle = PymavlinkVehicle()
    vehicle._on_command_long = _only(vehicle._on_command_long, 511)  # type: ignore[method-assign]
    vehicle._on_request_data_stream = lambda message: None  # type: ignore[method-assign]
    vehicle.intervals = {30: 0.1, 33: 1.0, 193: 1.0}
    with pytest.raises(LinkError, match="its position comes too seldom to drive by"):
        Day(vehicle).drive()
    assert vehicle.setpoints == []


def test_ctrl_c_while_it_is_taken_over_leaves_it_holding_or_as_it_was() -> None:
    for takes in (True, False):
        vehicle = PymavlinkVehicle()
        vehicle.takes_mode = takes
        day = Day(vehicle)
        waited: list[float] = []

        def listens(timeout: float, day: Day = day, waited: list[float] = waited) -> bytes:
            asked = [one for one in day.commands(176) if one.param2 == 15.0]
            if asked and not waited:
                waited.append(day.link.time)
                raise KeyboardInterrupt
            day.link.sleep(timeout)
            data, day.link.waiting = day.link.waiting, b""
            return data

        day.link.read = listens  # type: ignore[method-assign]
        with pytest.raises(KeyboardInterrupt):
            day.drive()
        assert vehicle.mode == (4 if takes else 0)
        assert not vehicle.armed
