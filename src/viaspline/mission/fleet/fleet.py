"""What is asked of a fleet: robots with their missions over one world.

``Fleet.model_validate(data)`` takes exactly what the YAML holds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from pydantic import ModelWrapValidatorHandler, ValidationInfo, model_validator

from viaspline.mission.fleet.fleet_parts import FleetParts
from viaspline.mission.fleet.fleet_validation import sound_fleet
from viaspline.mission.fleet.member_parts import parts_of
from viaspline.mission.fleet.member_spec import Rest
from viaspline.mission.model import Mission
from viaspline.presentable.shown_value import ShownValue


@dataclass(frozen=True)
class FleetMember:
    """One robot of a fleet.

    Attributes:
        name: Its name in the fleet.
        mission: What it does, over the world of the fleet; ``mission.route.depart_s`` is when it
            may depart.
        priority: Who has more is let pass.
        rest: What it does at its goal: ``stay`` there, or ``leave`` the world.
    """

    name: str
    mission: Mission
    priority: float = 0.0
    rest: Rest = "stay"


class Fleet(ShownValue, FleetParts):
    """Robots with their missions over one world.

    Every way to make one raises `viaspline.errors.MissionError` with every fault at once.

    Attributes:
        world: The known map, which all robots share.
        separation_m: Free space between the bodies of any two robots, at all times [m].
        robots: Kinds of robots by name.
        fleet: The robots as they were asked for.
        spline: The shape of their curves, where they don't say their own.

    >>> fleet = Fleet.model_validate({
    ...     "robots": {"cart": {"radius_m": 0.4}},
    ...     "fleet": [
    ...         {"name": "r1", "robot": "cart", "route": {"start": [0, 0], "goal": [9, 0]}},
    ...         {"name": "r2", "robot": "cart", "route": {"start": [0, 5], "goal": [9, 5]},
    ...          "depart_s": 3, "rest": "leave"},
    ...     ],
    ... })
    >>> [(each.name, each.mission.route.depart_s, each.rest) for each in fleet.members]
    [('r1', 0.0, 'stay'), ('r2', 3.0, 'leave')]
    """

    @classmethod
    def of(cls, members: Sequence[FleetMember], separation_m: float = 0.5) -> Fleet:
        """A fleet of robots with a mission each, all over the world of the first.

        Args:
            members: The robots.
            separation_m: Free space between the bodies of any two of them [m].

        Raises:
            MissionError: With every fault.

        >>> there = Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}})
        >>> Fleet.of([FleetMember("r1", there), FleetMember("r2", there)])
        Traceback (most recent call last):
        viaspline.errors.MissionError: <mission>: fleet[1].mission.route.start.at: 'r2' starts 0 ...
        """
        robots = [
            {"name": one.name, "mission": one.mission, "priority": one.priority, "rest": one.rest}
            for one in members
        ]
        world = {"world": members[0].mission.world} if members else {}
        return cls.model_validate({**world, "separation_m": separation_m, "fleet": robots})

    def __repr__(self) -> str:
        many, known = len(self.fleet), len(self.world.known)
        return f"Fleet({many} robots, {self.separation_m:g} m apart, {known} obstacles)"

    __str__ = __repr__

    @model_validator(mode="wrap")
    @classmethod
    def _sound(
        cls, data: Any, handler: ModelWrapValidatorHandler[Fleet], info: ValidationInfo
    ) -> Fleet:
        return sound_fleet(data, handler, info.context)

    def lying_at(self, origin: tuple[float, float]) -> Fleet:
        """It, with its 0, 0 and that of all its robots somewhere on earth.

        Args:
            origin: Latitude and longitude [deg].

        >>> one = {"name": "r1", "route": {"start": [0, 0], "goal": [9, 0]}}
        >>> placed = Fleet.model_validate({"fleet": [one]}).lying_at((47.1, 8.5))
        >>> placed.members[0].mission.world.origin_deg
        (47.1, 8.5)
        """
        world = self.world.model_copy(update={"origin_deg": origin})
        return Fleet.model_construct(**{**dict(self), "world": world})

    @property
    def is_spatial(self) -> bool:
        """Whether anything in it says heights, a kind of robots or its world included.

        Then all its robots are planned in space.

        >>> Fleet.model_validate({"fleet": [
        ...     {"name": "r1", "route": {"start": [0, 0], "goal": [9, 0]}}]}).is_spatial
        False
        """
        kinds = any(robot.is_spatial for robot in self.robots.values())
        return kinds or any(one.mission.is_spatial for one in self.members)

    @cached_property
    def members(self) -> tuple[FleetMember, ...]:
        """The robots with a complete mission each, in the order in which they were given.

        All of them have the very world of the fleet.
        """
        return tuple(
            FleetMember(one.name, Mission.model_construct(**dict(parts)), one.priority, one.rest)
            for one in self.fleet
            for parts in [parts_of(one, self)]
        )
