"""The download as a value: messages and time in, messages out."""

from dataclasses import replace

from viaspline.links.mavlink.common_messages import (
    MissionAck,
    MissionCount,
    MissionItemInt,
    MissionRequestInt,
    MissionRequestList,
)
from viaspline.links.mavlink.exchange import RETRIES, TIMEOUT_S, Failure
from viaspline.links.mavlink.mission_download import MissionDownload
from viaspline.links.mavlink.vehicle import Vehicle

VEHICLE = Vehicle(1, 1, 3, 10)
ITEM = MissionItemInt(0.0, 0.0, 0.0, 0.0, 471000000, 82000000, 5.0, 0, 16, 245, 190, 3, 0, 1, 0)


def test_it_asks_for_one_after_the_other_and_thanks() -> None:
    load, said = MissionDownload(VEHICLE, 0).begun(0.0)
    assert said == (MissionRequestList(1, 1, 0),)
    load, said = load.heard(MissionCount(2, 245, 190, 0), 0.1)
    assert said == (MissionRequestInt(0, 1, 1, 0),)
    load, said = load.heard(ITEM, 0.2)
    assert said == (MissionRequestInt(1, 1, 1, 0),)
    again, said = load.heard(ITEM, 0.3)  # it came twice
    assert (again, said) == (load, ())
    load, said = load.heard(replace(ITEM, seq=1), 0.4)
    assert said == (MissionAck(1, 1, 0, 0),)
    assert load.is_done
    assert [item.seq for item in load.items] == [0, 1]


def test_an_empty_board_is_done_at_once() -> None:
    load, _ = MissionDownload(VEHICLE, 2).begun(0.0)
    load, said = load.heard(MissionCount(0, 245, 190, 2), 0.1)
    assert load.is_done
    assert said == (MissionAck(1, 1, 0, 2),)


def test_other_lists_are_none_of_its_business() -> None:
    load, _ = MissionDownload(VEHICLE, 0).begun(0.0)
    for message in (MissionCount(2, 245, 190, 1), ITEM, MissionAck(245, 190, 3, 1)):
        assert load.heard(message, 0.1) == (load, ())


def test_silence_is_asked_again_and_then_given_up() -> None:
    load, _ = MissionDownload(VEHICLE, 0).begun(0.0)
    load, _ = load.heard(MissionCount(2, 245, 190, 0), 0.0)
    load, _ = load.heard(ITEM, 0.0)
    for k in range(1, RETRIES + 1):
        load, said = load.waited(k * TIMEOUT_S)
        assert said == (MissionRequestInt(1, 1, 1, 0),)
    load, _ = load.waited((RETRIES + 1) * TIMEOUT_S)
    assert load.failure == Failure(1, None)


def test_a_refusal_ends_it() -> None:
    load, _ = MissionDownload(VEHICLE, 2).begun(0.0)
    load, _ = load.heard(MissionAck(245, 190, 3, 2), 0.1)
    assert load.failure == Failure(None, 3)
