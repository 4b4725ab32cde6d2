"""The link over DDS, with peers that aren't ours: Cyclone's own types and encoder, and Fast DDS."""

import math
import os
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from viaspline.errors import LinkError
from viaspline.links.ros import dds_link
from viaspline.links.ros.dds_link import DdsLink
from viaspline.links.ros.ros_link import RosPlace, check_link, open_link
from viaspline.ros_messages.message_book import standard_book
from viaspline.ros_messages.twist_message import twist

pytest.importorskip("cyclonedds", reason="cyclonedds is not installed")
HERE = Path(__file__).parent
DOMAIN = 60 + os.getpid() % 40
HEARS = {"/scan": "sensor_msgs/msg/LaserScan"}
SAYS = {"/cmd_vel": "geometry_msgs/msg/Twist", "/plan": "nav_msgs/msg/Path"}
LOOPBACK = (
    '<CycloneDDS><Domain Id="any"><General><Interfaces>'
    '<NetworkInterface name="lo" multicast="true"/></Interfaces></General></Domain></CycloneDDS>'
)


@pytest.fixture(autouse=True)
def _loopback(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CYCLONEDDS_URI", LOOPBACK)


def until(happens: Callable[[], Any], seconds: float = 60.0) -> bool:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if happens():
            return True
    return False


def said_until(peer: subprocess.Popen[str], last: str, do: Callable[[], None]) -> str:
    """Do something again and again until a process says what is waited for; its last whole line."""
    newest = [""]

    def read(said: Iterable[str]) -> None:
        for line in said:
            if line.endswith("\n"):  # it may be told to go in the middle of one
                newest[0] = line.strip()

    assert peer.stdout is not None
    reader = threading.Thread(target=read, args=[peer.stdout])
    reader.start()

    def is_said() -> bool:
        do()
        time.sleep(0.05)
        return newest[0] == last

    until(is_said)
    peer.terminate()
    peer.wait()
    reader.join()
    peer.stdout.close()
    return newest[0]


@pytest.fixture
def link() -> Iterator[DdsLink]:
    made = DdsLink(DOMAIN, HEARS, SAYS, standard_book())
    yield made
    made.close()


def test_a_node_of_cyclone_hears_what_is_said_and_is_heard(link: DdsLink) -> None:
    peer = subprocess.Popen(
        [sys.executable, HERE / "cyclone_peer.py", str(DOMAIN)], stdout=subprocess.PIPE, text=True
    )
    try:
        heard: list[Any] = []
        assert until(lambda: heard.extend(link.messages(0.2)) or heard)
        _, topic, scan = heard[-1]
        assert topic == "/scan"
        assert scan["header"] == {"stamp": {"sec": 5, "nanosec": 7}, "frame_id": "laser"}
        np.testing.assert_array_equal(scan["ranges"], [1.0, math.inf, math.nan, 2.5, 0.0])
        # Who they are is told apart from what they say, and may come later.
        digest = get_typestore(Stores.ROS2_JAZZY).hash_rihs01("geometry_msgs/msg/Twist")
        last = f"0.5 -0.25 viaspline typehash={digest};"
        said = said_until(peer, last, lambda: link.publish("/cmd_vel", twist(0.5, 0.0, -0.25)))
    finally:
        peer.kill()
    assert said == last


def test_rubbish_and_other_robots_are_left_out(link: DdsLink) -> None:
    others = {f"/robot{k}/scan": "sensor_msgs/msg/LaserScan" for k in range(5)}
    beside = DdsLink(DOMAIN, {}, {**others, "/scan": "std_msgs/msg/String"}, standard_book())
    elsewhere = DdsLink(DOMAIN + 1, {}, {"/scan": "sensor_msgs/msg/LaserScan"}, standard_book())
    scan = {
        "header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "laser"}, "angle_min": 0.0,
        "angle_max": 0.0, "angle_increment": 0.1, "time_increment": 0.0, "scan_time": 0.0,
        "range_min": 0.0, "range_max": 1.0, "ranges": [0.5], "intensities": [],
    }  # fmt: skip
    try:
        for _ in range(5):
            for topic in others:
                beside.publish(topic, scan)
            elsewhere.publish("/scan", scan)
            beside.publish("/scan", {"data": "of another type"})
            assert list(link.messages(0.1)) == []
    finally:
        beside.close()
        elsewhere.close()


def test_a_network_that_is_not_there_is_said_so(monkeypatch: pytest.MonkeyPatch) -> None:
    nowhere = LOOPBACK.replace('"lo"', '"nosuchnet9"')
    monkeypatch.setenv("CYCLONEDDS_URI", nowhere)
    with pytest.raises(LinkError, match="CYCLONEDDS_URI"):
        DdsLink(DOMAIN + 2, {}, {}, standard_book())


def test_without_the_extra_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dds_link, "find_spec", lambda name: None)
    with pytest.raises(LinkError, match=r"pip install 'viaspline\[dds\]'"):
        check_link(RosPlace("dds"))


