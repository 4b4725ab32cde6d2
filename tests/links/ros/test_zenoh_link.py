"""The link over real sockets, and against what rmw_zenoh's design document says of its keys.

The other end is written here with rosbags' CDR and hashes, and keys spelt out by hand: two ends of
our own would agree on anything.
"""

import json
import socket
import struct
import threading
import time
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from free_ports import free_port
from viaspline.errors import LinkError
from viaspline.links.ros import ros_mailbox, zenoh_link
from viaspline.links.ros.ros_topics import Qos
from viaspline.links.ros.zenoh_keys import attachment, endpoint_token, node_token, topic_key
from viaspline.links.ros.zenoh_link import ZenohLink
from viaspline.ros_messages.message_book import standard_book
from viaspline.ros_messages.twist_message import twist

zenoh = pytest.importorskip("zenoh", reason="eclipse-zenoh is not installed")
STORE = get_typestore(Stores.ROS2_JAZZY)
STRING_HASH = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"


@pytest.fixture
def router() -> Iterator[str]:
    """A zenoh router on a port of its own: its address."""
    endpoint = f"tcp/127.0.0.1:{free_port(socket.SOCK_STREAM)}"
    with zenoh.open(_config("router", listen=[endpoint])):
        yield endpoint


def _config(mode: str, **ends: list[str]) -> Any:
    config = zenoh.Config()
    config.insert_json5("mode", json.dumps(mode))
    config.insert_json5("scouting/multicast/enabled", "false")
    config.insert_json5("timestamping/enabled", "true")
    for what, endpoints in ends.items():
        config.insert_json5(f"{what}/endpoints", json.dumps(endpoints))
    return config


def until(happens: Any, seconds: float = 60.0) -> bool:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if happens():
            return True
        time.sleep(0.02)
    return False


def test_keys_and_tokens_are_those_of_the_design_document() -> None:
    session = "aac3178e146ba6f1fc6e6a4085e77f21"
    kind = "std_msgs/msg/String"
    assert node_token(2, session, "listener") == f"@ros2_lv/2/{session}/0/0/NN/%/%/listener"
    book = standard_book()
    assert book.hash(kind) == STRING_HASH
    token = endpoint_token(2, session, "listener", 10, "MS", "/chatter", kind, STRING_HASH, Qos())
    assert token == (
        f"@ros2_lv/2/{session}/0/10/MS/%/%/listener/%chatter/std_msgs::msg::dds_::String_/"
        f"{STRING_HASH}/::,10:,:,:,,"
    )
    talker = endpoint_token(
        2, session, "talker", 10, "MP", "/chatter", kind, STRING_HASH, Qos(depth=7)
    )
    assert talker.endswith("/::,7:,:,:,,")
    key = topic_key(0, "/chatter", kind, STRING_HASH)
    assert key == f"0/chatter/std_msgs::msg::dds_::String_/{STRING_HASH}"


def test_what_goes_beside_a_message_is_read_by_zenohs_own_reader() -> None:
    from zenoh.ext import Int64, z_deserialize

    data = attachment(7, 123, "token")
    number, stamp, who = z_deserialize(tuple[Int64, Int64, bytes], zenoh.ZBytes(data))
    assert (number, stamp, len(who)) == (7, 123, 16)


def test_a_peer_hears_what_is_said_and_sees_who_says_it(router: str) -> None:
    heard: list[tuple[Any, bytes]] = []
    with zenoh.open(_config("client", connect=[router])) as peer:
        digest = STORE.hash_rihs01("geometry_msgs/msg/Twist")
        key = f"3/cmd_vel/geometry_msgs::msg::dds_::Twist_/{digest}"
        peer.declare_subscriber(
            key, lambda s: heard.append((s.attachment.to_bytes(), s.payload.to_bytes()))
        )
        link = ZenohLink(
            router, 3, {"/odom": "nav_msgs/msg/Odometry"}, {"/cmd_vel": "geometry_msgs/msg/Twist"},
            standard_book(),
        )  # fmt: skip
        try:
            assert until(lambda: link.publish("/cmd_vel", twist(0.5, 0.0, 0.25)) or heard)
            tokens = {str(reply.ok.key_expr) for reply in peer.liveliness().get("@ros2_lv/3/**")}
        finally:
            link.close()
        beside, payload = heard[-1]
        got = STORE.deserialize_cdr(payload, "geometry_msgs/msg/Twist")
        assert (got.linear.x, got.angular.z) == (0.5, 0.25)
        number, stamp, size = struct.unpack_from("<qqB", beside)
        assert number >= 1
        assert abs(stamp / 1e9 - time.time()) < 60.0
        assert (size, len(beside)) == (16, 33)
        sides = sorted(token.split("/")[5] for token in tokens)
        assert sides == ["MP", "MS", "NN"]
        odometry = STORE.hash_rihs01("nav_msgs/msg/Odometry")
        (hears,) = (token for token in tokens if "/MS/" in token)
        assert hears.endswith(
            f"/viaspline/%odom/nav_msgs::msg::dds_::Odometry_/{odometry}/2::,5:,:,:,,"
        )
        gone = until(lambda: not list(peer.liveliness().get("@ros2_lv/3/**")))
        assert gone


