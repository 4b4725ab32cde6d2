"""A node beside the link: Cyclone's own types and encoder, written by hand as rmw has them.

    python cyclone_peer.py DOMAIN

Says odometry's little sister and a scan until it is told to go, and prints what it is told.
"""

import sys
import time
from dataclasses import dataclass

from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import (
    array,
    bounded_str,
    float32,
    float64,
    int32,
    sequence,
    uint8,
    uint32,
)
from cyclonedds.pub import DataWriter
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic

MSG = "msg::dds_::"


@dataclass
class Time(IdlStruct, typename=f"builtin_interfaces::{MSG}Time_"):
    sec: int32
    nanosec: uint32


@dataclass
class Header(IdlStruct, typename=f"std_msgs::{MSG}Header_"):
    stamp: Time
    frame_id: str


@dataclass
class Vector3(IdlStruct, typename=f"geometry_msgs::{MSG}Vector3_"):
    x: float64
    y: float64
    z: float64


@dataclass
class Twist(IdlStruct, typename=f"geometry_msgs::{MSG}Twist_"):
    linear: Vector3
    angular: Vector3


@dataclass
class LaserScan(IdlStruct, typename=f"sensor_msgs::{MSG}LaserScan_"):
    header: Header
    angle_min: float32
    angle_max: float32
    angle_increment: float32
    time_increment: float32
    scan_time: float32
    range_min: float32
    range_max: float32
    ranges: sequence[float32]
    intensities: sequence[float32]


@dataclass
class Gid(IdlStruct, typename=f"rmw_dds_common::{MSG}Gid_"):
    data: array[uint8, 16]


@dataclass
class NodeEntitiesInfo(IdlStruct, typename=f"rmw_dds_common::{MSG}NodeEntitiesInfo_"):
    node_namespace: bounded_str[256]
    node_name: bounded_str[256]
    reader_gid_seq: sequence[Gid]
    writer_gid_seq: sequence[Gid]


@dataclass
class Participant(IdlStruct, typename=f"rmw_dds_common::{MSG}ParticipantEntitiesInfo_"):
    gid: Gid
    node_entities_info_seq: sequence[NodeEntitiesInfo]


def main(domain: int) -> None:
    here = DomainParticipant(domain)
    classic = Policy.DataRepresentation(use_cdrv0_representation=True)
    sensor = Qos(Policy.Reliability.BestEffort, Policy.History.KeepLast(5), classic)
    usual = Qos(Policy.Reliability.Reliable(10**8), Policy.History.KeepLast(10), classic)
    staying = Qos(Policy.Reliability.Reliable(10**8), Policy.Durability.TransientLocal, classic)
    scans = DataWriter(here, Topic(here, "rt/scan", LaserScan), qos=sensor)
    told = DataReader(here, Topic(here, "rt/cmd_vel", Twist), qos=usual)
    graph = DataReader(here, Topic(here, "ros_discovery_info", Participant), qos=staying)
    scan = LaserScan(
        Header(Time(5, 7), "laser"), -1.0, 1.0, 0.5, 0.0, 0.1, 0.05, 9.0,
        [1.0, float("inf"), float("nan"), 2.5, 0.0], [],
    )  # fmt: skip
    nodes: set[str] = set()
    end = time.monotonic() + 60.0
    while time.monotonic() < end:
        scans.write(scan)
        for one in graph.take(10):
            nodes |= {node.node_name for node in one.node_entities_info_seq}
        for twist in told.take(10):
            hashes = {
                told.get_matched_publication_data(one).qos[Policy.Userdata].data.decode()
                for one in told.get_matched_publications()
            }
            print(twist.linear.x, twist.angular.z, ",".join(nodes), *hashes, flush=True)
        time.sleep(0.05)


if __name__ == "__main__":
    main(int(sys.argv[1]))
