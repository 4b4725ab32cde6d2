"""A path that steps aside for resting places, and stays as it is elsewhere.

What robots keep from each other is small beside their paths. To lay a whole path anew for it, with
all sides compared, takes twenty times as long as to bend it where it has to be, and what comes of
it is hardly better. A path that has more to keep than its via points and its distances is laid
anew all the same: see ``can_step_aside``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from viaspline.curve.bending import is_round
from viaspline.curve.path import Path, PathVia
from viaspline.errors import GeometryError
from viaspline.fleet.laying.turned_round import TurnedRound
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.marked_joints import ASIDE, FIXED, FREE, KEPT
from viaspline.kernels.fleet.sidestep import step_aside
from viaspline.machine.allowance import allowance
from viaspline.machine.machine_limits import limits_of
from viaspline.mission.model import Mission
from viaspline.mission.spot_turning import is_driven
from viaspline.planner import Plan
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.retime import retime
from viaspline.whole_plan import stations

Turning: TypeAlias = Callable[[Floats, Ints], tuple[Floats, Ints]]
"""From spans and marks to those from another start on."""

SHARPEST_PER_M = 0.5
"""The bend of a step aside where no limit asks for a gentler one [1/m]."""
JOINT = 1e-9
"""How far from a joint of spans a via point may lie, as a parameter."""


def can_step_aside(plan: Plan) -> bool:
    """Whether the path of a plan may be bent wherever there is room.

    Not if the robot can't follow any bend, or its path keeps to sides, has height, or was chosen
    among what moves.
    """
    requirements = Requirements.of(plan.mission, plan.tracking_error)
    return (
        requirements.turn_radius is None
        and plan.path.dimension == 2
        and plan.timed is None
        and not plan.world.sided.size
        and all(abs(via.u - round(via.u)) < JOINT for via in plan.path.vias)
    )


@dataclass(frozen=True, eq=False)
class SteppedAside:
    """What came of stepping aside.

    Attributes:
        plan: Proven in its world; None where there is no room to step aside in bends that are as
            round as the robot's own body, if its path has been so round.
        no_room_for: Index of the disc for which there is none, where that is known.
    """

    plan: Plan | None
    no_room_for: int | None = None


def stepped_aside(plan: Plan, discs: Floats) -> SteppedAside:
    """A plan whose path steps aside for discs.

    Args:
        plan: One that can: see ``can_step_aside``.
        discs: x, y of each, and the distance that the path has to keep from there [m], (n, 3).
    """
    marks = marks_of(plan)
    found = _bent(plan, plan.path.spans.copy(), marks, discs)
    route = plan.mission.route
    if found.plan is not None or not route.closed or route.start.heading_deg is not None:
        return found
    turned = TurnedRound.of(plan.path, marks, discs)
    if turned is None:
        return found
    elsewhere = _bent(plan, turned.spans, turned.marks, discs, turned.back)
    return found if elsewhere.plan is None else elsewhere


def _bent(
    plan: Plan, spans: Floats, marks: Ints, discs: Floats, back: Turning | None = None
) -> SteppedAside:
    """A plan along its path bent aside, which may be given from another start on."""
    requirements = Requirements.of(plan.mission, plan.tracking_error)
    spans, marks, failed = step_aside(
        plan.world.packed, spans, marks, discs, requirements.required,
        free_bend(limits_of(plan.mission.robot)),
    )  # fmt: skip
    if failed >= 0:
        return SteppedAside(None, int(failed))
    if back is not None:
        spans, marks = back(spans, marks)
    found, radius = plan_along(plan, spans, marks), plan.mission.robot.outer_radius
    is_sharp = found is not None and radius > 0.0 and not is_round(found.path, radius)
    return SteppedAside(None if is_sharp and is_round(plan.path, radius) else found)


def plan_along(plan: Plan, spans: Floats, marks: Ints) -> Plan | None:
    """A plan along its path with other bends; None where that can't be proven, or driven.

    Args:
        plan: One that can step aside: see ``can_step_aside``.
        spans: Bézier control polygons of the path [m], (m, 4, 2).
        marks: Of its joints, (m + 1,): see ``kernels.fleet.sidestep.step_aside``.
    """
    robot, world = plan.mission.robot, plan.world
    path = Path(spans, list(_vias(plan.path, spans, marks)))
    certificate = proven(path, world, Requirements.of(plan.mission, plan.tracking_error))
    if not certificate.holds:
        return None
    zones = plan.mission.world.speed_zones
    try:
        law = retime(path, limits_of(robot), stations(path, robot), zones=zones)
    except GeometryError:
        return None
    found = replace(plan, path=path, certificate=certificate, trajectory=law)
    return found if _follows(found, plan.mission) else None


def _follows(plan: Plan, mission: Mission) -> bool:
    """Whether the robot gets no farther beside its path than the path allows for."""
    robot = mission.robot
    if robot.tracking_error_m is not None or not is_driven(robot):
        return True
    return allowance(plan.path, plan.trajectory, robot) <= plan.tracking_error


def free_bend(limits: Limits) -> float:
    """The curvature at which the robot needn't slow down, if that is gentle [1/m]."""
    across = limits.max_lateral_accel
    by_accel = math.inf if across is None else across / limits.max_speed**2
    by_yaw = math.inf if limits.max_yaw_rate is None else limits.max_yaw_rate / limits.max_speed
    return min(by_accel, by_yaw, SHARPEST_PER_M)


def marks_of(plan: Plan) -> Ints:
    """The joints of a plan's path as the kernel takes them; a round goes on where it ends."""
    path, route = plan.path, plan.mission.route
    marks = np.full(len(path.spans) + 1, FREE, np.int64)
    for via in path.vias:
        marks[round(via.u)] = KEPT if via.kind == "user" else ASIDE
    starts, ends = (
        end is not None and end.heading_deg is not None for end in (route.start, route.goal)
    )
    marks[0] = FIXED if starts or route.closed else KEPT
    marks[-1] = FIXED if ends or route.closed else KEPT
    return marks


def _vias(path: Path, spans: Floats, marks: Ints) -> Iterator[PathVia]:
    """The via points of a path that has stepped aside."""
    kept = iter([via for via in path.vias if via.kind == "user"])
    for joint, mark in enumerate(marks.tolist()):
        if mark in (KEPT, FIXED):
            yield replace(next(kept), u=float(joint))
        elif mark == ASIDE:
            x, y = spans[joint, 0].tolist() if joint < len(spans) else spans[-1, 3].tolist()
            yield PathVia("detour", (x, y), "detour", float(joint))
