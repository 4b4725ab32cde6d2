from __future__ import annotations

import io
from typing import Any

import numpy as np
import pytest
from PIL import Image

import viaspline as vs
from viaspline.report import style
from viaspline.report.space.flight_picture import flight_picture
from viaspline.report.space.flown_clearance import flown_clearance

MISSION: dict[str, Any] = {
    "world": {
        "bounds": [-10, -30, 80, 30],
        "ground": {"flat_m": 0},
        "known": [{"circle": {"center": [25, 0], "radius": 4}, "height_m": [0, 20]}],
        "unseen": [
            {"name": "crane", "circle": {"center": [50, 4], "radius": 3}, "height_m": [0, 30]}
        ],
    },
    "robot": {
        "radius_m": 0.5, "clearance_m": 1, "max_speed_mps": 4, "sensor": {"range_m": 18},
    },
    "route": {"start": [0, 0, 4], "via": [[35, 10, 8]], "goal": [70, 0, 5]},
}  # fmt: skip


@pytest.fixture(scope="module")
def flight() -> vs.SpatialRun:
    return vs.fly(vs.Mission.model_validate(MISSION))


def test_the_free_space_over_time_is_never_less_than_what_is_proven(
    flight: vs.SpatialRun,
) -> None:
    free = flown_clearance(flight)
    assert free.shape == flight.times.shape
    assert flight.clearance - 1e-9 <= free.min() < flight.clearance + 0.1
    tower = np.hypot(*(flight.positions[:, :2] - (25, 0)).T) - 4.5
    crane = np.hypot(*(flight.positions[:, :2] - (50, 4)).T) - 3.5
    bounds = 29.5 - np.abs(flight.positions[:, 1])
    ground = flight.positions[:, 2] - 0.5
    expected = np.min([tower, crane, bounds, ground], axis=0)
    assert np.abs(free - expected).max() < 1e-6


def test_what_was_flown_and_what_was_planned_are_on_the_picture(flight: vs.SpatialRun) -> None:
    assert len(flight.replans) == 1
    picture = flight_picture(flight, "crane")
    dots = np.asarray(Image.open(io.BytesIO(picture)).convert("RGB")).astype(int)
    for colour in (style.OLD_PATH, style.PATH, style.UNSEEN, style.UNSEEN_FILL, style.TIGHTEST):
        wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
        assert (np.abs(dots - wanted).max(axis=2) < 12).sum() > 40, colour
    assert flight_picture(flight, "crane") == picture


def test_while_it_takes_off_and_lands_the_ground_does_not_count() -> None:
    route = {"start": [0, 0, 0], "takeoff": {"to_agl_m": 6}, "via": [[20, 0, 6]],
             "land": {"at": [40, 0]}}  # fmt: skip
    data = {"world": {"ground": {"flat_m": 0}}, "robot": MISSION["robot"], "route": route}
    flown = vs.fly(vs.Mission.model_validate(data))
    free = flown_clearance(flown)
    assert free.min() >= flown.clearance - 1e-9
    assert not np.isfinite(free[[0, -1]]).any() or free[[0, -1]].min() > 1.0
