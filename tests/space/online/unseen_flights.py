"""Flights among balls that move and aren't on the map, and where these truly were."""

from __future__ import annotations

from typing import Any

import numpy as np

from viaspline.mission.model import Mission
from viaspline.space.spatial_run import SpatialRun

RADIUS, CLEARANCE = 0.5, 1.0


def mission(
    moving: list[dict[str, Any]], *, things: dict[str, Any] | None = None, reach: float = 20,
    noise: float = 0.0, known: list[dict[str, Any]] | None = None, **route: Any,
) -> Mission:  # fmt: skip
    """80 m straight on, in a height of 10 m."""
    sensor = {"range_m": reach, "velocity_noise_mps": noise}
    robot = {"radius_m": RADIUS, "clearance_m": CLEARANCE, "max_speed_mps": 5, "max_accel_mps2": 2,
             "max_climb_mps": 2, "sensor": sensor}  # fmt: skip
    return Mission.model_validate(
        {
            "world": {"ground": {"flat_m": 0}, "unseen": moving, "known": known or [],
                      "altitude": {"min_m": 2, "max_m": 60, "above": "home"}},
            "robot": robot | ({} if things is None else {"moving": things}),
            "route": {"start": [0, 0, 10], "goal": [80, 0, 10], **route},
        }
    )  # fmt: skip


def moves(name: str, radius: float, frames: list[list[float]], after: str = "stay"
          ) -> dict[str, Any]:  # fmt: skip
    """A ball on its way through frames of time, x, y, z."""
    rows = [[t, x, y, 0, z] for t, x, y, z in frames]
    return {"name": name, "ball": {"center": [0, 0, 0], "radius": radius},
            "motion": {"keyframes": rows, "after": after}}  # fmt: skip


def wanderer(rng: np.random.Generator, name: str, top: float, far: float = 80.0) -> dict[str, Any]:
    """A ball that goes from place to place on the way, never faster than it may [m/s]."""
    at, time = rng.uniform((10, -30, 4), (far + 10, 30, 16)), 0.0
    rows = [[0.0, *at]]
    for _ in range(int(rng.integers(2, 7))):
        to = rng.uniform((0, -6, 8), (far, 6, 12))
        time += max(float(np.linalg.norm(to - at)) / (rng.uniform(0.3, 0.999) * top), 0.5)
        at = to
        rows.append([time, *at])
    frames = np.array(rows).round(3)
    frames[:, 0] += 0.002 * np.arange(len(frames))  # so that rounding makes nothing faster
    return moves(name, float(rng.uniform(0.3, 1.5)), frames.tolist())


def gaps_and_speeds(run: SpatialRun, one: dict[str, Any], step: float = 0.002
                    ) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """Free space to a ball at fine instants, and how fast the robot was."""
    rows = np.array(one["motion"]["keyframes"])
    times = np.arange(run.times[0], run.times[-1], step)
    at = np.column_stack([np.interp(times, rows[:, 0], rows[:, k]) for k in (1, 2, 4)])
    here = np.column_stack([np.interp(times, run.times, run.positions[:, k]) for k in range(3)])
    gaps = np.linalg.norm(here - at, axis=1) - one["ball"]["radius"] - RADIUS
    return gaps, np.interp(times, run.times, run.speeds)
