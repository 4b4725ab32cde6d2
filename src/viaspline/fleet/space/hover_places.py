"""The places in space where robots of a fleet are for long, and what they are to other robots.

Tested through ``fleet/space/test_lay_in_space``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.shapes.ball import Ball
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.solids import Place
from viaspline.mission.space.flight_places import flight_places
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.spatial_plan import SpatialPlan

LEAST_M: Final = 0.02
"""The radius of an obstacle that a robot's own clearance would make up for [m]."""

LOOKS_M: Final = 0.25
"""Between places of a path of which the nearest one is told [m]."""


@dataclass(frozen=True)
class HoverPlace:
    """Where a robot is for long, in the way of others.

    Attributes:
        robot: Its name.
        kind: ``start``: until it departs; ``goal``: from when it has arrived; ``home``: both;
            ``stranded``: at its start for ever, for it has no path; ``out``: for ever, for it
            doesn't fly any more.
        at: [m].
        body: What it takes up there.
    """

    robot: str
    kind: Literal["start", "goal", "home", "stranded", "out"]
    at: Place
    body: FlyingBody

    @property
    def name(self) -> str:
        """What it is called as an obstacle."""
        if self.kind == "stranded":
            return f"{self.robot}, which can't leave its start"
        if self.kind == "out":
            return f"{self.robot}, which doesn't fly any more"
        return f"{self.robot}, resting at its {self.kind}"

    @property
    def is_never_left(self) -> bool:
        """Whether the robot stays there for good, so that no path passes."""
        return self.kind in ("stranded", "out")

    def gaps(self, body: FlyingBody, places: Floats) -> Floats:
        """Free space between it and another body at places [m], (n, 3): [m], (n,)."""
        return self.body.gaps(body, places - np.array(self.at))

    def as_obstacle(self, grown: float) -> Obstacle:
        """It, standing there, with so much more about it [m]; less than 0: as much less."""
        x, y, z = self.at
        more = self.body.margin + grown
        if self.body.half_height == 0.0:
            ball = Ball(center=(x, y, z), radius=max(more, LEAST_M))
            return Obstacle(name=self.name, ball=ball)
        radius = max(self.body.radius + max(more, 0.0), LEAST_M)
        half = self.body.half_height + max(more, 0.0)
        circle = Circle(center=(x, y), radius=radius)
        return Obstacle(name=self.name, circle=circle, height_m=(z - half, z + half))


def hovers_of(member: FleetMember, plan: SpatialPlan | None) -> Iterator[HoverPlace]:
    """Where a robot is for long.

    Args:
        member: The robot.
        plan: Its path; None if it has none.

    Example:
        >>> from viaspline.mission.model import Mission
        >>> from viaspline.space.plan_spatial import plan_spatial
        >>> mission = Mission.model_validate({
        ...     "world": {"ground": {"flat_m": 0}}, "robot": {"radius_m": 0.5},
        ...     "route": {"start": [0, 0, 5], "land": {"at": [9, 0]}}})
        >>> member, plan = FleetMember("a", mission), plan_spatial(mission)
        >>> [(one.kind, one.at) for one in hovers_of(member, plan)]
        [('start', (0.0, 0.0, 5.0)), ('goal', (9.0, 0.0, 0.5))]
    """
    body = FlyingBody.of(member.mission.robot)
    if plan is None:
        yield HoverPlace(member.name, "stranded", flight_places(member.mission).start, body)
        return
    first, last = plan.path.spans[0, 0].tolist(), plan.path.spans[-1, 3].tolist()
    start, goal = (first[0], first[1], first[2]), (last[0], last[1], last[2])
    stays = member.rest == "stay"
    if stays and start == goal:
        yield HoverPlace(member.name, "home", start, body)
        return
    yield HoverPlace(member.name, "start", start, body)
    if stays:
        yield HoverPlace(member.name, "goal", goal, body)


def hover_in_the_way(name: str, plan: SpatialPlan, hover: HoverPlace) -> tuple[str, str]:
    """Why a robot can't get past the place where another one is for long, and what would let it.

    Args:
        name: The robot.
        plan: Its path.
        hover: The place that the path comes too near to.

    Returns:
        (reason, remedy).
    """
    along = np.linspace(0.0, plan.path.length, int(plan.path.length / LOOKS_M) + 2)
    places = np.asarray(plan.path.at_distance(along))
    nearest = int(hover.gaps(FlyingBody.of(plan.mission.robot), places).argmin())
    reason = f"'{hover.robot}' rests at its {hover.kind} where '{name}' has to pass, "
    leaves, verb = ("leave (rest: leave)", "rest") if hover.kind == "goal" else (
        "depart sooner", "start"
    )  # fmt: skip
    return (
        f"{reason}{along[nearest]:.1f} m along its path",
        f"let '{hover.robot}' {leaves}, or {verb} at another height",
    )
