"""The path of one robot, round the resting places of others that it would come too near to.

A path keeps more from them than it must, so much that what is known of crossings has none there:
then timing may keep a robot at its resting place for as long as it likes. Where there is no path
round a place, it is passed: the robot has to get by before the other one has arrived there, or once
it has departed. That is a matter of timing, and not settled here. Where a robot stands that can't
leave, no path passes.

Tested through ``fleet/laying/test_lay_paths``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.errors import GeometryError, PlanningError
from viaspline.fleet.laying.resting_places import RestingPlace, RestingPlaces
from viaspline.fleet.laying.rests_as_obstacles import world_with_rests
from viaspline.fleet.laying.soon_laid import check_soon_laid
from viaspline.fleet.laying.step_aside import can_step_aside, stepped_aside
from viaspline.fleet.laying.stranded_robots import (
    POSES_S,
    no_way_past_stranded,
    stranded_at_point,
)
from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan_in
from viaspline.planning.alternatives.record import Account
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import SpentBudgetError, WorkBudget
from viaspline.world.world import World

KEPT_MORE_M = 0.1
"""What a path keeps from resting places beyond what it must [m],"""
ENOUGH_MORE_M = 0.085
"""and what of that it has to keep indeed [m]: crossings may reach 0.02 m beyond a cell, 0.05 m
beyond a piece of several, and as far as the end of a course, which is 0.01 m long."""
HAIR_M = 1e-4
"""What is left of that where a via point is nearer to a resting place [m], at least."""
IN_SIGHT_M = 4.0
"""Once a path is led round something, it sees others that it comes so near to [m]."""
MAX_LOOKS = 4
"""How often a path steps aside, each time for those as well that it saw aside."""
MOST_MET = 40
"""A path that comes too near to more places isn't bent aside for them one by one: the time for that
grows with their square, and they stand for wherever one may be that doesn't drive any more."""
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
    alone: Plan, mission: Mission, name: str, reach: float, rests: RestingPlaces,
    work: WorkBudget | None = None,
) -> LaidPath:  # fmt: skip
    """Lay the path of a robot round the resting places of others.

    Args:
        alone: Its plan, as if it were alone.
        mission: What was planned.
        name: The robot.
        reach: How far it keeps others away on its part [m].
        rests: Of all robots.
        work: What may be spent on paths of a body; None: as much as it takes.

    Raises:
        NoPathError: When there is no path round robots that can't leave.
        GaveUpError: When none was found, or it isn't proven that these can't leave, or what may be
            spent was spent before that was known.
    """
    own = rests.of_robot(name)
    points = _points(mission)
    past = rests.at(points, reach)
    stuck = rests.stranded - own
    if stuck & past:
        raise stranded_at_point(mission, reach, rests.places[min(stuck & past)])
    eased = _eased(rests, points, reach, past | own, KEPT_MORE_M)
    round_them: set[int] = set()
    plan, poses = alone, WorkBudget(math.inf, poses=WorkBudget(POSES_S))
    for _ in range(MAX_ROUNDS):
        out = own | past
        met = eased.near(plan.path.spans, reach + ENOUGH_MORE_M, out)
        if not met.size:
            break
        may_bend = met.size <= MOST_MET and can_step_aside(plan)
        aside, seen, others = _aside(plan, reach, eased, out, may_bend=may_bend)
        if aside is None and may_bend:
            rather = _eased(rests, points, reach, out, 2.0 * KEPT_MORE_M)
            if rather.places != eased.places:
                aside, _, _ = _aside(plan, reach, rather, out, may_bend=True)
        if aside is not None:
            plan = aside
            break
        round_them.update(_more_in_the_way(eased, reach, round_them, others, seen))
        plan, past = _laid(alone, mission, reach, eased, round_them, past, work, poses)
        round_them -= past
    passed = rests.near(plan.path.spans, reach, own).tolist()
    stands = [k for k in passed if k in stuck]
    if stands:
        raise no_way_past_stranded(alone, mission, reach, rests, stands)
    return LaidPath(plan, tuple(rests.places[k] for k in passed))


