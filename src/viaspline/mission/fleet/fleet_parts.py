"""All parts of a fleet, before it is known whether they go together.

Tested through ``mission/fleet/test_fleet``.
"""

from __future__ import annotations

from typing import Annotated, Final, TypeAlias

from pydantic import Field

from viaspline.mission.annotations import Expects
from viaspline.mission.fields import Distance, Name
from viaspline.mission.fleet.member_spec import MemberSpec
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spline_spec import SplineSpec
from viaspline.mission.value import Value
from viaspline.mission.world_spec import WorldSpec

MAX_ROBOTS: Final = 100_000
"""How many robots a fleet can have at most."""

Kinds: TypeAlias = Annotated[
    dict[Name, RobotSpec],
    Expects("kinds of robots by their names, such as {cart: {radius_m: 0.5}}"),
]
Members: TypeAlias = Annotated[
    tuple[MemberSpec, ...],
    Field(min_length=1, max_length=MAX_ROBOTS),
    Expects("a list of robots such as - {name: r1, robot: cart, route: {start: ..., goal: ...}}"),
]


class FleetParts(
    Value,
    examples=(
        {
            "world": {"bounds": [0, 0, 60, 40]},
            "separation_m": 0.3,
            "robots": {"cart": {"radius_m": 0.4}},
            "fleet": [{"name": "r1", "robot": "cart", "route": {"start": [5, 5], "goal": [50, 5]}}],
            "spline": {"tension": 0.1},
        },
    ),
):
    """All parts of a fleet, each sound by itself.

    Attributes:
        world: The known map, which all robots share. Nothing in it is ``unseen``: a fleet is
            planned, and proven apart, on what is known.
        separation_m: Free space between the bodies of any two robots, at all times [m]. In the
            plane a body counts as the smallest circle about its reference point that holds it; in
            space as what it is, a ball or an upright cylinder.
        robots: Kinds of robots by name.
        fleet: The robots.
        spline: The shape of their curves, where they don't say their own.
    """

    world: WorldSpec = WorldSpec()
    separation_m: Distance = 0.5
    robots: Kinds = Field(default_factory=dict)
    fleet: Members
    spline: SplineSpec = SplineSpec()
