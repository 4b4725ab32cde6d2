"""The places where robots of a fleet rest: before they depart, and once they have arrived."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.discs_met import discs_met
from viaspline.mission.fleet.fleet import FleetMember

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

RestKind = Literal["start", "goal", "home", "stranded"]


@dataclass(frozen=True)
class RestingPlace:
    """Where a robot stands for long, in the way of others.

    Attributes:
        robot: Its name.
        kind: ``start``: until it departs; ``goal``: from when it has arrived; ``home``: both;
            ``stranded``: at its start for ever, for it has no path.
        at: [m].
        reach: How far it keeps others away on its part [m]; see ``PackedCourses``.
        is_proven: Of one that is stranded, that there is no path for it.
    """

    robot: str
    kind: RestKind
    at: tuple[float, float]
    reach: float
    is_proven: bool = False

    @property
    def name(self) -> str:
        """What it is called as an obstacle."""
        if self.kind == "stranded":
            return f"{self.robot}, which can't leave its start"
        return f"{self.robot}, resting at its {self.kind}"


def rests_of(member: FleetMember, reach: float) -> Iterator[RestingPlace]:
    """Where a robot rests.

    Args:
        member: The robot.
        reach: See ``RestingPlace`` [m].

    Example:
        >>> from viaspline.mission.model import Mission
        >>> mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}})
        >>> [(rest.kind, rest.at) for rest in rests_of(FleetMember("a", mission), 1.0)]
        [('start', (0.0, 0.0)), ('goal', (9.0, 0.0))]
        >>> [rest.kind for rest in rests_of(FleetMember("a", mission, rest="leave"), 1.0)]
        ['start']
    """
    route = member.mission.route
    last = route.goal or (route.via[-1] if route.via else route.start)
    start, goal = route.start.at[:2], (route.start if route.closed else last).at[:2]
    stays = member.rest == "stay"
    if stays and start == goal:
        yield RestingPlace(member.name, "home", (start[0], start[1]), reach)
        return
    yield RestingPlace(member.name, "start", (start[0], start[1]), reach)
    if stays:
        yield RestingPlace(member.name, "goal", (goal[0], goal[1]), reach)


@dataclass(frozen=True, eq=False)
class RestingPlaces:
    """The resting places of a whole fleet, found by where they are.

    Attributes:
        places: Every one of them.
    """

    places: tuple[RestingPlace, ...]

    @cached_property
    def rows(self) -> Floats:
        """x, y and reach of each [m], (n, 3)."""
        return np.array([(*one.at, one.reach) for one in self.places]).reshape(-1, 3)

    @cached_property
    def _tree(self) -> cKDTree:
        from scipy.spatial import cKDTree

        return cKDTree(self.rows[:, :2])

    @cached_property
    def _widest(self) -> float:
        return float(self.rows[:, 2].max(initial=0.0))

    @cached_property
    def _owners(self) -> dict[str, frozenset[int]]:
        owners: dict[str, set[int]] = {}
        for k, one in enumerate(self.places):
            owners.setdefault(one.robot, set()).add(k)
        return {name: frozenset(indices) for name, indices in owners.items()}

    def near(self, spans: Floats, reach: float, but: frozenset[int]) -> Ints:
        """Those whose robots a robot comes too near to somewhere on a curve.

        Args:
            spans: Bézier control polygons of the curve [m], (m, 4, d).
            reach: How far that robot keeps others away on its part [m].
            but: Indices of those that are left out.

        Returns:
            Indices, increasing, (k,).
        """
        curve = spans if spans.flags.writeable else spans.copy()  # numba compiles for one kind
        found = np.flatnonzero(discs_met(curve, self.rows, reach))
        return found[[index not in but for index in found.tolist()]]

    def at(self, points: Floats, reach: float) -> frozenset[int]:
        """Those whose robots a robot comes too near to at one of some points [m], (k, 2)."""
        if not self.places:
            return frozenset()
        near = [self._tree.query_ball_point(point, reach + self._widest) for point in points]
        return frozenset(
            index
            for point, found in zip(points.tolist(), near, strict=True)
            for index in found
            if math.dist(point, self.places[index].at) < reach + self.places[index].reach
        )

    @cached_property
    def stranded(self) -> frozenset[int]:
        """Indices of those that are never left."""
        return frozenset(k for k, one in enumerate(self.places) if one.kind == "stranded")

    def of_robot(self, name: str) -> frozenset[int]:
        """Indices of the places of one robot."""
        return self._owners.get(name, frozenset())


def all_rests(
    members: Sequence[FleetMember], reaches: Sequence[float], stranded: Mapping[str, bool]
) -> RestingPlaces:
    """The resting places of robots.

    Args:
        members: The robots.
        reaches: Of each [m].
        stranded: Those that have no path, and of each whether that is proven.
    """
    found: list[RestingPlace] = []
    for member, reach in zip(members, reaches, strict=True):
        if member.name in stranded:
            x, y = member.mission.route.start.at[:2]
            is_proven = stranded[member.name]
            found.append(RestingPlace(member.name, "stranded", (x, y), reach, is_proven))
        else:
            found += rests_of(member, reach)
    return RestingPlaces(tuple(found))
