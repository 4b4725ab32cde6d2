"""What moves, in ``plan.json`` and ``run.json``.

Tested through ``report/test_moving_pictures``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from viaspline.planner import Plan
from viaspline.spacetime.timed_drive import TimedCandidate
from viaspline.tracks.encountered import Encounters
from viaspline.trajectory.moving_certificate import MovingCertificate
from viaspline.trajectory.yielding.waits import TrafficWait


def moving_certificate_data(certificate: MovingCertificate | None) -> dict[str, Any]:
    """The part of the certificate on what moves; nothing where nothing does."""
    if certificate is None:
        return {}
    return {
        "moving": {
            "clearance_m": certificate.clearance,
            "required_clearance_m": certificate.required,
            "holds": certificate.holds,
            "tightest_at_s": certificate.tightest_at_s,
            "tightest_at": certificate.tightest_at,
            "obstacle": certificate.obstacle,
        }
    }


def timing_choices(plan: Plan) -> dict[str, Any]:
    """Every path that was timed among what moves, and what became of it."""
    if plan.timed is None:
        return {}
    return {
        "among_moving": {
            "free_duration_s": plan.timed.free.duration,
            "candidates": [_candidate(one) for one in plan.timed.candidates],
        }
    }


def waits_data(plan: Plan) -> dict[str, Any]:
    """Where the robot loses time to what moves; nothing where nothing does."""
    if plan.timed is None:
        return {}
    return {"waits": waits_list(plan.timed.waits)}


def waits_list(waits: Iterable[TrafficWait]) -> list[dict[str, Any]]:
    """Where time is lost, when, how much and for what."""
    return [
        {
            "from_m": wait.start,
            "to_m": wait.end,
            "at_s": wait.begins,
            "lost_s": wait.lost,
            "stood_s": wait.stood,
            "obstacle": wait.obstacle,
        }
        for wait in waits
    ]


def _candidate(one: TimedCandidate) -> dict[str, Any]:
    return {
        "passes": [
            {
                "obstacle": passing.obstacle,
                "side": passing.side,
                "from_s": passing.from_time,
                "until_s": passing.until,
            }
            for passing in one.passings
        ],
        "searched": one.is_searched,
        "length_m": one.length,
        "free_arrival_s": one.free_arrival,
        "arrival_s": one.arrival,
        "reason": one.reason,
        "chosen": one.chosen,
    }


def encounters_data(met: Encounters | None) -> dict[str, Any]:
    """How near the drive came to what moves, and every contact; nothing where nothing moved."""
    if met is None:
        return {}
    return {
        "moving": {
            "min_clearance_m": met.clearance,
            "tightest_at_s": met.time,
            "nearest": met.obstacle,
        },
        "contacts": [
            {
                "time_s": contact.time,
                "obstacle": contact.obstacle,
                "robot_speed_mps": contact.robot_speed,
                "appeared_within_braking_time": contact.appeared_within_braking_time,
            }
            for contact in met.contacts
        ],
        "passes": [
            {
                "time_s": one.time,
                "obstacle": one.obstacle,
                "clearance_m": one.clearance,
                "robot_speed_mps": one.robot_speed,
            }
            for one in met.passes
        ],
    }
