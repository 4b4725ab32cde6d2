"""The mission of one robot of a fleet, put together.

Tested through ``mission/fleet/test_fleet``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from viaspline.mission.fleet.fleet_parts import FleetParts
from viaspline.mission.fleet.member_spec import MemberSpec
from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.ros_spec import RosSpec
from viaspline.mission.route_spec import Route
from viaspline.mission.spline_spec import SplineSpec

AnyKind = TypeVar("AnyKind")

USUAL_ROS = RosSpec()
"""Of robots that don't say how their ROS 2 calls its topics."""


def kind_in(kinds: Mapping[str, AnyKind], name: str | None) -> AnyKind | None:
    """The kind of a name; without a name the only one, if there is one only.

    >>> kind_in({"cart": 1, "lift": 2}, "lift"), kind_in({"cart": 1}, None), kind_in({}, "cart")
    (2, 1, None)
    """
    if name is not None:
        return kinds.get(name)
    return next(iter(kinds.values())) if len(kinds) == 1 else None


def robot_of(member: MemberSpec, fleet: FleetParts) -> RobotSpec | None:
    """The robot that is meant: one of the defaults if the fleet has no kinds; None if none is."""
    if member.asked is not None:
        return member.asked.robot
    if member.robot is None and not fleet.robots:
        return RobotSpec()
    return kind_in(fleet.robots, member.robot)


def route_of(member: MemberSpec) -> Route:
    """Its route, with the departure that is asked for."""
    route = member.route if member.asked is None else member.asked.route
    assert route is not None, "a robot has a route or a mission"
    if member.depart_s is None:
        return route
    return route.model_copy(update={"depart_s": member.depart_s})


def spline_of(member: MemberSpec, fleet: FleetParts) -> SplineSpec:
    """The shape of its curve."""
    if member.asked is not None:
        return member.asked.spline
    return fleet.spline if member.spline is None else member.spline


def parts_of(member: MemberSpec, fleet: FleetParts) -> MissionParts:
    """All parts of a robot's mission, over the fleet's world.

    Args:
        member: A robot of a kind that the fleet has, or with a mission.
        fleet: Its fleet.
    """
    robot = robot_of(member, fleet)
    assert robot is not None, "a robot is of a kind that there is"
    # Built of values that are sound: they are not validated again, nor copied, for each robot.
    return MissionParts.model_construct(
        world=fleet.world,
        robot=robot,
        route=route_of(member),
        spline=spline_of(member, fleet),
        ros=USUAL_ROS if member.asked is None else member.asked.ros,
    )
