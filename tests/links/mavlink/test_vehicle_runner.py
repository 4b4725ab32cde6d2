"""Before a drive, and however it ends: what isn't ready is refused, what moves is stopped."""

import pytest
from driven_day import AheadPilot, Day, all_but
from pymavlink_vehicle import HEALTHY, PymavlinkVehicle

from viaspline.errors import LinkError


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
        vehicle._on_command_long = all_but(vehicle._on_command_long, 511)  # type: ignore[method-assign]
    else:
        vehicle._on_request_data_stream = lambda message: None  # type: ignore[method-assign]
    assert Day(vehicle).drive(AheadPilot(metres=1.0)).reached


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


def test_a_pose_that_comes_too_seldom_is_refused() -> None:
    vehicle = PymavlinkVehicle()
    vehicle._on_command_long = all_but(vehicle._on_command_long, 511)  # type: ignore[method-assign]
    vehicle._on_request_data_stream = lambda message: None  # type: ignore[method-assign]
    vehicle.intervals = {30: 0.1, 33: 1.0, 193: 1.0}
    with pytest.raises(LinkError, match="its position comes too seldom to drive by"):
        Day(vehicle).drive()
    assert vehicle.setpoints == []


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
