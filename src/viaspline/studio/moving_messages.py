"""What moves, as the page draws it: recorded tracks, the plan in time, and space over time.

Tested through ``studio/test_server_moving``.
"""

from __future__ import annotations

from typing import Any, Final

import contourpy
import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import Plan
from viaspline.report.files.json_text import plain
from viaspline.report.files.moving_json import moving_certificate_data, timing_choices, waits_data
from viaspline.report.space_time import SpaceTime, line_of
from viaspline.studio.page_numbers import finite, rounded
from viaspline.studio.plan_document import PlannedDocument
from viaspline.studio.shows_world import ShowsWorld
from viaspline.world.moving_obstacles import MovingObstacles

ACROSS, UP = 120, 90  # places and instants that are looked at while somebody waits
DEEPEST_M: Final = 1e6  # inside of something, as far as a picture cares
MAX_TRACK_ROWS: Final = 20_000  # keyframes of recorded tracks that are sent with a plan


def tracks(planned: ShowsWorld) -> list[dict[str, Any]]:
    """The discs of recorded tracks: each as an item of a document, and where it comes from."""
    if planned.world is None or planned.unfolded is None:
        return []
    world, found, room = planned.world, list[dict[str, Any]](), MAX_TRACK_ROWS
    for key, obstacles in (("known", world.known), ("unseen", world.unseen)):
        for i, obstacle in enumerate(obstacles):
            if key not in planned.unfolded.places or obstacle.motion is None:
                continue
            place = planned.unfolded.original(("world", key, i))
            rows = len(obstacle.motion.keyframes or ())
            if "tracks" in planned.document["world"][key][place[2]] and rows <= room:
                room -= rows
                found.append({"list": key, "item": place[2], "as": _as_item(obstacle)})
    return found


def _as_item(obstacle: Obstacle) -> dict[str, Any]:
    data: dict[str, Any] = obstacle.model_dump(exclude_none=True, by_alias=True, mode="json")
    return data


def timing(planned: PlannedDocument) -> dict[str, Any] | None:
    """What is proven of what moves, what the robot waits for, and every path that was timed."""
    plan = planned.plan
    if plan is None or plan.timed is None:
        return None
    proof = moving_certificate_data(plan.timed.certificate)["moving"]
    return {
        "certificate": {**plain(proof), "clearance_m": finite(plan.timed.certificate.clearance)},
        "candidates": plain(timing_choices(plan)["among_moving"]["candidates"]),
        "waits": plain(waits_data(plan)["waits"]),
        "items": _items(planned, plan),
        "holds_until": plan.trajectory.end_time + plan.mission.route.hold_s,
    }


def _items(planned: PlannedDocument, plan: Plan) -> dict[str, str]:
    """What the page calls each known thing that moves, by its name."""
    assert planned.unfolded is not None
    known = enumerate(plan.mission.world.known)
    places = [i for i, obstacle in known if obstacle.motion is not None]
    items = [planned.unfolded.original(("world", "known", i))[2] for i in places]
    names = MovingObstacles.known(plan.mission).names
    return {name: f"known:{item}" for name, item in zip(names, items, strict=True)}


def space_time(planned: PlannedDocument, revision: int) -> dict[str, Any]:
    """When a plan's path is blocked where, by what, and how its law goes through that."""
    plan = planned.plan
    assert plan is not None
    assert plan.timed is not None
    shown = SpaceTime.of_plan(plan)
    moving = shown.moving
    blocked = [
        {"obstacle": moving.name(i), "rings": _blocked(SpaceTime(
            shown.path, moving.alone(i), shown.required, shown.begin, shown.end
        ))}
        for i in range(len(moving))
    ]  # fmt: skip
    return {
        "type": "space_time",
        "rev": revision,
        "begin": shown.begin,
        "end": shown.end,
        "blocked": [one for one in blocked if one["rings"]],
        "law": _flat(line_of(plan.trajectory)),
        "free": _flat(line_of(plan.timed.free)),
    }


def _blocked(shown: SpaceTime) -> list[list[float]]:
    """Where there is too little room: rings of distance [m] and time [s], one after the other."""
    distances, times, gaps = shown.gaps(ACROSS, UP)
    if not (gaps < 0.0).any():
        return []
    room = np.maximum(gaps, -DEEPEST_M).clip(max=DEEPEST_M)
    lines = contourpy.contour_generator(distances, times, room, fill_type="OuterOffset")
    found: list[list[float]] = []
    for points, offsets in zip(*lines.filled(-2.0 * DEEPEST_M, 0.0), strict=True):
        found += [_flat(ring) for ring in np.split(points, offsets[1:-1].astype(np.int64))]
    return found


def _flat(points: Floats) -> list[float]:
    return rounded(np.ravel(points), 3)