def _more_in_the_way(
    rests: RestingPlaces, reach: float, round_them: set[int], others: Sequence[int], seen: Ints
) -> Sequence[int]:
    """Places that a path is to be laid round as well: a few, as each of them takes its time.

    Those beside a place for which there was no room are among them at once: led round that place
    alone, a path would come too near to them, and be laid once more.

    Args:
        rests: Of all robots.
        reach: How far the robot keeps others away on its part [m].
        round_them: Those that it is laid round already.
        others: Those for which there was no room to step aside.
        seen: All that the path comes near to.
    """
    at, beside = rests.rows[seen], np.zeros(len(seen), np.bool_)
    for k in others:
        x, y, its = rests.rows[k]
        gap = np.hypot(at[:, 0] - x, at[:, 1] - y) - at[:, 2] - its
        beside |= gap < 2.0 * (reach + KEPT_MORE_M)  # no room between the two
    near: set[int] = {*others, *seen[beside].tolist()}
    return sorted(near) if near - round_them else seen.tolist()


def _eased(
    rests: RestingPlaces, points: Floats, reach: float, out: frozenset[int], spare_m: float
) -> RestingPlaces:
    """Resting places of which less is kept where one of a robot's points hardly allows for more.

    Args:
        rests: Of all robots.
        points: Where the robot has to get to [m], (k, 2).
        reach: How far it keeps others away on its part [m].
        out: Indices of those that don't count.
        spare_m: Where a point is by less than this farther away than it must be [m], half of that
            is kept, if it isn't more than elsewhere.
    """
    tight = rests.at(points, reach + spare_m) - out
    if not tight:
        return rests
    places = list(rests.places)
    for k in tight:
        one = places[k]
        spare = float(np.hypot(*(points - one.at).T).min()) - reach - one.reach
        given = KEPT_MORE_M - max(0.5 * spare, HAIR_M)
        places[k] = replace(one, reach=max(one.reach - given, 0.0))
    return RestingPlaces(tuple(places))


def _points(mission: Mission) -> Floats:
    """Where the robot has to get to [m], (k, 2)."""
    return np.array([via.at[:2] for _, via in mission.route.points()])


def _aside(
    plan: Plan, reach: float, rests: RestingPlaces, out: frozenset[int], *, may_bend: bool
) -> tuple[Plan | None, Ints, list[int]]:
    """The plan that steps aside for resting places.

    Args:
        plan: It as it is.
        reach: How far the robot keeps others away on its part [m].
        rests: Of all robots.
        out: Indices of those that don't count.
        may_bend: Whether its path may be bent aside.

    Returns:
        (the plan; None where there is no such, those that it sees, those of them that it is to be
        laid round then).
    """
    seen = rests.near(plan.path.spans, reach + IN_SIGHT_M, out)
    if not may_bend:
        return None, seen, seen.tolist()
    for _ in range(MAX_LOOKS):
        discs = rests.rows[seen]
        discs[:, 2] += reach + KEPT_MORE_M
        found = stepped_aside(plan, discs)
        if found.no_room_for is not None:
            return None, seen, [int(seen[found.no_room_for])]
        if found.plan is None:
            break
        met = rests.near(found.plan.path.spans, reach + ENOUGH_MORE_M, out)
        if not met.size:
            return found.plan, seen, []
        if np.isin(met, seen).all():
            break
        seen = np.union1d(seen, rests.near(found.plan.path.spans, reach + IN_SIGHT_M, out))
    return None, seen, seen.tolist()


def _laid(
    alone: Plan,
    mission: Mission,
    reach: float,
    rests: RestingPlaces,
    round_them: set[int],
    past: frozenset[int],
    work: WorkBudget | None,
    poses: WorkBudget,
) -> tuple[Plan, frozenset[int]]:
    """The plan round as many places as there is a way round, and those that it may pass.

    Raises:
        PlanningError: When there is no way round those that can't leave, or what may be spent is.
    """
    stuck = rests.stranded
    trying = sorted(round_them)
    while trying:
        try:
            among = world_with_rests(alone, mission, reach, rests, trying, KEPT_MORE_M)
            if work is not None:
                check_soon_laid(mission, among, alone.tracking_error, work)
            found = plan_in(mission, among, poses)
        except SpentBudgetError:
            raise
        except (PlanningError, GeometryError) as error:
            if set(trying) <= stuck:
                raise no_way_past_stranded(alone, mission, reach, rests, trying) from error
            blamed = _blamed(error, rests, trying) - stuck or frozenset(trying) - stuck
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


def _in_world_as_it_is(plan: Plan, world: World) -> Plan:
    """A plan among resting places as one in the world without them, proven there.

    Of those that are held for a whole fleet, some had a lattice of fifty megabytes.
    """
    if isinstance(plan.account, Account):
        plan.account.without_lattices()
    requirements = Requirements.of(plan.mission, plan.tracking_error)
    return replace(plan, world=world, certificate=proven(plan.path, world, requirements))
