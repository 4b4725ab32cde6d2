"""What a fleet's plan is: every robot's path and law, proven apart, and who passes first where.

Tested through ``fleet/test_plan_fleet``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.precedences import Precedence
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import Plan


@dataclass(frozen=True)
class NotServed:
    """A robot that has no plan.

    Attributes:
        name: The robot.
        outcome: ``refused``: proven that there is none; ``gave up``: none was found.
        reason: Why, in words, with the robots and places that are in the way.
        remedy: The least change that would help.
    """

    name: str
    outcome: Literal["refused", "gave up"]
    reason: str
    remedy: str


@dataclass(frozen=True, eq=False)
class FleetPlan:
    """Paths and time laws of a fleet, proven apart over continuous time.

    Attributes:
        fleet: What was asked for.
        plans: The plan of every robot that is served, by name, in the order of the fleet. Its
            trajectory begins when its robot departs, by the clock of the fleet.
        not_served: The others, with the reason.
        certificate: The least separation of any two robots that are served, over all time.
        precedences: Who passes first, wherever two paths come near each other.
        alone: How long each robot would drive if it were alone [s], by name.
        courses: Their paths, cut into cells: the served robots in the order of ``plans``.
        crossings: Where these come near each other.
        laws: When each robot is where on its course.
        alone_laws: When it would be where if it were alone.
    """

    fleet: Fleet
    plans: dict[str, Plan]
    not_served: tuple[NotServed, ...]
    certificate: FleetCertificate
    precedences: tuple[Precedence, ...]
    alone: dict[str, float]
    courses: FleetCourses
    crossings: FleetCrossings
    laws: FleetLaws
    alone_laws: FleetLaws

    @property
    def served(self) -> bool:
        """Whether every robot of the fleet has a plan, and all are proven apart."""
        return not self.not_served and self.certificate.holds

    @property
    def names(self) -> tuple[str, ...]:
        """The robots that are served, in the order of the courses."""
        return tuple(self.plans)
