"""A flight in simulation as the page plays it.

Tested through ``studio/space/test_spatial_server``.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Final

import numpy as np

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.moving_solids import POINT, gaps_to
from viaspline.space.spatial_run import SpatialReplan, SpatialRun
from viaspline.studio.page_numbers import finite, flat, rounded
from viaspline.world.space.spatial_world import SpatialWorld

MAX_FLIGHT_SAMPLES: Final = 6000


def flown(run: SpatialRun) -> dict[str, Any]:
    """What the page is told of a flight."""
    last = len(run.times) - 1
    some = np.unique(np.linspace(0, last, min(last + 1, MAX_FLIGHT_SAMPLES)).round().astype(int))
    steps = np.linalg.norm(np.diff(run.positions, axis=0), axis=1)
    return {
        "type": "driven",
        "reached": run.reached,
        "reason": run.reason,
        "duration": run.duration,
        "distance": float(steps.sum()),
        "clearance": finite(run.least_clearance),
        "touched": "" if run.encounters is None else run.encounters.touched,
        "samples": {
            "time": rounded(run.times[some], 3),
            "x": rounded(run.positions[some, 0], 4),
            "y": rounded(run.positions[some, 1], 4),
            "z": rounded(run.positions[some, 2], 4),
            "heading": rounded(np.unwrap(run.headings)[some], 4),
            "speed": rounded(run.speeds[some], 4),
            "climb": rounded(run.climbs[some], 4),
        },
        "events": sorted(_events(run), key=lambda event: float(event["time"])),
        "replans": [
            {
                "time": one.time,
                "at": _place(run, one.time)[:2],
                "obstacles": one.obstacles,
                "spans": flat(one.path.spans),
            }
            for one in run.replans
            if one.path is not None
        ],
        "sight": _sight(run),
    }


def _place(run: SpatialRun, time: float) -> list[float]:
    k = min(int(np.searchsorted(run.times, time)), len(run.times) - 1)
    return rounded(run.positions[k], 3)


def _event(run: SpatialRun, kind: str, time: float, message: str, **data: Any) -> dict[str, Any]:
    at = _place(run, time)[:2]
    return {"kind": kind, "time": float(time), "at": at, "message": message, "data": data}


def _events(run: SpatialRun) -> Iterator[dict[str, Any]]:
    yield _event(run, "started", float(run.times[0]), "started")
    first = run.replans[0].time if run.replans else float("inf")
    path, law = run.plan.path, run.plan.trajectory
    for via, distance in zip(path.vias, path.via_distances.tolist(), strict=True):
        time = float(law.time_at(distance))
        if via.kind != "user" or via.index is None or via.index == 0 or time > first:
            continue  # after a re-plan they are passed at other times
        if via.dwell > 0.0:
            message = f"hovers at '{via.name}' for {via.dwell:g} s"
            yield _event(run, "arrived", time, message, dwell_s=via.dwell)
        else:
            yield _event(run, "via", time, f"passed '{via.name}'")
    for one in run.replans:
        yield from _replanned(run, one)
    for touch in () if run.encounters is None else run.encounters.contacts:
        yield _event(run, "contact", touch.time, touch.words, name=touch.obstacle)
    end = float(run.times[-1])
    if run.reached:
        yield _event(run, "reached", end, "reached the goal")
    else:
        yield _event(run, "stopped", end, f"stopped: {run.reason}")


def _replanned(run: SpatialRun, one: SpatialReplan) -> Iterator[dict[str, Any]]:
    names = " and ".join(one.obstacles)
    yield _event(run, "detected", one.seen_at, f"saw {names}")
    if one.path is not None:
        how = "stopped, and took" if one.stopped else "took"
        yield _event(run, "replanned", one.time, f"{how} another path past {names}")


def _sight(run: SpatialRun) -> dict[str, Any] | None:
    """How far the sensor reaches, and when each unseen thing is first within that."""
    mission = run.plan.mission
    sensor = mission.robot.sensor
    if sensor is None:
        return None
    return {
        "kind": "range",
        "reach": sensor.reach,
        "seen": [_first_seen(run, one, sensor.reach) for one in mission.world.unseen],
    }


def _first_seen(run: SpatialRun, one: Obstacle, reach: float) -> float | None:
    if one.motion is not None:
        begin, end = float(run.times[0]), float(run.times[-1])
        solid = MovingSolid.of(one, one.name or "unseen", begin, end)
        away = gaps_to(solid, POINT, run.positions, run.times)
    else:
        radius, half = run.plan.world.packed.core.tolist()
        world = SpatialWorld.of([one.solid()], core_radius=radius, core_half_height=half)
        away = np.asarray(world.distance(run.positions))
    near = np.flatnonzero(away <= reach)
    return float(run.times[near[0]]) if near.size else None
