"""Paths that swerve: whose may, and the plan of one that does.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.laying.lay_among_rests import ENOUGH_MORE_M
from viaspline.fleet.laying.resting_places import RestingPlaces
from viaspline.fleet.laying.step_aside import can_step_aside, free_bend, marks_of, plan_along
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.marked_joints import FIXED, KEPT
from viaspline.kernels.fleet.swerved_path import swerved_path
from viaspline.machine.machine_limits import limits_of
from viaspline.planner import Plan
from viaspline.planning.problem.requirements import Requirements

LOOKS = 8
"""So often each span is looked at for how sharply it turns."""
SHARP = 2.0
"""A path turns sharply where it does by more than this, in curvatures that cost no speed."""


def may_swerve(plan: Plan) -> bool:
    """Whether a path may be led aside just because others would wait less.

    Not that of a footprint, nor if the mission says how it is to run: in a corridor, on lines
    between via points, on sides of obstacles, or as a spline of a certain kind.
    """
    route, spline = plan.mission.route, plan.mission.spline
    requirements = Requirements.of(plan.mission, plan.tracking_error)
    return (
        can_step_aside(plan)
        and requirements.is_free_disc
        and route.corridor is None
        and route.detours != "local"
        and spline.tangents is None
        and not requirements.has_own_tension
    )


def bend_of(plan: Plan) -> float:
    """The curvature up to which a robot needn't slow down; 0 if its path is to stay [1/m]."""
    return free_bend(limits_of(plan.mission.robot)) if may_swerve(plan) else 0.0


def kept_distances(plan: Plan) -> Floats:
    """Where along its path a plan can't swerve across [m], increasing, (k,).

    It runs through places where it has to, and turns so sharply at others that it would have to
    turn more sharply still.
    """
    path, marks = plan.path, marks_of(plan)
    has_to = np.flatnonzero((marks == KEPT) | (marks == FIXED)).astype(float)
    u = np.linspace(*path.domain, LOOKS * len(path.spans) + 1)
    is_sharp = np.abs(path.curvature(u)) > SHARP * free_bend(limits_of(plan.mission.robot))
    return np.sort(np.asarray(path.distance(np.concatenate([has_to, u[is_sharp]])), float))


def swerved(
    plan: Plan, swerves: Floats, name: str, reach: float, rests: RestingPlaces
) -> tuple[Plan, np.ndarray] | None:
    """A plan whose path swerves, and which of the swerves it makes.

    Args:
        plan: One that may: see ``may_swerve``.
        swerves: See ``swerved_path``, (k, 4).
        name: The robot.
        reach: How far it keeps others away on its part [m].
        rests: Of all robots.

    Returns:
        None where there is no such plan, or it passes places of others that it didn't pass before.
    """
    required = Requirements.of(plan.mission, plan.tracking_error).required
    spans, marks, is_made = swerved_path(
        plan.world.packed, plan.path.spans.copy(), marks_of(plan), swerves, required
    )
    if not is_made.any():
        return None
    found = plan_along(plan, spans, marks)
    if found is None:
        return None
    own, near = rests.of_robot(name), reach + ENOUGH_MORE_M
    passed = rests.near(plan.path.spans, near, own)
    if not np.isin(rests.near(found.path.spans, near, own), passed).all():
        return None
    return found, is_made
