"""What a fleet's plan is: every robot's path and law, proven apart, and who passes first where.

Tested through ``fleet/test_plan_fleet``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import floor

from viaspline.errors import GeometryError
from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.not_served import NotServed
from viaspline.fleet.patrols.fleet_patrols import FleetPatrols
from viaspline.fleet.precedences import Precedence
from viaspline.fleet.timing.rides import FleetRides
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import Plan
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.moving_value import MovingValue
from viaspline.presentable.named_columns import Table, stacked_tables
from viaspline.presentable.saved_value import SavedValue
from viaspline.presentable.shown_value import ShownValue
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.trajectory.path_samples import USUAL_STEP_M


@dataclass(frozen=True, eq=False)
class FleetPlan(ShownValue, MovingValue, SavedValue, ComparedByValue):
    """Paths and time laws of a fleet, proven apart over continuous time.

    Attributes:
        fleet: What was asked for.
        plans: The plan of every robot that is served, by name, in the order of the fleet: those of
            a fleet in space are plans in space. Its trajectory begins when its robot departs, by
            the clock of the fleet.
        not_served: The others, with the reason.
        certificate: The least separation of any two robots, over all time; those that aren't served
            stand at their starts.
        precedences: Who passes first, wherever two paths come near each other.
        alone: How long each robot would drive if it were alone [s], by name; a patrol all laps of
            its plan, with what it waits for the next period.
        courses: Their paths, cut into cells, and those of robots that have a path but no law.
        crossings: Where these come near each other; in each of them one robot passes first.
        laws: When each robot is where on its course. Those that are not served stand at their
            starts for ever.
        rides: How each robot drives where nobody is in its way.
        patrols: The robots that never end, of which plans and courses hold the first laps; None
            where all of them end.
    """

    fleet: Fleet
    plans: Mapping[str, Plan | SpatialPlan]
    not_served: tuple[NotServed, ...]
    certificate: FleetCertificate
    precedences: tuple[Precedence, ...]
    alone: dict[str, float]
    courses: FleetCourses
    crossings: FleetCrossings
    laws: FleetLaws
    rides: FleetRides
    patrols: FleetPatrols | None = None

    def __repr__(self) -> str:
        asked, proof = len(self.fleet.members), self.certificate
        end = max((one.trajectory.end_time for one in self.plans.values()), default=0.0)
        apart = ""
        if proof.pair is not None:
            proven = floor(1e3 * proof.separation) / 1e3  # never more than is proven
            apart = (
                f", proven {proven:g} m apart ({proof.required:g} m asked): "
                f"'{proof.pair[0]}' and '{proof.pair[1]}' at {proof.at_s:.1f} s"
            )
        return f"FleetPlan({len(self.plans)} of {asked} robots served in {end:.1f} s{apart})"

    def samples(self, step: float = USUAL_STEP_M) -> Table:
        """The paths of all robots that are served as one table, by the clock of the fleet.

        Args:
            step: From point to point along each path, at most [m].

        Returns:
            A structured array, (n,), of ``robot`` and the columns of ``Plan.samples``.

        Raises:
            GeometryError: When no robot is served, the step is no number above 0, or the table
                has too many rows.
        """
        if not self.plans:
            raise GeometryError("no robot of the fleet is served; not_served says why")
        return stacked_tables(
            "robot", {name: one.samples(step) for name, one in self.plans.items()}
        )

    @property
    def served(self) -> bool:
        """Whether every robot of the fleet has a plan, and all are proven apart."""
        return not self.not_served and self.certificate.holds

    @property
    def alone_laws(self) -> FleetLaws:
        """When each robot would be where if it were alone."""
        return self.rides.laws

    @property
    def is_spatial(self) -> bool:
        """Whether its robots fly: all of them, or none."""
        first = next(iter(self.plans.values()), None)
        return self.fleet.is_spatial if first is None else isinstance(first, SpatialPlan)

    @property
    def planar_plans(self) -> dict[str, Plan]:
        """The plans of a fleet in the plane, by name.

        Raises:
            GeometryError: It is a fleet in space.
        """
        plans = {name: one for name, one in self.plans.items() if isinstance(one, Plan)}
        if len(plans) < len(self.plans):
            raise GeometryError("this is a fleet in space; 'plans' has the plans of its robots")
        return plans

    @property
    def names(self) -> tuple[str, ...]:
        """The robots that have a path, in the order of the courses."""
        return self.courses.names
