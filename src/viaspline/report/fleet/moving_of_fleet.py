"""What moves beside a fleet, from above: its ways, and where it is when a robot is nearest to it.

Tested through ``report/fleet/test_flying_fleet_picture``.
"""

from __future__ import annotations

from matplotlib.artist import Artist
from matplotlib.axes import Axes

from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.report.labels import Labels
from viaspline.report.moving_marks import Moment, body_at, draw_moving
from viaspline.report.space.moving_in_space import draw_moving_solids
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.world.moving_obstacles import MovingObstacles


def draw_moving_of_fleet(axes: Axes, labels: Labels, plan: FleetPlan) -> list[Artist]:
    """Draw ways as lines, and shapes as they are when a robot is nearest to one.

    Returns:
        What belongs in a legend; nothing where nothing moves.
    """
    proofs = [(proof, one) for one in plan.plans.values() if (proof := _proof_of(one)) is not None]
    if not proofs:
        return []
    nearest, near = min(proofs, key=lambda pair: pair[0].clearance)
    laws = [one.trajectory for _, one in proofs]
    begin, end = min(law.start_time for law in laws), max(law.end_time for law in laws)
    now = min(max(nearest.tightest_at_s, begin), end)
    if isinstance(near, SpatialPlan):
        solids = MovingSolid.all_of(near.mission, begin, end)
        return draw_moving_solids(axes, labels, solids, (begin, end), now)
    moving, robot = MovingObstacles(plan.fleet.world.moving), near.mission.robot
    moment = Moment(moving, begin, end, now, robot, body_at(near, now))
    return draw_moving(axes, labels, moment)


def _proof_of(plan: AnyPlan) -> MovingCertificate | None:
    """What is proven of a robot and of what moves."""
    return plan.moving if isinstance(plan, SpatialPlan) else plan.moving_certificate
