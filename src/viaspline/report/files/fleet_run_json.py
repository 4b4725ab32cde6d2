"""``run.json`` of a fleet: when each robot arrived, what held it up, how near any two came.

Tested through ``report/files/test_fleet_run_json``.
"""

from __future__ import annotations

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.report.files.fleet_json import certificate_of_fleet
from viaspline.report.files.json_text import dumps
from viaspline.report.proven_reference import PROVEN_KEY


def fleet_run_json(run: FleetRun, name: str, *, seed: int = 0) -> str:
    """The text of ``run.json``.

    Args:
        run: What was driven.
        name: The fleet's name.
        seed: Of what was random.
    """
    return dumps(
        {
            "fleet": {"name": name, "seed": seed},
            **PROVEN_KEY,
            "reached": run.reached,
            "duration_s": run.end_s,
            "mean_delay_s": run.mean_delay,
            "deadlock": run.deadlock,
            "certificate": certificate_of_fleet(run.certificate),
            "robots": [
                {
                    "name": robot,
                    "arrived_s": run.arrivals.get(robot),
                    "delay_s": run.delays.get(robot),
                }
                for robot in run.names
            ],
            "events": [
                {
                    "kind": event.kind,
                    "time_s": event.time,
                    "robot": event.name,
                    "other": event.other,
                    "at_m": event.at_m,
                    "message": event.message,
                }
                for event in run.events
            ],
        }
    )