def test_in_humble_keys_have_no_hashes(router: str) -> None:
    says = {"/word": "std_msgs/msg/String"}
    with zenoh.open(_config("client", connect=[router])) as peer:
        heard: list[str] = []
        peer.declare_subscriber("0/word/**", lambda sample: heard.append(str(sample.key_expr)))
        link = ZenohLink(router, 0, {}, says, standard_book(), distro="humble")
        try:
            assert until(lambda: link.publish("/word", {"data": "go"}) or heard)
        finally:
            link.close()
    assert heard[0] == "0/word/std_msgs::msg::dds_::String_/TypeHashNotSupported"


def test_messages_of_a_peer_are_heard_and_rubbish_is_counted(router: str) -> None:
    text = STORE.types["std_msgs/msg/String"](data="go")
    data = bytes(STORE.serialize_cdr(text, "std_msgs/msg/String"))
    link = ZenohLink(router, 0, {"/word": "std_msgs/msg/String"}, {}, standard_book())
    try:
        with zenoh.open(_config("client", connect=[router])) as peer:
            key = f"0/word/std_msgs::msg::dds_::String_/{STRING_HASH}"
            found: list[Any] = []

            def said_and_heard() -> bool:
                peer.put(key, b"rubbish")
                peer.put("0/word/std_msgs::msg::dds_::String_/TypeHashNotSupported", data)
                found.extend(link.messages(0.2))
                return bool(found) and link.mailbox.unread > 0

            assert until(said_and_heard)
        at, topic, message = found[0]
        assert (topic, message) == ("/word", {"data": "go"})
        assert at <= time.monotonic()
    finally:
        link.close()


def test_a_map_that_was_said_before_is_heard(router: str) -> None:
    from zenoh import ext

    kind = "nav_msgs/msg/OccupancyGrid"
    book = standard_book()
    from viaspline.ros_messages.grid_message import occupancy
    from viaspline.world.world import World

    data = book.encoded(kind, occupancy(0.0, World(bounds=(0, 0, 2, 2)), (0, 0, 2, 2)))
    with zenoh.open(_config("client", connect=[router])) as peer:
        key = f"0/map/nav_msgs::msg::dds_::OccupancyGrid_/{STORE.hash_rihs01(kind)}"
        early = ext.declare_advanced_publisher(
            peer, key, cache=ext.CacheConfig(1), publisher_detection=True
        )
        early.put(data)
        link = ZenohLink(router, 0, {"/map": kind}, {}, book)
        try:
            found: list[Any] = []
            assert until(lambda: found.extend(link.messages(0.2)) or found)
            assert found[0][2]["info"]["width"] == 40
        finally:
            link.close()


def test_without_a_router_it_is_said_what_to_start() -> None:
    with pytest.raises(LinkError, match="rmw_zenohd"):
        ZenohLink(f"tcp/127.0.0.1:{free_port(socket.SOCK_STREAM)}", 0, {}, {}, standard_book())


def test_without_the_extra_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(zenoh_link, "find_spec", lambda name: None)
    with pytest.raises(LinkError, match=r"pip install 'viaspline\[ros\]'"):
        zenoh_link.check_zenoh()


def test_a_flood_of_messages_is_bounded_and_the_newest_stay(router: str) -> None:
    book = standard_book()
    link = ZenohLink(router, 0, {"/word": "std_msgs/msg/String"}, {}, book)
    try:
        threads = [
            threading.Thread(
                target=lambda i=i: [
                    link.mailbox.put(
                        "/word", book.encoded("std_msgs/msg/String", {"data": f"{i} {k}"})
                    )
                    for k in range(1500)
                ]
            )
            for i in range(2)
        ]
        for one in threads:
            one.start()
        for one in threads:
            one.join()
        kept = [message["data"] for _, _, message in link.messages(0.1)]
        assert len(kept) == ros_mailbox.MOST_WAITING
        assert any(one.endswith(" 1499") for one in kept)
        assert np.all([int(one.split()[1]) > 0 for one in kept])
    finally:
        link.close()
