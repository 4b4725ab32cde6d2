"""A robot of a fleet, as a fleet asks for it.

Tested through ``mission/fleet/test_fleet``.
"""

from __future__ import annotations

from typing import Annotated, Final, Literal, TypeAlias

from pydantic import BeforeValidator, Field, InstanceOf, model_validator
from pydantic.json_schema import SkipJsonSchema
from pydantic_core import PydanticCustomError

from viaspline.mission.annotations import Expects
from viaspline.mission.fields import Duration, Name, Number, as_text
from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.route_spec import Route
from viaspline.mission.spline_spec import SplineSpec
from viaspline.mission.value import Value, two_of

Rest: TypeAlias = Literal["stay", "leave"]

HIGHEST_PRIORITY: Final = 1e9
"""The highest priority; the lowest is as far below zero."""

Priority: TypeAlias = Annotated[Number, Field(ge=-HIGHEST_PRIORITY, le=HIGHEST_PRIORITY)]


class MemberSpec(
    Value,
    expected="a robot such as {name: r1, robot: cart, route: {start: [0, 0], goal: [9, 0]}} or "
    "{name: r2, mission: r2.yaml}",
    excluding=(("mission", "robot"), ("mission", "route"), ("mission", "spline")),
    examples=(
        {
            "name": "r1",
            "robot": "cart",
            "route": {"start": [0, 0], "goal": [9, 0]},
            "spline": {"tension": 0.1},
            "priority": 2,
            "depart_s": 5,
            "rest": "leave",
        },
        {"name": "r2", "mission": "r2.yaml"},
    ),
):
    """A robot of a fleet: a kind of robot with its route, or a mission over the fleet's world.

    Attributes:
        name: What it is called in results and errors; no other robot of the fleet has that name.
        robot: Its kind: one of the names under ``robots``. None: the only one there is; a robot of
            the defaults if there is none.
        route: The points that its path runs through.
        spline: The shape of its curve. None: that of the fleet.
        mission: In place of all three, the file of a mission in YAML, relative to the fleet's. Its
            world is the fleet's, or left out.
        asked: What that mission holds beside its world.
        priority: Who has more is let pass where the order of two robots is free.
        depart_s: When it may set out [s], in place of its route's ``depart_s``. Until then it
            stands at its start. None: as its route says.
        rest: What it does at its goal: ``stay`` there for ever, or ``leave`` the world.
    """

    name: Name
    robot: Annotated[Name, Expects("the name of one of the kinds under robots")] | None = None
    route: Route | None = None
    spline: SplineSpec | None = None
    mission: (
        Annotated[Name, BeforeValidator(as_text), Expects("the path of a mission such as r2.yaml")]
        | None
    ) = None
    asked: Annotated[SkipJsonSchema[InstanceOf[MissionParts] | None], Field(exclude=True)] = None
    priority: Priority = 0.0
    depart_s: Duration | None = None
    rest: Rest = "stay"

    @model_validator(mode="after")
    def _one_way(self) -> MemberSpec:
        if self.mission is None and self.asked is None:
            if self.route is None:
                raise PydanticCustomError(
                    "none_of", "give one of them", {"keys": ("route", "mission")}
                )
            return self
        for key in ("route", "robot", "spline"):
            if getattr(self, key) is not None:
                raise two_of("mission", key)
        return self
