"""From a mission to a plan: curve, detours, certificate and time law, in that order."""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.detour.ledger import LedgerEntry
from viaspline.mission.model import Mission
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World


@dataclass(frozen=True)
class Plan:
    """A proven path and its time law.

    Attributes:
        mission: What was asked for.
        world: The known world it was planned in.
        path: The exact curve with its via points.
        certificate: The proven clearance of the body against everything known.
        ledger: Every group met and every side tried.
        trajectory: The time law along the path.
    """

    mission: Mission
    world: World
    path: Path
    certificate: Certificate
    ledger: tuple[LedgerEntry, ...]
    trajectory: Trajectory
