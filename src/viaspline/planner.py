"""From a mission to a plan: curve, detours, certificate and time law, in that order."""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.detour.account import Account
from viaspline.detour.brief import Brief
from viaspline.detour.course import course_of
from viaspline.detour.ledger import LedgerEntry
from viaspline.detour.order import ordered
from viaspline.detour.search import find_path
from viaspline.mission.model import Mission
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World


@dataclass(frozen=True)
class Plan:
    """A proven path and its time law.

    Attributes:
        mission: What was asked for, its via points in the order in which they are served.
        world: The known world it was planned in.
        path: The exact curve with its via points.
        certificate: The proven clearance of the body against everything known.
        account: What the search did; its ledger is drawn up when it is read.
        trajectory: The time law along the path.
    """

    mission: Mission
    world: World
    path: Path
    certificate: Certificate
    account: Account | None
    trajectory: Trajectory

    @property
    def ledger(self) -> tuple[LedgerEntry, ...]:
        """Every group met and every side tried."""
        return () if self.account is None else self.account.ledger


def plan(mission: Mission) -> Plan:
    """Plan a mission: the spline through its via points, round what stands in the way, timed.

    Raises:
        NoPathError: When there is no path, with the reason and the least change that would serve.
        GeometryError: When the mission's numbers contradict each other.

    Example:
        >>> mission = Mission.model_validate({
        ...     "world": {"known": [{"circle": {"center": [25, 0.5], "radius": 4}}]},
        ...     "route": {"start": [0, 0], "goal": [50, 0]},
        ... })
        >>> result = plan(mission)
        >>> result.certificate.holds, round(result.path.length, 1), result.ledger[0].chosen.side
        (True, 50.8, 'right')
    """
    mission = ordered(mission)
    world = World.known(mission)
    brief = Brief.of(mission)
    found = find_path(course_of(mission), world, brief)
    trajectory = retime(
        found.path,
        Limits.of(mission.robot),
        stations(found.path),
        zones=mission.world.speed_zones,
    )
    return Plan(mission, world, found.path, found.certificate, found.account, trajectory)


def stations(path: Path) -> tuple[Station, ...]:
    """The stops of a path: its via points that have a dwell."""
    return tuple(
        Station(float(distance), via.dwell, via.name)
        for via, distance in zip(path.vias, path.via_distances, strict=True)
        if via.dwell > 0
    )
