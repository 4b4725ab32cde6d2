"""A mission onto MAVSDK's mission server, which is nobody's here, over a real port."""

import socket
from queue import Queue
from typing import Any

import pytest

from viaspline.links.mavlink.addresses import LinkAddress
from viaspline.links.mavlink.common_messages import MissionItemInt
from viaspline.links.mavlink.conversation import Conversation
from viaspline.links.mavlink.download_mission import download_mission
from viaspline.links.mavlink.mav_words import FENCE, MISSION, RALLY
from viaspline.links.mavlink.transport import open_transport
from viaspline.links.mavlink.upload_mission import upload_mission

mavsdk = pytest.importorskip("mavsdk", reason="mavsdk isn't installed")


@pytest.fixture
def served(capfd: pytest.CaptureFixture[str]) -> Any:
    from mavsdk.plugins.mission_raw_server import MissionRawServer

    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = int(probe.getsockname()[1])
    settings = mavsdk.Configuration.create_with_component_type(mavsdk.ComponentType.AUTOPILOT)
    settings.system_id = 1
    peer = mavsdk.Mavsdk(settings)
    talk = Conversation(open_transport(LinkAddress("udp", "127.0.0.1", port)), f"udp:{port}")
    peer.add_any_connection(f"udpout://127.0.0.1:{port}")
    server = MissionRawServer(peer.server_component())
    plans: Queue[Any] = Queue()

    def take(result: Any, plan: Any, data: Any) -> None:
        plans.put(plan)

    server.subscribe_incoming_mission(take)
    yield talk, plans
    server.destroy()
    peer.destroy()
    talk.close()


def items_of(kind: int, command: int, count: int) -> tuple[MissionItemInt, ...]:
    corners = float(count if kind == FENCE else 0)
    return tuple(
        MissionItemInt(
            corners, 0.0, 0.0, 0.0, 471000000 + 100 * k, 82000000 - k, 5.0 + k, k, command, 0, 0,
            0 if kind == FENCE else 3, 0, 1, kind,
        )
        for k in range(count)
    )  # fmt: skip


def test_all_lists_arrive_at_mavsdk_as_they_were_sent_and_come_back(served: Any) -> None:
    talk, plans = served
    vehicle, _ = talk.find(None, 10.0)
    lists = {
        MISSION: items_of(MISSION, 16, 23), FENCE: items_of(FENCE, 5001, 5),
        RALLY: items_of(RALLY, 5100, 2),
    }  # fmt: skip
    done = upload_mission(talk, vehicle, lists, None)  # reads back and compares
    assert done.counts == {FENCE: 5, RALLY: 2, MISSION: 23}
    plan = plans.get(timeout=5.0)
    while len(plan.mission_items) != 23:  # it tells of each list by itself, and when it likes
        plan = plans.get(timeout=5.0)
    for sent, read in zip(lists[MISSION], plan.mission_items, strict=True):
        assert (read.seq, read.command, read.frame) == (sent.seq, sent.command, sent.frame)
        assert (read.x, read.y, read.z) == (sent.x, sent.y, sent.z)


def test_an_empty_fence_is_cleared_at_mavsdk(served: Any) -> None:
    talk, _ = served
    vehicle, _ = talk.find(None, 10.0)
    upload_mission(talk, vehicle, {FENCE: items_of(FENCE, 5001, 4)}, None)
    upload_mission(talk, vehicle, {FENCE: ()}, None)
    assert download_mission(talk, vehicle).lists[FENCE] == ()
