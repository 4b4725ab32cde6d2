"""What may be wrong with a fleet in space: its places and heights, and what isn't flown.

Tested through ``mission/fleet/test_flying_fleets``.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import replace
from typing import Final

from viaspline.mission.fleet.partial_fleet import PartialFleet, PartialMember
from viaspline.mission.fleet.standing_in_space import standing_in_space
from viaspline.mission.space.planar_keys import planar_key_faults, planar_keys_of
from viaspline.mission.space.spatial_checks import spatial_faults
from viaspline.mission.space.spatial_parts import SpatialParts
from viaspline.mission.unplaced_faults import Path, UnplacedFault

IN_THE_PLANE: Final = (
    "has no heights, and others of the fleet, or its world, have: robots on the ground and in "
    "the air aren't planned together",
    "give its points heights, or take it into a fleet of its own",
)


def is_flying(partial: PartialFleet) -> bool:
    """Whether anything in a fleet says heights, so that all of it is planned in space."""
    parts = (partial.world, *(member.parts for member in partial.members))
    robots = [kind.robot for kind in partial.kinds.values()]
    robots += (member.parts.robot for member in partial.members)
    return any(part.space is not None for part in parts) or any(
        robot is not None and robot.is_spatial for robot in robots
    )


def flying_faults(partial: PartialFleet, misshapen: Collection[Path]) -> list[UnplacedFault]:
    """Everything that is wrong with a fleet in space, beside what may be with any fleet.

    Args:
        partial: It.
        misshapen: Paths of obstacles and fences that have no usable shape.
    """
    faults = []
    for kind in partial.kinds.values():
        keys = planar_keys_of({"robot": kind.robot})
        faults += _moved(planar_key_faults(keys), ("robot",), kind.robot_path)
    told: set[tuple[Path, str]] = set()
    flying = []
    for member in partial.members:
        if _has_no_heights(member):
            faults.append(UnplacedFault(member.path, *IN_THE_PLANE))
            continue
        flying.append(member)
        for fault in _faults_of(member, partial, misshapen):
            if (fault.path, fault.problem) not in told:  # what is wrong with the world
                told.add((fault.path, fault.problem))
                faults.append(fault)
    ground = None if partial.world.space is None else partial.world.space.ground
    return faults + standing_in_space(flying, ground, partial.separation)


def _has_no_heights(member: PartialMember) -> bool:
    """Whether nothing about a robot says heights: neither its kind nor any point of its route."""
    parts = member.parts
    points = [point for _, point in parts.points]
    robot = parts.robot
    return (
        parts.space is None
        and (robot is None or not robot.is_spatial)
        and all(point is not None and len(point.at) == 2 for point in points)
    )


def _faults_of(
    member: PartialMember, fleet: PartialFleet, misshapen: Collection[Path]
) -> Iterator[UnplacedFault]:
    """What is wrong with where a robot flies, by the paths of the fleet's file."""
    parts = member.parts
    shared = fleet.world.space or SpatialParts()
    space = replace(
        parts.space or SpatialParts(),
        altitude=shared.altitude,
        ground=shared.ground,
        has_ground=shared.has_ground,
        planar_keys=member.planar_keys,
    )
    own = replace(
        fleet.world, points=parts.points, robot=parts.robot, closed=parts.closed,
        has_goal=parts.has_goal, laps=parts.laps, space=space,
    )  # fmt: skip
    for fault in spatial_faults(own, space, misshapen):
        shares = fault.path[:1] == ("world",)
        yield fault if shares else fault._replace(path=(*member.home, *fault.path))


def _moved(faults: Iterator[UnplacedFault], old: Path, new: Path) -> list[UnplacedFault]:
    """Faults with another beginning of their paths."""
    return [fault._replace(path=(*new, *fault.path[len(old) :])) for fault in faults]
