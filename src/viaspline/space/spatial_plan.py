"""A mission in space as a whole plan: curve, proofs, headings and time law.

Tested through ``space/test_plan_spatial``.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cached_property

from viaspline.curve.certificate import Certificate
from viaspline.curve.height_certificate import HeightCertificate
from viaspline.curve.path import Path
from viaspline.machine.drivability import Drivability
from viaspline.machine.measure_drivability import drivability_in_space
from viaspline.mission.model import Mission
from viaspline.planning.problem.ledger import LedgerEntry
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.named_columns import Table
from viaspline.presentable.saved_value import SavedValue
from viaspline.presentable.shown_value import ShownValue
from viaspline.space.spatial_account import SpatialAccount
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.space.timing.yaw_profile import YawProfile
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.path_samples import USUAL_STEP_M, flight_samples
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.waits import TrafficWait
from viaspline.world.space.spatial_world import SpatialWorld


@dataclass(frozen=True, eq=False)
class SpatialPlan(ShownValue, SavedValue, ComparedByValue):
    """A proven path in space, where the robot looks on it, and its time law.

    Two plans are equal if they are of one mission, with one path, one law and the same proofs; what
    the search did to find them doesn't count.

    Attributes:
        mission: What was asked for.
        world: The known world it was planned in.
        path: The exact curve with its via points, upright legs of take-off and landing included.
        certificate: The proven clearance of the body against everything known; while it takes off
            and lands, the ground it stands on doesn't count.
        heights: What is proven of the path's height, between take-off and landing.
        account: What the search did; of voxels, where the length counts, other sides are looked
            for when its ledger is read.
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
    account: SpatialAccount
    airborne: tuple[float, float]
    limits: SpatialLimits
    yaw: YawProfile
    trajectory: Trajectory
    moving: MovingCertificate | None = None
    waits: tuple[TrafficWait, ...] = ()

    def _said(self) -> tuple[object, ...]:
        return tuple(getattr(self, one.name) for one in fields(self) if one.name != "account")

    def __repr__(self) -> str:
        kept = f"{self.certificate.clearance:.2f} m clear"
        return (
            f"<SpatialPlan: {self.path.length:.1f} m in {self.trajectory.duration:.1f} s, {kept}, "
            f"{len(self.account.weighed)} detours>"
        )

    @property
    def ledger(self) -> tuple[LedgerEntry, ...]:
        """What stood in the way of each leg, and the ways past it."""
        return self.account.ledger

    def samples(self, step: float = USUAL_STEP_M) -> Table:
        """The path as a table, which pandas and polars take as it is.

        Args:
            step: From point to point along the path, at most [m]; both ends are among them.

        Returns:
            A structured array, (n,), of ``distance_m``, ``x_m``, ``y_m``, ``z_m``, ``agl_m`` (the
            height above ground where that is known), ``heading_rad`` of the body,
            ``curvature_1pm``, ``speed_mps``, ``climb_mps`` and ``time_s``.

        Raises:
            GeometryError: When the step is no number above 0, or the table has too many rows.
        """
        return flight_samples(self.path, self.trajectory, self.yaw.at, self.world.ground_at, step)

    @property
    def tracking_error(self) -> float:
        """How far the robot gets beside its path, as the mission says [m]."""
        return self.mission.robot.tracking_error_m or 0.0

    @cached_property
    def drivability(self) -> Drivability:
        """How it flies: whether it is round enough everywhere, and keeps every limit."""
        return drivability_in_space(self.path, self.trajectory, self.mission.robot)

    @cached_property
    def sharpest_radius(self) -> float:
        """The smallest radius of curvature of the path [m]; infinite on a straight one."""
        bend = float(self.path.max_curvature()[0])
        return 1.0 / bend if bend > 0.0 else float("inf")
