"""Plans as the page draws them: the same numbers as in ``plan.json``, without its white space.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.maps.grid import Grid
from viaspline.planner import Plan
from viaspline.planning.problem.ledger import Candidate
from viaspline.report.files.drivability_json import drivability_data
from viaspline.report.files.json_text import plain
from viaspline.studio.map_cache import grid_name
from viaspline.studio.moving_messages import timing, tracks
from viaspline.studio.page_numbers import finite, flat, rounded
from viaspline.studio.plan_document import PlanFault, PlannedDocument
from viaspline.studio.shows_world import ShowsWorld
from viaspline.trajectory.trajectory import Trajectory


def answer(planned: PlannedDocument, revision: int) -> dict[str, Any]:
    """What the page is told of a plan, or of why there is none."""
    head: dict[str, Any] = {"type": "planned", "rev": revision}
    head["ms"] = round(1e3 * planned.seconds, 3)
    head.update(grids=grids(planned), tracks=tracks(planned))
    if planned.plan is None:
        problems = [problem_data(problem) for problem in planned.problems]
        return {**head, "ok": False, "gave_up": planned.gave_up, "problems": problems}
    plan = planned.plan
    shown = {**path_data(plan), **law_data(plan.trajectory)}
    return {**head, "ok": True, **shown, "timing": timing(planned)}


def problem_data(problem: PlanFault) -> dict[str, Any]:
    """A reason why there is no plan."""
    return {
        "text": problem.text,
        "remedy": problem.remedy,
        "path": problem.path,
        "where": None if problem.where is None else problem.where[:2],
        "changes": [{"path": path, "value": value} for path, value in problem.changes],
    }


def path_data(plan: Plan) -> dict[str, Any]:
    """A path, what is proven of it and how it drives."""
    path, proof = plan.path, plan.certificate
    return {
        **from_above(path, [via.kind for via in path.vias]),
        "curvature": 1.0 / plan.drivability.sharpest_radius,
        "certificate": proof_data(proof),
        "drivability": plain(drivability_data(plan.drivability)),
        "corridor": [[rounded(point, 3) for point in ring] for ring in plan.world.corridor],
    }


def from_above(path: Path, kinds: Sequence[str]) -> dict[str, Any]:
    """A path as it lies on the map.

    Args:
        path: In the plane or in space.
        kinds: What each of its via points is to the page.
    """
    joints = np.asarray(path.distance(np.linspace(*path.domain, len(path.spans) + 1)))
    return {
        "spans": flat(path.spans),
        "joints": rounded(joints),
        "vias": [
            [via.name, *via.at[:2], kind, via.u, round(float(distance), 6), via.dwell]
            for via, kind, distance in zip(path.vias, kinds, path.via_distances, strict=True)
        ],
        "length": path.length,
        "order": [via.name for via in path.vias if via.kind == "user"],
    }


def proof_data(proof: Certificate) -> dict[str, Any]:
    """What is proven of a path."""
    return {
        "clearance": finite(proof.clearance),
        "required": proof.required,
        "holds": proof.holds,
        "at": proof.tightest_at[:2],
        "distance": finite(proof.tightest_distance),
        "nearest": proof.obstacle,
    }


def law_data(trajectory: Trajectory) -> dict[str, Any]:
    """When the robot is where."""
    return {
        "law": {
            "distances": rounded(trajectory.distances),
            "speeds": rounded(trajectory.speeds),
            "times": rounded(trajectory.times),
        },
        "duration": trajectory.duration,
    }


def ledger(planned: PlannedDocument, revision: int) -> dict[str, Any]:
    """Every group in the way and both of its sides."""
    plan = planned.plan
    assert plan is not None
    assert planned.unfolded is not None
    names = {name: i for i, name in enumerate(plan.world.names)}
    grids = {i for i, obstacle in enumerate(plan.world.obstacles) if obstacle.grid is not None}
    entries = []
    for entry in plan.ledger:
        members = [names[name] for name in entry.members if name in names]
        is_zone = any(candidate.side == "through" for candidate in entry.candidates)
        if entry.members and not members and not is_zone:
            continue  # what moves, taken to stand: the timed paths say that
        listed = [plan.world.listed_at(i) for i in members]
        items = [planned.unfolded.original(("world", "known", i))[2] for i in listed]
        entries.append({
            "members": entry.members,
            "items": sorted(set(items)),
            "leg": entry.leg,
            "forceable": len(members) == len(entry.members) > 0 and not grids.intersection(members),
            "forced": entry.forced,
            "candidates": [_candidate(candidate) for candidate in entry.candidates],
        })  # fmt: skip
    return {"type": "ledger", "rev": revision, "entries": entries}


def _candidate(candidate: Candidate) -> dict[str, Any]:
    return {
        "side": candidate.side,
        "chosen": candidate.chosen,
        "spans": [] if candidate.chosen else flat(candidate.spans),
        "length": candidate.length,
        "duration": candidate.duration,
        "clearance": finite(candidate.clearance),
        "impossible": candidate.impossible,
        "passedOver": candidate.passed_over,
    }


def grids(planned: ShowsWorld) -> list[dict[str, Any]]:
    """The maps of squares of a mission: their pictures' names and where they lie."""
    if planned.world is None or planned.unfolded is None:
        return []
    found = []
    for key, obstacles in (("known", planned.world.known), ("unseen", planned.world.unseen)):
        for i, obstacle in enumerate(obstacles):
            if obstacle.grid is not None:
                place = planned.unfolded.original(("world", key, i))
                found.append({**_grid(obstacle.grid), "list": key, "item": place[2]})
            elif key in planned.unfolded.places and (ring := obstacle.ring) is not None:
                place = planned.unfolded.original(("world", key, i))
                if "map" in planned.document["world"][key][place[2]]:
                    found.append({"rings": ring.loops, "list": key, "item": place[2]})
    return found


def _grid(grid: Grid) -> dict[str, Any]:
    return {
        "picture": grid_name(grid),
        "origin": grid.origin,
        "resolution": grid.resolution,
        "width": grid.width,
        "height": grid.height,
        "extent": grid.extent,
    }
