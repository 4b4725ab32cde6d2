"""A mission onto MAVSDK's mission server, which is nobody's here, over a real port."""

import socket
import threading
from typing import Any

import pytest

from viaspline.links.mavlink.addresses import LinkAddress
from viaspline.links.mavlink.common_messages import MissionItemInt
from viaspline.links.mavlink.conversation import Conversation
from viaspline.links.mavlink.mav_words import MISSION
from viaspline.links.mavlink.mission_upload import MissionUpload
from viaspline.links.mavlink.transport import open_transport

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
    come, plans = threading.Event(), []

    def take(result: Any, plan: Any, data: Any) -> None:
        plans.append((result, plan))
        come.set()

    server.subscribe_incoming_mission(take)
    yield talk, come, plans
    server.destroy()
    peer.destroy()
    talk.close()


def test_a_mission_arrives_at_mavsdk_as_it_was_sent(served: Any) -> None:
    talk, come, plans = served
    vehicle, _ = talk.find(None, 10.0)
    items = tuple(
        MissionItemInt(
            1.5 * k, 0.0, 0.0, 0.0, 471000000 + 100 * k, 82000000, 5.0 + k, k, 16, vehicle.system,
            vehicle.component, 6, int(k == 0), 1, MISSION,
        )
        for k in range(23)
    )  # fmt: skip
    done = talk.carried_out(MissionUpload(vehicle, MISSION, items), vehicle)
    assert done.is_done, done.failure
    assert come.wait(5.0)
    ((_, plan),) = plans
    assert len(plan.mission_items) == 23
    for sent, read in zip(items, plan.mission_items, strict=True):
        assert (read.seq, read.command, read.frame) == (sent.seq, sent.command, sent.frame)
        assert (read.x, read.y, read.z) == (sent.x, sent.y, sent.z)
        assert (read.param1, read.current) == (sent.param1, sent.current)
