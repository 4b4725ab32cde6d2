"""A plan in space past what moves: by waiting, or by another path, whichever arrives first.

The path among what stands comes first: the robot flies slower or hovers where something passes.
Where that loses time, or can't be, a path is laid round all of the way of what is met, above, below
or beside it, and timed as well.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Final

import numpy as np

from viaspline.errors import GaveUpError, PlanningError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.swept_way import capsule_round
from viaspline.space.among.timed_past import proven_beside, solids_beside, timed_past
from viaspline.space.laid_round import laid_round
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.trajectory import Trajectory

WORTH_S: Final = 1.0
"""What has to be lost by waiting before another path is looked for [s]."""
MAX_LINES: Final = 60
"""A path is laid round the way of what moves if that has no more lines."""
MAX_ROUNDS: Final = 3
"""How often a path is laid, round ever more of what moves."""


def plan_past_moving(static: SpatialPlan) -> SpatialPlan:
    """A plan past what moves in its world.

    Args:
        static: The plan as if nothing moved.

    Returns:
        The one that arrives first of those that were tried; with ``optimise: length`` the shortest.

    Raises:
        GaveUpError: None was found.
    """
    mission, law = static.mission, static.trajectory
    moving = solids_beside(mission, law, mission.route.hold_s)
    first = _timed(static, moving)
    found = [] if isinstance(first, str) else [first]
    in_the_way = {first} if isinstance(first, str) else {one.obstacle for one in first.waits}
    if isinstance(first, str) or first.trajectory.end_time > law.end_time + WORTH_S:
        found += _led_round(static, moving, in_the_way)
    if not found:
        raise GaveUpError(
            f"no time law past {' and '.join(repr(name) for name in sorted(in_the_way))} was found "
            "on any path that was tried",
            where=static.path.evaluate(0.0).tolist(),
            remedy="let it depart later (route.depart_s), or give it a via point beside its way",
            tried=("waiting and slowing down", "paths round the whole way of what moves"),
        )
    if mission.route.optimise == "length":
        return min(found, key=lambda one: one.path.length)
    return min(found, key=lambda one: one.trajectory.end_time)


def proof_past_moving(static: SpatialPlan, law: Trajectory) -> MovingCertificate:
    """Prove how far a robot stays from what moves, on another law than if nothing moved.

    Args:
        static: The plan as if nothing moved.
        law: Along its path.
    """
    hold = static.mission.route.hold_s
    moving = solids_beside(static.mission, static.trajectory, hold)
    return proven_beside(static.path, law, hold, static.mission, moving)


def _timed(plan: SpatialPlan, moving: Sequence[MovingSolid]) -> SpatialPlan | str:
    """A plan with its law past what moves, proven; or the name of what it can't let pass."""
    past = timed_past(plan.path, plan.trajectory, plan.limits, plan.mission, moving)
    if isinstance(past, str):
        return past
    return replace(plan, trajectory=past.trajectory, moving=past.proof, waits=past.waits)


def _led_round(
    static: SpatialPlan, moving: Sequence[MovingSolid], in_the_way: set[str]
) -> list[SpatialPlan]:
    """Plans on paths round the whole way of what is met, and of what these meet then."""
    round_them = set(in_the_way)
    for _ in range(MAX_ROUNDS):
        obstacles = [
            part for one in moving if one.name in round_them for part in swept(one, static)
        ]
        if not obstacles:
            return []
        try:
            timed = _timed(laid_round(static, obstacles), moving)
        except PlanningError:
            return []
        if not isinstance(timed, str):
            return [timed]
        if timed in round_them:
            return []
        round_them.add(timed)
    return []


def swept(one: MovingSolid, plan: SpatialPlan) -> list[Obstacle]:
    """All that something passes while a robot may be under way, as obstacles that stand.

    None where its way has too many lines, or it is where the route has to pass anyway.
    """
    ways = dict.fromkeys(
        (tuple(first), tuple(last))
        for k, (first, last) in enumerate(pairwise(one.places.round(6).tolist()))
        if one.there[k]
    )
    if len(ways) > MAX_LINES:
        return []
    off = float(one.off.max())
    points = np.array([via.at for via in plan.path.vias if via.kind == "user"], np.float64)
    found = []
    for k, (first, last) in enumerate(ways):
        way = capsule_round(
            one, np.array(first), np.array(last), off, f"the way of {one.name}, {k + 1}"
        )
        assert way.capsule is not None
        ends = np.array(way.capsule.from_), np.array(way.capsule.to)
        if _distance(points[:, : len(ends[0])], *ends) <= way.capsule.radius:
            return []
        found.append(way)
    return found


def _distance(places: np.ndarray, first: np.ndarray, last: np.ndarray) -> float:
    """Of the place that is nearest to a line [m]."""
    way = last - first
    size = float(way @ way)
    share = np.clip((places - first) @ way / (size or 1.0), 0.0, 1.0)
    return float(np.linalg.norm(places - first - share[:, None] * way, axis=1).min())
