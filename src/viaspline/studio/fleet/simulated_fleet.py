"""A simulated drive of a fleet as the page plays it: the laws that were driven, and what happened.

Robots keep to their planned paths, which the page has: of each only its law is told.

Tested through ``studio/fleet/test_fleet_drive``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.execution.simulate_fleet import simulate_fleet
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.kernels.arrays import Floats
from viaspline.report.fleet.driven_timelines import driven_timelines
from viaspline.studio.page_numbers import finite, rounded

FLEET_FILES: Final = ("fleet.json", "fleet.png")
FLEET_RUN_FILES: Final = ("run.json", "run.png")
SHOWN_WAIT_S: Final = 0.05  # a wait that is shorter isn't shown [s]
SAME_S: Final = 1e-6  # a stay that is no longer is rounding [s]


@dataclass(frozen=True)
class SimulatedFleet:
    """A fleet that was driven.

    Attributes:
        plan: What was planned.
        run: What was driven of it.
    """

    plan: FleetPlan
    run: FleetRun


def simulated_fleet(plan: FleetPlan, seed: int) -> SimulatedFleet:
    """Drive a plan.

    Args:
        plan: What is driven.
        seed: Of what is random.
    """
    return SimulatedFleet(plan, simulate_fleet(plan.fleet, plan=plan, seed=seed))


def driven_fleet_answer(simulated: SimulatedFleet) -> dict[str, Any]:
    """What the page is told of a drive."""
    plan, run = simulated.plan, simulated.run
    begin = min((one.trajectory.start_time for one in plan.plans.values()), default=0.0)
    proof = run.certificate
    late = [name for name in run.names if name not in run.arrivals and name in plan.plans]
    return {
        "type": "driven",
        "reached": run.reached,
        "reason": f"{', '.join(late)} did not arrive" if late else "",
        "begin": min(begin, 0.0),
        "duration": run.end_s,
        "mean_delay": run.mean_delay,
        "clearance": finite(proof.separation),
        "pair": proof.pair,
        "arrived": len(run.arrivals),
        "events": [
            {"kind": one.kind, "time": one.time, "message": one.message, "robot": one.name}
            for one in run.events
        ],
        "replans": [],
        "sight": None,
        "robots": [
            {"name": name, "law": _law(run, k)}
            for k, name in enumerate(run.names)
            if name in plan.plans
        ],
        "waits": [
            {
                "robot": one.name,
                "waits_for": wait.other,
                "seconds": round(wait.lost, 3),
                "from": round(wait.begin, 3),
                "until": round(wait.end, 3),
            }
            for one in driven_timelines(plan, run)
            for wait in one.waits
            if wait.lost >= SHOWN_WAIT_S
        ],
    }


def _law(run: FleetRun, robot: int) -> dict[str, list[float]]:
    """What a robot drove: a point wherever its acceleration changes, two where it stands."""
    courses, laws = run.courses.packed, run.laws.packed
    nodes = slice(int(courses.first[robot]), int(courses.first[robot + 1]))
    arrive, leave = laws.arrive[nodes].copy(), laws.leave[nodes].copy()
    along, speed = courses.distance[nodes], laws.speed[nodes]
    arrive[0] = arrive[0] if np.isfinite(arrive[0]) else min(leave[0], 0.0)
    there = np.isfinite(arrive)
    stays = there & np.isfinite(leave) & (leave > arrive + SAME_S)
    rows = np.concatenate([np.column_stack([along, arrive, speed])[there],
                           np.column_stack([along, leave, speed])[stays]])  # fmt: skip
    rows = rows[np.lexsort((rows[:, 1], rows[:, 0]))]
    rows = rows[_turns(rows)]
    return {
        "distances": rounded(rows[:, 0], 4),
        "speeds": rounded(rows[:, 2], 4),
        "times": rounded(rows[:, 1], 4),
    }


def _turns(rows: Floats) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """The rows at which the acceleration changes, and both ends."""
    lasts = np.diff(rows[:, 1])
    rises = np.divide(np.diff(rows[:, 2]), lasts, out=np.zeros(len(lasts)), where=lasts > 0.0)
    stands = np.diff(rows[:, 0]) == 0.0
    changes = (np.abs(np.diff(rises)) > 1e-6) | (stands[1:] != stands[:-1])
    return np.concatenate([[True], changes, [True]])


def fleet_file(plan: FleetPlan, kind: str, name: str) -> bytes:
    """One of the files of a fleet's plan: ``fleet.json`` or ``fleet.png``."""
    if kind == "fleet.json":
        from viaspline.report.files.fleet_json import fleet_json
        from viaspline.report.files.fleet_results import folder_names

        return fleet_json(plan, name, folder_names(one.name for one in plan.fleet.members)).encode()
    from viaspline.report.fleet.fleet_picture import fleet_picture

    return fleet_picture(plan, name)


def fleet_run_file(simulated: SimulatedFleet, kind: str, name: str, seed: int) -> bytes:
    """One of the files of a fleet's drive: ``run.json`` or ``run.png``."""
    if kind == "run.json":
        from viaspline.report.files.fleet_run_json import fleet_run_json

        return fleet_run_json(simulated.run, name, seed=seed).encode()
    from viaspline.report.fleet.fleet_run_picture import fleet_run_picture

    return fleet_run_picture(simulated.plan, simulated.run, name)
