"""A mission onto a vehicle that speaks through pymavlink, and what comes of bad days."""

import errno
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink_vehicle import ARDUPILOT, PX4, PymavlinkVehicle, items_like
from simulated_link import SimulatedLink

from viaspline.errors import LinkError
from viaspline.links.mavlink.common_messages import Heartbeat, MissionItemInt
from viaspline.links.mavlink.conversation import Conversation
from viaspline.links.mavlink.download_mission import download_mission
from viaspline.links.mavlink.mav_words import FENCE, MISSION, RALLY
from viaspline.links.mavlink.mission_items import Lists
from viaspline.links.mavlink.upload_mission import Uploaded, refuse_under_way, upload_mission
from viaspline.links.mavlink.vehicle import Vehicle


def way(count: int, kind: int = MISSION) -> tuple[MissionItemInt, ...]:
    item = MissionItemInt(0.0, 0.0, 0.0, 0.0, 471000000, 82000000, 5.0, 0, 16, 0, 0, 3, 0, 1, kind)
    return tuple(replace(item, seq=k, x=item.x + 100 * k) for k in range(count))


def conversation_with(
    *vehicles: PymavlinkVehicle, loss: float = 0.0, seed: int = 0
) -> Conversation:
    link = SimulatedLink(*vehicles, loss=loss, seed=seed)
    return Conversation(link, "udp:test", clock=link.now)


def uploaded(talk: Conversation, lists: Lists) -> Uploaded:
    vehicle, _ = talk.find(None, 10.0)
    return upload_mission(talk, vehicle, lists, None)


@pytest.mark.parametrize("autopilot", [ARDUPILOT, PX4])
def test_all_lists_are_on_board_as_sent(autopilot: int) -> None:
    vehicle = PymavlinkVehicle(autopilot=autopilot)
    lists = {MISSION: way(51), FENCE: way(4, FENCE), RALLY: way(2, RALLY)}
    done = uploaded(conversation_with(vehicle), lists)
    assert done.counts == {FENCE: 4, RALLY: 2, MISSION: 51}
    home = 1 if autopilot == ARDUPILOT else 0  # ArduPilot's first item is its home
    assert [len(vehicle.board[kind]) for kind in range(3)] == [51 + home, 4, 2]
    assert [item.x for item in vehicle.board[0][home:]] == [item.x for item in way(51)]


def test_an_empty_fence_is_cleared_and_a_list_that_is_not_given_is_left() -> None:
    vehicle = PymavlinkVehicle()
    vehicle.board = {0: items_like(3), 1: items_like(4, 1), 2: items_like(2, 2)}
    uploaded(conversation_with(vehicle), {MISSION: way(5), FENCE: ()})
    assert [len(vehicle.board[kind]) for kind in range(3)] == [6, 0, 2]


@given(seed=st.integers(0, 1000), loss=st.floats(0.0, 0.3))
def test_lost_packets_are_said_again(seed: int, loss: float) -> None:
    vehicle = PymavlinkVehicle(autopilot=PX4)
    talk = conversation_with(vehicle, loss=loss, seed=seed)
    is_on_board = True
    try:
        uploaded(talk, {MISSION: way(12)})
    except LinkError:  # six losses in a row are a lost link
        is_on_board = False
    assert not is_on_board or len(vehicle.board[0]) == 12
    assert is_on_board or loss > 0.1


def test_losses_of_a_fifth_end_well() -> None:
    for seed in range(5):
        vehicle = PymavlinkVehicle()
        done = uploaded(conversation_with(vehicle, loss=0.2, seed=seed), {MISSION: way(30)})
        assert done.counts == {MISSION: 30}


def test_a_refused_item_is_named_and_what_is_on_board_is_said() -> None:
    vehicle = PymavlinkVehicle()
    vehicle.board[0] = items_like(12)
    vehicle.refuses = (37, 10)
    with pytest.raises(LinkError) as caught:
        uploaded(conversation_with(vehicle), {MISSION: way(50)})
    assert "refused item 37 (of 0 to 50) of the mission: x is invalid" in str(caught.value)
    assert "on board: items 0 to 36 of what was sent, and no more" in str(caught.value)
    assert [item.seq for item in vehicle.board[0]] == list(range(37))


def test_a_vehicle_that_keeps_its_old_mission_is_said_to() -> None:
    vehicle = PymavlinkVehicle(autopilot=PX4)
    vehicle.refuses = (7, 4)
    vehicle.board[0] = [*items_like(7), *items_like(12)[3:8]]
    with pytest.raises(LinkError, match="items 0 to 6 of what was sent, and behind them 5 others"):
        uploaded(conversation_with(vehicle), {MISSION: way(50)})
    vehicle.board[0] = items_like(12)[3:]
    with pytest.raises(LinkError, match="on board: another mission, of 9 items"):
        uploaded(conversation_with(vehicle), {MISSION: way(50)})
    vehicle.board[0] = []
    with pytest.raises(LinkError, match="on board: no mission at all"):
        uploaded(conversation_with(vehicle), {MISSION: way(50)})


