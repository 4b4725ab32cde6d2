"""The paths of a fleet in space: each by itself, round the places where others are for long.

A path keeps more from these than it must, so much that none of them is in its way however long a
robot stays there. Where there is no path round a place, it is passed: the robot has to get by
before the other one has come there, or once it has departed. That is a matter of timing. Where a
robot stands that has no path itself, no path passes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.errors import GaveUpError, GeometryError, PlanningError
from viaspline.fleet.laying.laying_workers import LayingWorkers
from viaspline.fleet.not_served import NotServed, Outcome
from viaspline.fleet.space.hover_places import HoverPlace, hovers_of
from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.laid_round import laid_round
from viaspline.space.plan_spatial import plan_spatial
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.static_plan import as_if_still

KEPT_MORE_M: Final = 0.1
"""What a path keeps from resting places beyond what it must [m],"""
ENOUGH_MORE_M: Final = 0.085
"""and what of that it has to keep indeed [m]."""
HAIR_M: Final = 1e-4
"""What is left of that where a point of the route is nearer to a resting place [m]."""
SEEN_EVERY_M: Final = 0.05
"""Between places of a path that are looked at [m]."""
MAX_ROUNDS: Final = 6
"""How often a path is laid, with ever more in its way."""


@dataclass(frozen=True, eq=False)
class FlownPaths:
    """The paths of a fleet in space.

    Attributes:
        plans: Of those that have one, by name, in the order of the fleet; each with the time law
            that its robot would fly alone.
        not_served: The others, with the reason.
    """

    plans: dict[str, SpatialPlan]
    not_served: tuple[NotServed, ...]


def lay_in_space(
    members: Sequence[FleetMember], separation: float, workers: LayingWorkers,
    progress: Callable[[float], None],
) -> FlownPaths:  # fmt: skip
    """Lay the path of every robot, round those places of others that it would pass.

    Args:
        members: The robots.
        separation: Free space between any two bodies [m].
        workers: Who lays the paths as if each were alone.
        progress: Hears the share of paths that are laid.
    """
    done: dict[int, SpatialPlan | NotServed] = {}
    for k, one in workers.each(lay_alone_in_space, members):
        done[k] = one
        progress(0.5 * len(done) / len(members))
    found = {one.name: done[k] for k, one in enumerate(members)}
    alone = {name: one for name, one in found.items() if isinstance(one, SpatialPlan)}
    missing = {name: one for name, one in found.items() if isinstance(one, NotServed)}
    while True:
        laid: dict[str, SpatialPlan] = {}
        stuck: dict[str, NotServed] = {}
        for k, member in enumerate(members):
            progress(0.5 + 0.5 * k / len(members))
            if member.name in missing:
                continue
            others = _hovers_of_others(member, members, alone, missing)
            try:
                laid[member.name] = lay_among_hovers(alone[member.name], others, separation)
            except PlanningError as error:
                stuck[member.name] = not_served_in_space(member.name, error)
        if not stuck:
            break
        missing |= stuck  # these stand at their starts as well, in the way of the others
    return FlownPaths(laid, tuple(missing[one.name] for one in members if one.name in missing))


def lay_alone_in_space(member: FleetMember) -> SpatialPlan | NotServed:
    """A robot's plan as if it were alone, or why there is none.

    Among things that move it is along the path on which it would be soonest alone; its law is the
    one along that path if nothing moved.
    """
    try:
        plan = plan_spatial(member.mission)
        return plan if plan.moving is None else as_if_still(plan)
    except (PlanningError, GeometryError) as error:
        return not_served_in_space(member.name, error)


def not_served_in_space(name: str, error: PlanningError | GeometryError) -> NotServed:
    """What is told of a robot that has no path."""
    if isinstance(error, PlanningError):
        outcome: Outcome = "gave up" if isinstance(error, GaveUpError) else "refused"
        where = tuple(float(number) for number in error.where)
        return NotServed(name, outcome, error.reason, error.remedy, error.obstacles, where)
    reason, _, remedy = str(error).partition("; ")
    return NotServed(name, "refused", reason, remedy)


def _hovers_of_others(
    member: FleetMember, members: Sequence[FleetMember], alone: Mapping[str, SpatialPlan],
    missing: Mapping[str, NotServed],
) -> list[HoverPlace]:  # fmt: skip
    return [
        place
        for other in members
        if other.name != member.name
        for place in hovers_of(other, None if other.name in missing else alone[other.name])
    ]


def lay_among_hovers(
    alone: SpatialPlan, others: Sequence[HoverPlace], separation: float
) -> SpatialPlan:
    """Lay the path of a robot round the places where others are for long.

    Args:
        alone: Its plan, as if it were alone.
        others: These places.
        separation: Free space between any two bodies [m].

    Raises:
        NoPathError: There is no path round robots that can't leave.
        GaveUpError: None was found.
    """
    body = FlyingBody.of(alone.mission.robot)
    points = np.array([via.at for via in alone.path.vias if via.kind == "user"], np.float64)
    spare = [float(place.gaps(body, points).min()) - separation for place in others]
    stranded = [place.is_never_left for place in others]
    round_them = {
        k: min(room - HAIR_M, KEPT_MORE_M)
        for k, room in enumerate(spare)
        if room > HAIR_M or stranded[k]
    }
    plan, taken = alone, set[int]()
    for _ in range(MAX_ROUNDS):
        places = _places_of(plan)
        met = {
            k
            for k, more in round_them.items()
            if places_gap(others[k], body, places) < separation + min(ENOUGH_MORE_M, 0.5 * more)
        }
        if not met - taken:
            break
        taken |= met
        try:
            plan = laid_round(alone, [
                others[k].as_obstacle(separation + round_them[k] - alone.mission.robot.clearance_m)
                for k in sorted(taken)
            ])  # fmt: skip
        except PlanningError:
            firm = {k for k in taken if stranded[k]}
            if firm == taken:
                raise
            for k in taken - firm:
                del round_them[k]
            plan, taken = alone, set()
    return plan


def _places_of(plan: SpatialPlan) -> Floats:
    """Places along a path, close together [m], (n, 3)."""
    count = max(int(np.ceil(plan.path.length / SEEN_EVERY_M)), 1)
    return np.asarray(plan.path.at_distance(np.linspace(0.0, plan.path.length, count + 1)))


def places_gap(place: HoverPlace, body: FlyingBody, places: Floats) -> float:
    """The least free space between a robot that hovers and a body at places [m]."""
    return float(place.gaps(body, places).min())
