"""``run.json``: what was driven, every event and every re-plan; ``timing.json``: the wall clock.

Tested through ``report/files/test_plan_json``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from viaspline.curve.path import Path
from viaspline.machine.excess import Excess
from viaspline.report.files.json_text import dumps
from viaspline.report.files.moving_json import encounters_data
from viaspline.report.files.plan_json import mission_summary, path_data
from viaspline.report.proven_reference import PROVEN_KEY
from viaspline.report.remarks import FOLLOWED_EXACTLY, keeps_nothing
from viaspline.robot.run import Replan, Run, Shortfall


def run_json(run: Run, name: str, *, seed: int = 0) -> str:
    """The text of ``run.json``."""
    certificate = run.certificate
    return dumps(
        {
            "mission": {**mission_summary(run.plan.mission, name), "seed": seed},
            **PROVEN_KEY,
            "reached": run.reached,
            "reason": run.reason,
            "duration_s": run.duration,
            "distance_m": run.path.length,
            "min_clearance_m": certificate.clearance,
            "tightest_at": certificate.tightest_at,
            "tightest_distance_m": certificate.tightest_distance,
            "nearest": certificate.obstacle,
            **encounters_data(run.encounters),
            "nearer_than_asked": [_shortfall(shortfall) for shortfall in run.shortfalls],
            "vias": [
                {
                    "name": visit.name,
                    "at": visit.at,
                    "status": visit.status,
                    "time_s": visit.time,
                    "miss_m": visit.miss,
                    "reason": visit.reason,
                }
                for visit in run.visits
            ],
            "events": [
                {
                    "kind": event.kind,
                    "time_s": event.time,
                    "at": event.at,
                    "message": event.message,
                    "data": event.data,
                }
                for event in run.events
            ],
            "replans": [_replan(replan) for replan in run.replans],
            **_tracking(run),
            "path": path_data(run.path),
        }
    )


def _tracking(run: Run) -> dict[str, Any]:
    """What a robot with a drive was off from its path; that nothing is kept for one without."""
    if run.tracking is None:
        nothing = keeps_nothing(run.plan.mission.robot)
        return {"note": FOLLOWED_EXACTLY} if nothing else {}
    cross, heading, along = run.tracking.cross, run.tracking.heading, run.tracking.along
    errors = {
        f"{name}_{percentile}_{unit}": value
        for name, unit, spread in (
            ("cross_track", "m", cross), ("heading", "rad", heading), ("along_track", "m", along)
        )
        for percentile, value in spread._asdict().items()
    }  # fmt: skip
    beyond = [_excess(run, excess) for excess in run.excesses]
    kept = {"allowed_m": run.plan.tracking_error, "kept_to": not beyond}
    return {"tracking": {**kept, **errors, "beyond_allowed": beyond}}


def _excess(run: Run, excess: Excess) -> dict[str, Any]:
    return {
        "since_s": excess.since,
        "until_s": excess.until,
        "worst_time_s": excess.worst_at,
        "at": run.place_at(excess.worst_at),
        "distance_m": excess.distance,
        "off_m": excess.off,
        "beyond_m": excess.off - excess.kept,
    }


def _shortfall(shortfall: Shortfall) -> dict[str, Any]:
    return {
        "obstacle": shortfall.obstacle,
        "on_map": shortfall.on_map,
        "clearance_m": shortfall.clearance,
        "time_s": shortfall.time,
        "at": shortfall.at,
        "surface_at": shortfall.surface_at,
        "shown_s": shortfall.shown,
        "needed_by_s": shortfall.needed_by,
        "seen_in_time": shortfall.seen_in_time,
    }


def _replan(replan: Replan) -> dict[str, Any]:
    return {
        "time_s": replan.time,
        "at": replan.at,
        "distance_m": replan.distance,
        "mode": replan.mode,
        "obstacles": replan.obstacles,
        "changed_from_m": replan.driven + replan.changed_from,
        "rejoins_at_m": None if replan.rejoins_at is None else replan.driven + replan.rejoins_at,
        "spans_changed": changed_spans(replan.path, replan.changed_from, replan.rejoins_at),
        "spans": len(replan.path.spans),
        "position_jump_m": replan.position_jump,
        "heading_jump_rad": replan.heading_jump,
        "curvature_jump_1pm": replan.curvature_jump,
        "work_s": replan.work,
        "length_before_m": replan.driven + replan.old_path.length,
        "length_after_m": replan.driven + replan.path.length,
    }


def changed_spans(path: Path, changed_from: float, rejoins_at: float | None) -> list[int]:
    """The first and the last span of a path that differ from the one it replaced."""
    joints = np.asarray(path.distance(np.linspace(*path.domain, len(path.spans) + 1)))
    end = float(joints[-1]) if rejoins_at is None else rejoins_at
    tolerance = 1e-6 * max(1.0, float(joints[-1]))
    changed = (joints[1:] > changed_from + tolerance) & (joints[:-1] < end - tolerance)
    spans = np.flatnonzero(changed)
    return [int(spans[0]), int(spans[-1])] if spans.size else []


def timing_json(stages: Mapping[str, float], replans: Sequence[float] = ()) -> str:
    """The text of ``timing.json``: the only file that differs from run to run.

    Args:
        stages: Wall-clock time of every stage [s].
        replans: Wall-clock time of every re-plan [s].
    """
    data: dict[str, object] = {"note": "wall-clock times; they differ from run to run"}
    data |= {f"{stage}_s": round(value, 6) for stage, value in stages.items()}
    if replans:
        data["replans_s"] = [round(value, 6) for value in replans]
        data["replan_median_s"] = round(float(np.median(replans)), 6)
        data["replan_max_s"] = round(max(replans), 6)
    return dumps(data)
