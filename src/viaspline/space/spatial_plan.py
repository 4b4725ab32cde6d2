"""A mission in space as a whole plan: curve, proofs, headings and time law.

Tested through ``space/test_plan_spatial``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from viaspline.curve.certificate import Certificate
from viaspline.curve.height_certificate import HeightCertificate
from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.planning.problem.ledger import LedgerEntry
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.space.timing.yaw_profile import YawProfile
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.waits import TrafficWait
from viaspline.world.space.spatial_world import SpatialWorld


@dataclass(frozen=True, eq=False)
class SpatialPlan:
    """A proven path in space, where the robot looks on it, and its time law.

    Attributes:
        mission: What was asked for.
        world: The known world it was planned in.
        path: The exact curve with its via points, upright legs of take-off and landing included.
        certificate: The proven clearance of the body against everything known; while it takes off
            and lands, the ground it stands on doesn't count.
        heights: What is proven of the path's height, between take-off and landing.
        ledger: What stood in the way of each leg, and the ways past it.
        airborne: From where to where on the path it is between take-off and landing [m].
        limits: Of its drive.
        yaw: Its heading along the path.
        trajectory: The time law along the path.
        moving: What is proven of the distance from what moves; None where nothing does.
        waits: Where the law loses time to what moves.
    """

    mission: Mission
    world: SpatialWorld
    path: Path
    certificate: Certificate
    heights: HeightCertificate
    ledger: tuple[LedgerEntry, ...]
    airborne: tuple[float, float]
    limits: SpatialLimits
    yaw: YawProfile
    trajectory: Trajectory
    moving: MovingCertificate | None = None
    waits: tuple[TrafficWait, ...] = ()

    def __repr__(self) -> str:
        kept = f"{self.certificate.clearance:.2f} m clear"
        return (
            f"<SpatialPlan: {self.path.length:.1f} m in {self.trajectory.duration:.1f} s, {kept}, "
            f"{len(self.ledger)} detours>"
        )

    @property
    def tracking_error(self) -> float:
        """How far the robot gets beside its path, as the mission says [m]."""
        return self.mission.robot.tracking_error_m or 0.0

    @cached_property
    def sharpest_radius(self) -> float:
        """The smallest radius of curvature of the path [m]; infinite on a straight one."""
        bend = float(self.path.max_curvature()[0])
        return 1.0 / bend if bend > 0.0 else float("inf")
