"""The path of one robot, round the resting places of others that it would come too near to.

A path keeps a little more from them than it must: crossings are found by bounds of curves, some
centimetres wide, and by these as well no path is to pass where another robot rests. Where there is
no path round a place, it is passed: the robot has to get by before the other one has arrived there,
or once it has departed. That is a matter of timing, and not settled here.

Tested through ``fleet/laying/test_lay_paths``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.errors import GeometryError, PlanningError
from viaspline.fleet.laying.resting_places import RestingPlace, RestingPlaces
from viaspline.fleet.laying.step_aside import can_step_aside, stepped_aside
from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.model import Mission
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import Plan, plan_in
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.world.world import World

KEPT_MORE_M = 0.1
"""What a path keeps from resting places beyond what it must [m],"""
ENOUGH_MORE_M = 0.08
"""and what of that it has to keep indeed [m]."""
IN_SIGHT_M = 4.0
"""Once a path is led round something, it sees others that it comes so near to [m]."""
MAX_ROUNDS = 12
"""How often a path is laid, with ever more in its way, or less."""


@dataclass(frozen=True, eq=False)
class LaidPath:
    """A robot's path among resting places.

    Attributes:
        plan: In the world as it is, without them.
        passed: Those that it comes too near to all the same.
    """

    plan: Plan
    passed: tuple[RestingPlace, ...]


def lay_among_rests(
    alone: Plan, mission: Mission, name: str, reach: float, rests: RestingPlaces
) -> LaidPath:
    """Lay the path of a robot round the resting places of others.

    Args:
        alone: Its plan, as if it were alone.
        mission: What was planned.
        name: The robot.
        reach: How far it keeps others away on its part [m].
        rests: Of all robots.
    """
    own = rests.of_robot(name)
    past = rests.at(_points(mission), reach + KEPT_MORE_M)
    round_them: set[int] = set()
    plan = alone
    for _ in range(MAX_ROUNDS):
        out = own | past
        met = rests.near(plan.path.spans, reach + ENOUGH_MORE_M, out)
        if not met.size:
            break
        seen = rests.near(plan.path.spans, reach + IN_SIGHT_M, out)
        aside, others = _aside(plan, reach, rests, seen)
        if aside is not None and not rests.near(aside.path.spans, reach + ENOUGH_MORE_M, out).size:
            plan = aside
            break
        round_them.update(others if set(others) - round_them else seen.tolist())
        plan, past = _laid(alone, mission, reach, rests, round_them, past)
        round_them -= past
    passed = rests.near(plan.path.spans, reach, own).tolist()
    return LaidPath(plan, tuple(rests.places[k] for k in passed))


def _points(mission: Mission) -> Floats:
    """Where the robot has to get to [m], (k, 2)."""
    return np.array([via.at[:2] for _, via in mission.route.points()])


def _aside(
    plan: Plan, reach: float, rests: RestingPlaces, seen: Ints
) -> tuple[Plan | None, list[int]]:
    """The plan that steps aside for resting places, or else those that it is to be laid round."""
    if not can_step_aside(plan):
        return None, seen.tolist()
    discs = rests.rows[seen]
    discs[:, 2] += reach + KEPT_MORE_M
    found = stepped_aside(plan, discs)
    if found.no_room_for is None:
        return found.plan, seen.tolist()
    return None, [int(seen[found.no_room_for])]


def _laid(
    alone: Plan,
    mission: Mission,
    reach: float,
    rests: RestingPlaces,
    round_them: set[int],
    past: frozenset[int],
) -> tuple[Plan, frozenset[int]]:
    """The plan round as many places as there is a way round, and those that it may pass."""
    trying = sorted(round_them)
    while trying:
        try:
            found = plan_in(mission, _with_rests(alone, mission, reach, rests, trying))
        except (PlanningError, GeometryError) as error:
            blamed = _blamed(error, rests, trying)
            past |= blamed
            trying = [k for k in trying if k not in blamed]
            continue
        return _in_world_as_it_is(found, alone.world), past
    return alone, past


def _blamed(
    error: PlanningError | GeometryError, rests: RestingPlaces, tried: Sequence[int]
) -> frozenset[int]:
    """The places that are in the way, as an error has it; all of them if it names none."""
    named = error.obstacles if isinstance(error, PlanningError) else ()
    return frozenset(k for k in tried if rests.places[k].name in named) or frozenset(tried)


def _with_rests(
    alone: Plan, mission: Mission, reach: float, rests: RestingPlaces, indices: Sequence[int]
) -> World:
    """The world with resting places in it.

    A path keeps the robot's own clearance to a disc, which is another length than what robots keep
    from each other: the discs are as large as it takes to make up for the difference.
    """
    required = Requirements.of(mission, alone.tracking_error).required
    rows: Floats = rests.rows[list(indices)].copy()
    rows[:, 2] = np.maximum(rows[:, 2] + reach + KEPT_MORE_M - required, KEPT_MORE_M)
    discs = tuple(
        Obstacle.model_construct(
            name=rests.places[k].name, circle=Circle.model_construct(center=(x, y), radius=radius)
        )
        for k, (x, y, radius) in zip(indices, rows.tolist(), strict=True)
    )
    return alone.world.with_discs(discs, rows)


def _in_world_as_it_is(plan: Plan, world: World) -> Plan:
    """A plan among resting places as one in the world without them, proven there."""
    requirements = Requirements.of(plan.mission, plan.tracking_error)
    return replace(plan, world=world, certificate=proven(plan.path, world, requirements))
