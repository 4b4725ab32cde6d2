"""The plan of a fleet as the page draws it; what the page has already isn't told again.

Tested through ``studio/fleet/test_fleet_server``.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

import numpy as np

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.not_served import NotServed
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.planner import Plan
from viaspline.studio.fleet.planned_fleet import PlannedFleet
from viaspline.studio.moving_messages import tracks
from viaspline.studio.page_numbers import finite, rounded
from viaspline.studio.plan_messages import grids, path_data, problem_data
from viaspline.trajectory.trajectory import Trajectory

SHOWN_WAIT_S: Final = 0.05  # a wait that is shorter isn't shown [s]
SAME_ACCELERATION_MPS2: Final = 1e-7  # stretches of a law with the same are one [m/s²]


def fleet_answer(
    planned: PlannedFleet, revision: int, before: PlannedFleet | None
) -> dict[str, Any]:
    """What the page is told of the plan of a fleet, or of why there is none.

    Args:
        planned: What came of the document.
        revision: What the page calls this state of it.
        before: What the page was told of last.
    """
    plan = planned.plan
    return {
        "type": "planned",
        "rev": revision,
        "ms": round(1e3 * planned.seconds, 3),
        "grids": grids(planned),
        "tracks": tracks(planned),
        "ok": plan is not None,
        "gave_up": False,
        "problems": [problem_data(problem) for problem in planned.problems],
        "missions": {name: one.document for name, one in planned.missions.items()},
        "fleet": None if plan is None else _fleet(planned, plan, before),
    }


def _fleet(planned: PlannedFleet, plan: FleetPlan, earlier: PlannedFleet | None) -> dict[str, Any]:
    before = None if earlier is None else earlier.drawn
    missing = {one.name: one for one in plan.not_served}
    members = plan.fleet.members
    return {
        "served": plan.served,
        "is_whole": planned.is_whole,
        "certificate": _certificate(plan),
        "robots": [_robot(one, plan, missing.get(one.name), before) for one in members],
        "waits": list(_waits(plan)),
    }


def _certificate(plan: FleetPlan) -> dict[str, Any]:
    proof = plan.certificate
    return {
        "separation": finite(proof.separation),
        "required": proof.required,
        "holds": proof.holds,
        "pair": proof.pair,
        "at_s": finite(proof.at_s),
        "at": proof.at,
    }


def _robot(
    member: FleetMember, plan: FleetPlan, missing: NotServed | None, before: FleetPlan | None
) -> dict[str, Any]:
    """What there is of a robot; without ``path`` or ``law`` it is as the page has it."""
    own = plan.planar_plans.get(member.name)
    robot: dict[str, Any] = {
        "name": member.name,
        "radius": member.mission.robot.outer_radius,
        "leaves": member.rest == "leave",
        "missing": None if missing is None else _missing(missing),
    }
    if own is None:
        return {**robot, "path": None, "law": None}
    robot |= {"alone": plan.alone[member.name], "duration": own.trajectory.duration}
    known = None if before is None else before.plans.get(member.name)
    if known is None or known.path is not own.path or known.certificate != own.certificate:
        robot["path"] = path_data(own)
    if known is None or not _is_same_law(known.trajectory, own.trajectory):
        robot["law"] = _law(own.trajectory)
    return robot


def _missing(missing: NotServed) -> dict[str, str]:
    return {
        "outcome": missing.outcome, "reason": missing.reason, "remedy": missing.remedy,
    }  # fmt: skip


def _is_same_law(one: Trajectory, other: Trajectory) -> bool:
    return np.array_equal(one.times, other.times) and np.array_equal(one.distances, other.distances)


def _law(trajectory: Trajectory) -> dict[str, list[float]]:
    """A law by the places where its acceleration changes."""
    rises = trajectory.accelerations
    changes = np.abs(np.diff(rises)) > SAME_ACCELERATION_MPS2
    kept = np.concatenate([[True], changes, [True]])
    return {
        "distances": rounded(trajectory.distances[kept], 4),
        "speeds": rounded(trajectory.speeds[kept], 4),
        "times": rounded(trajectory.times[kept], 4),
    }


def _waits(plan: FleetPlan) -> Iterator[dict[str, Any]]:
    """Who comes later for whom, from when to when, in the order of the crossings."""
    for one in plan.precedences:
        if one.waits_s < SHOWN_WAIT_S or one.second not in plan.plans:
            continue
        enters = _time_at(plan.planar_plans[one.second], one.enters_at)
        yield {
            "robot": one.second,
            "waits_for": one.first,
            "seconds": round(one.waits_s, 3),
            "from": round(enters - one.waits_s, 3),
            "until": round(enters, 3),
        }


def _time_at(plan: Plan, distance: float) -> float:
    """When a robot comes to a place on its path [s]."""
    return float(plan.trajectory.time_at(min(distance, plan.path.length)))