def test_a_link_is_opened_by_what_the_nodes_speak() -> None:
    link = open_link(RosPlace("dds", DOMAIN), {}, SAYS, standard_book())
    assert isinstance(link, DdsLink)
    link.close()


FAST_DDS = r"""
#include <chrono>
#include <cstdio>
#include <thread>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include "nodePubSubTypes.h"
using namespace eprosima::fastdds::dds;
int main(int, char** argv) {
  auto qos = PARTICIPANT_QOS_DEFAULT;
  auto here = DomainParticipantFactory::get_instance()->create_participant(atoi(argv[1]), qos);
  TypeSupport scans(new sensor_msgs::msg::LaserScanPubSubType());
  TypeSupport twists(new geometry_msgs::msg::TwistPubSubType());
  for (auto* one : {&scans, &twists}) {  // as rmw_fastrtps does
    (*one)->auto_fill_type_information(false);
    (*one)->auto_fill_type_object(false);
    here->register_type(*one);
  }
  auto said = here->create_topic("rt/scan", scans.get_type_name(), TOPIC_QOS_DEFAULT);
  auto told = here->create_topic("rt/cmd_vel", twists.get_type_name(), TOPIC_QOS_DEFAULT);
  DataWriterQos out;
  out.reliability().kind = BEST_EFFORT_RELIABILITY_QOS;
  DataReaderQos in;
  in.reliability().kind = RELIABLE_RELIABILITY_QOS;
  auto writer = here->create_publisher(PUBLISHER_QOS_DEFAULT)->create_datawriter(said, out);
  auto reader = here->create_subscriber(SUBSCRIBER_QOS_DEFAULT)->create_datareader(told, in);
  sensor_msgs::msg::LaserScan scan;
  scan.f_header().f_frame_id("laser");
  scan.f_range_max(9.0f);
  scan.f_ranges({1.0f, 2.5f});
  for (int k = 0; k < 600; ++k) {
    writer->write(&scan);
    geometry_msgs::msg::Twist twist;
    SampleInfo info;
    while (reader->take_next_sample(&twist, &info) == ReturnCode_t::RETCODE_OK)
      if (info.valid_data) {
        printf("%g %g\n", twist.f_linear().f_x(), twist.f_angular().f_z());
        fflush(stdout);
      }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}
"""


@pytest.mark.slow
def test_a_node_of_fast_dds_hears_what_is_said_and_is_heard(tmp_path: Path, link: DdsLink) -> None:
    from .test_fast_dds_peer import idl

    if shutil.which("fastddsgen") is None or shutil.which("g++") is None:
        pytest.skip("fastddsgen or g++ is not installed: apt-get install fastddsgen "
                    "libfastrtps-dev g++")  # fmt: skip
    kinds = ["geometry_msgs/msg/Twist", "sensor_msgs/msg/LaserScan"]
    (tmp_path / "node.idl").write_text(idl(kinds))
    (tmp_path / "main.cxx").write_text(FAST_DDS)
    make = ["fastddsgen", "-typeros2", "-replace", "node.idl"]
    subprocess.run(make, cwd=tmp_path, check=True, capture_output=True)
    sources = [one.name for one in tmp_path.glob("*.cxx")]
    subprocess.run(
        ["g++", "-O0", "-w", "-o", "node", *sources, "-lfastrtps", "-lfastcdr"],
        cwd=tmp_path, check=True, capture_output=True,
    )  # fmt: skip
    peer = subprocess.Popen([tmp_path / "node", str(DOMAIN)], stdout=subprocess.PIPE, text=True)
    try:
        heard: list[Any] = []
        assert until(lambda: heard.extend(link.messages(0.2)) or heard)
        assert heard[-1][2]["ranges"].tolist() == [1.0, 2.5]
        last = "0.5 -0.25"
        said = said_until(peer, last, lambda: link.publish("/cmd_vel", twist(0.5, 0.0, -0.25)))
    finally:
        peer.kill()
    assert said == last