def test_a_vehicle_without_fences_is_not_given_the_mission_either() -> None:
    vehicle = PymavlinkVehicle()
    vehicle.unsupported = {FENCE}
    with pytest.raises(LinkError, match="--no-fence sends the mission alone"):
        uploaded(conversation_with(vehicle), {MISSION: way(5), FENCE: way(4, FENCE)})
    assert vehicle.board[0] == []


def test_a_vehicle_that_changes_an_item_is_not_believed() -> None:
    vehicle = PymavlinkVehicle()

    def changed(item: object) -> object:
        item.z = item.z + (1.0 if item.seq == 3 else 0.0)  # type: ignore[attr-defined]
        return item

    vehicle.changes = changed
    with pytest.raises(LinkError, match="item 3: its height of 5 m became 6 m"):
        uploaded(conversation_with(vehicle), {MISSION: way(9)})


def test_a_vehicle_that_falls_silent_under_way_is_said_to() -> None:
    vehicle = PymavlinkVehicle()
    link = SimulatedLink(vehicle)
    talk = Conversation(link, "udp:test", clock=link.now)
    found, _ = talk.find(None, 10.0)

    def lost(item: object) -> object:
        link.is_up = link.is_up and item.seq != 20  # type: ignore[attr-defined]
        return item

    vehicle.changes = lost
    with pytest.raises(LinkError, match=r"no answer about item 20 .*\n.* isn't known"):
        upload_mission(talk, found, {MISSION: way(51)}, None)


def test_ctrl_c_tells_the_vehicle_that_it_is_cancelled() -> None:
    vehicle = PymavlinkVehicle()

    def interrupts(item: object) -> object:
        raise KeyboardInterrupt

    vehicle.changes = interrupts
    with pytest.raises(KeyboardInterrupt):
        uploaded(conversation_with(vehicle), {MISSION: way(5)})
    acks = [message.type for message in vehicle.heard if message.get_type() == "MISSION_ACK"]
    assert acks == [15]


def test_nobody_answers() -> None:
    with pytest.raises(LinkError, match="no autopilot was heard in 10 s"):
        conversation_with().find(None, 10.0)
    silent = PymavlinkVehicle()
    silent.beats = False
    with pytest.raises(LinkError, match="no autopilot was heard"):
        conversation_with(silent).find(None, 10.0)


def test_no_network_is_said_so() -> None:
    link = SimulatedLink()

    def unreachable(data: bytes) -> None:
        raise OSError(errno.ENETUNREACH, "Network is unreachable")

    link.write = unreachable  # type: ignore[method-assign]
    with pytest.raises(LinkError, match=r"the link broke \(network is unreachable\)"):
        Conversation(link, "udpout:test", clock=link.now).find(None, 10.0)


def test_two_autopilots_are_told_apart_or_refused_in_words() -> None:
    first, second = PymavlinkVehicle(system=1), PymavlinkVehicle(system=7, autopilot=PX4)
    with pytest.raises(LinkError) as caught:
        conversation_with(first, second).find(None, 10.0)
    assert "2 autopilots" in str(caught.value)
    assert "system 1 (ArduPilot rover), system 7 (PX4 rover)" in str(caught.value)
    assert "--system" in str(caught.value)
    talk = conversation_with(first, second)
    vehicle, _ = talk.find(7, 10.0)
    upload_mission(talk, vehicle, {MISSION: way(4)}, None)
    assert [len(one.board[0]) for one in (first, second)] == [0, 4]


def test_a_system_that_is_not_there_is_refused_with_those_that_are() -> None:
    with pytest.raises(LinkError, match=r"no system 9 .* only system 1 \(ArduPilot rover\)"):
        conversation_with(PymavlinkVehicle()).find(9, 5.0)


def test_a_vehicle_that_drives_its_mission_is_left_alone() -> None:
    vehicle = Vehicle(1, 1, ARDUPILOT, 10)
    refuse_under_way("udp", vehicle, Heartbeat(10, 10, 3, 1, 4, 3))
    refuse_under_way("udp", vehicle, Heartbeat(15, 10, 3, 129, 4, 3))
    with pytest.raises(LinkError, match=r"drives its mission \(AUTO\): nothing was sent"):
        refuse_under_way("udp", vehicle, Heartbeat(10, 10, 3, 129, 4, 3))


def test_what_was_sent_comes_back() -> None:
    vehicle = PymavlinkVehicle(autopilot=PX4)
    talk = conversation_with(vehicle, loss=0.1)
    lists = {MISSION: way(20), FENCE: way(4, FENCE), RALLY: way(2, RALLY)}
    found, _ = talk.find(None, 10.0)
    upload_mission(talk, found, lists, None)
    read = download_mission(talk, found)
    assert not read.lacking
    for kind, items in lists.items():
        assert [(one.seq, one.x, one.command) for one in read.lists[kind]] == [
            (one.seq, one.x, one.command) for one in items
        ]


def test_a_list_that_a_vehicle_does_not_know_is_lacking() -> None:
    vehicle = PymavlinkVehicle()
    vehicle.unsupported = {RALLY}
    talk = conversation_with(vehicle)
    read = download_mission(talk, talk.find(None, 10.0)[0])
    assert read.lacking == ("it refused the rally points: not supported",)
    vehicle.unsupported = {MISSION}
    with pytest.raises(LinkError, match="refused the mission"):
        download_mission(talk, talk.find(None, 10.0)[0])
