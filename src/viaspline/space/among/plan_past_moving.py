"""A plan in space past what moves: by waiting, or by another path, whichever arrives first.

The path among what stands comes first: the robot flies slower or hovers where something passes.
Where that loses time, or can't be, a path is laid round all of the way of what is met, above, below
or beside it, and timed as well; or round what it passes of that way while the robot meets it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Final

import numpy as np

from viaspline.errors import GaveUpError, PlanningError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.swept_way import capsule_round
from viaspline.space.among.timed_past import (
    kept_about,
    proven_beside,
    solids_beside,
    timed_past,
)
from viaspline.space.laid_round import laid_round
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.trajectory import Trajectory

WORTH_S: Final = 1.0
"""What has to be lost by waiting before another path is looked for [s]."""
MAX_LINES: Final = 60
"""A path is laid round the way of what moves if that has no more lines."""
BESIDE_S: Final = (math.inf, 6.0, 2.0)
"""Round how much of the way of what is met a path is laid: before and after it is nearest [s]."""
HAIR_M: Final = 1e-3
"""By which a path may pass beside what it is led round."""
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
    first = _timed(static)
    found = [] if isinstance(first, str) else [first]
    in_the_way = {first} if isinstance(first, str) else {one.obstacle for one in first.waits}
    if isinstance(first, str) or first.trajectory.end_time > law.end_time + WORTH_S:
        moving = _beside(static)
        for beside in BESIDE_S:
            found += _led_round(static, moving, in_the_way, beside)
            if found and min(one.trajectory.end_time for one in found) < law.end_time + WORTH_S:
                break
    if not found:
        raise GaveUpError(
            f"no time law past {' and '.join(repr(name) for name in sorted(in_the_way))} was found "
            "on any path that was tried",
            where=static.path.evaluate(0.0).tolist(),
            remedy="let it depart later (route.depart_s), or give it a via point beside its way",
            tried=(
                "waiting and slowing down",
                "paths round the way of what moves, all of it or where it is met",
            ),
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
    moving = _beside(static)
    return proven_beside(static.path, law, static.mission.route.hold_s, static.mission, moving)


def _beside(static: SpatialPlan) -> tuple[MovingSolid, ...]:
    """What moves beside a plan. Its own: as long as for another path is proven to other bits."""
    return solids_beside(static.mission, static.trajectory, static.mission.route.hold_s)


def _timed(plan: SpatialPlan) -> SpatialPlan | str:
    """A plan with its law past what moves, proven; or the name of what it can't let pass."""
    past = timed_past(plan.path, plan.trajectory, plan.limits, plan.mission, _beside(plan))
    if isinstance(past, str):
        return past
    return replace(plan, trajectory=past.trajectory, moving=past.proof, waits=past.waits)


def _led_round(
    static: SpatialPlan, moving: Sequence[MovingSolid], in_the_way: set[str], beside: float
) -> list[SpatialPlan]:
    """Plans on paths round the way of what is met, and of what these meet then.

    Args:
        static: The plan as if nothing moved.
        moving: What moves beside it.
        in_the_way: The names of what it meets.
        beside: How long before and after it is nearest what is met is gone round [s].
    """
    round_them = set(in_the_way)
    for _ in range(MAX_ROUNDS):
        met = [_near(one, static, beside) for one in moving if one.name in round_them]
        obstacles = [part for one in met for part in swept(one, static)]
        if not obstacles:
            return []
        try:
            timed = _timed(laid_round(static, obstacles))
        except PlanningError:
            return []
        if not isinstance(timed, str):
            return [timed]
        if timed in round_them:
            return []
        round_them.add(timed)
    return []


def _near(one: MovingSolid, static: SpatialPlan, beside: float) -> MovingSolid:
    """Something that moves, from so long before it is nearest to a plan until so long after."""
    if math.isinf(beside):
        return one
    proof = proven_beside(static.path, static.trajectory, 0.0, static.mission, [one])
    return one.between(proof.tightest_at_s - beside, proof.tightest_at_s + beside)


def swept(one: MovingSolid, plan: SpatialPlan) -> list[Obstacle]:
    """All that something passes while a robot may be under way, as obstacles that stand.

    But for where the route begins, ends or has a via point: there it is let pass. None where its
    way has too many lines.
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
    radius, half, margin = kept_about(plan.mission)
    kept = math.hypot(radius, half) + margin + HAIR_M
    found: list[Obstacle] = []
    for first, last in ways:
        ends = np.array(first), np.array(last)
        whole = capsule_round(one, *ends, off, one.name).capsule
        assert whole is not None
        for a, b in _beyond(points[:, : len(whole.to)], *ends, whole.radius + kept):
            part = ends[0] + a * (ends[1] - ends[0]), ends[0] + b * (ends[1] - ends[0])
            name = f"the way of {one.name}, {len(found) + 1}"
            found.append(capsule_round(one, *part, off, name))
    return found


def _beyond(
    places: np.ndarray, first: np.ndarray, last: np.ndarray, near: float
) -> list[tuple[float, float]]:
    """The parts of a line that are farther than so much from each of some places, as its shares."""
    axes = places.shape[1]
    way = last[:axes] - first[:axes]
    size = float(way @ way)
    if size == 0.0:
        return [] if (np.linalg.norm(places - first[:axes], axis=1) <= near).any() else [(0.0, 1.0)]
    middle = (places - first[:axes]) @ way / size
    aside = np.linalg.norm(places - first[:axes] - middle[:, None] * way, axis=1)
    half = np.sqrt(np.maximum(near * near - aside * aside, 0.0) / size)
    parts, begin = [], 0.0
    for k in np.argsort(middle - half):
        if half[k] > 0.0 and middle[k] - half[k] > begin:
            parts.append((begin, min(float(middle[k] - half[k]), 1.0)))
        if half[k] > 0.0:
            begin = max(begin, float(middle[k] + half[k]))
    parts.append((begin, 1.0))
    return [(a, b) for a, b in parts if a < b]
