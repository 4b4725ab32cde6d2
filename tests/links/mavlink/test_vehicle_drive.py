"""Bad days of a drive: each ends as it should, and nobody moves who shouldn't."""

import math
from dataclasses import dataclass, replace

import pytest
from driven_day import AheadPilot, Day, all_but
from pymavlink_vehicle import ARDUPILOT, COPTER, HEALTHY, PX4, PymavlinkVehicle

from viaspline.links.mavlink.drive_orders import Ended
from viaspline.links.mavlink.pilot import Steering
from viaspline.links.mavlink.setpoints import VehicleMotion
from viaspline.links.mavlink.vehicle_state import VehicleState


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
    vehicle._on_command_long = all_but(vehicle._on_command_long, 22)  # type: ignore[method-assign]
    ended = Day(vehicle).drive(AheadPilot(takeoff_m=3.0))
    assert ended.words.startswith("it didn't take off")
    assert vehicle.up == 0.0


def test_a_drive_that_is_over_says_nothing() -> None:
    day = Day(PymavlinkVehicle())
    day.drive(AheadPilot(metres=1.0))
    drive = day.runner.drive
    assert drive.ticked(1e3) == (replace(drive, news=()), ())
