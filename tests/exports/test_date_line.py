"""Paths across the meridian of 180°, as GeoJSON has them."""

from __future__ import annotations

import itertools
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.geometry import shape

import viaspline as vs
from viaspline.exports.date_line import sides_of_180
from viaspline.formats.local_frame import LocalFrame

LATITUDE = -17.0


def exported(folder: Path, longitude: float, via: list[list[float]], last: list[float]) -> Any:
    """The line of a mission that begins at a longitude [deg], through places [m]."""
    mission = vs.Mission.model_validate(
        {
            "world": {"known": [{"circle": {"center": [20, 1], "radius": 3}}]},
            "route": {"start": [0, 0], "via": [{"at": at} for at in via], "goal": last},
        }
    )
    file = folder / "path.geojson"
    vs.export(vs.plan(mission), file, origin=(LATITUDE, longitude))
    return json.loads(file.read_text())["features"][0]


def parts_of(line: Any) -> list[Any]:
    """Its coordinates, a list for each part."""
    at = line["geometry"]["coordinates"]
    return at if line["geometry"]["type"] == "MultiLineString" else [at]


@given(st.floats(0.0, 70.0), st.lists(st.integers(-6, 6), max_size=3, unique=True))
@settings(deadline=None, max_examples=15)
def test_no_part_leaves_its_side_and_all_are_one_line(
    tmp_path_factory: pytest.TempPathFactory, east: float, tens: list[int]
) -> None:
    frame = LocalFrame(LATITUDE, 180.0)
    longitude = float(frame.to_geodetic([-east, 0.0])[1])
    via = [[10.0 * ten, 15.0 + ten] for ten in tens]
    line = exported(tmp_path_factory.mktemp("line"), longitude, via, [70, 9])
    parts = parts_of(line)
    assert shape(line["geometry"]).is_valid
    for part in parts:
        assert len(part) > 1
        assert len({np.sign(at[0]) for at in part}) == 1
    for one, other in itertools.pairwise(parts):
        assert one[-1][0] == -other[0][0]
        assert abs(one[-1][0]) == 180.0
        assert one[-1][1:] == other[0][1:]
    own = LocalFrame(LATITUDE, longitude)
    places = [own.to_local(*np.array(part)[:, :2].T[::-1]) for part in parts]
    driven = sum(np.hypot(*np.diff(part, axis=0).T).sum() for part in places)
    values = line["properties"]
    whole = values["distance_m"] if len(parts) > 1 else [values["distance_m"]]
    assert driven == pytest.approx(whole[-1][-1], rel=0.02)
    for key in ("distance_m", "time_s", "speed_mps", "heading_rad"):
        its = values[key] if len(parts) > 1 else [values[key]]
        assert [len(one) for one in its] == [len(part) for part in parts]
    for at, along in zip(places, whole, strict=True):
        assert np.hypot(*np.diff(at, axis=0).T) == pytest.approx(np.diff(along), rel=0.1, abs=0.2)
    assert values["chord_error_m"] < 0.26


def test_a_path_across_180_degrees_is_in_two_parts(tmp_path: Path) -> None:
    line = exported(tmp_path, 179.9997, [], [70, 9])
    assert line["geometry"]["type"] == "MultiLineString"
    assert [np.sign(part[0][0]) for part in parts_of(line)] == [1, -1]


def test_a_path_on_one_side_stays_one_line(tmp_path: Path) -> None:
    line = exported(tmp_path, 179.9, [], [70, 9])
    assert line["geometry"]["type"] == "LineString"
    assert np.ndim(line["properties"]["time_s"]) == 1


@pytest.mark.parametrize(
    ("longitudes", "parts"),
    [
        ([179.0, -180.0, 179.0], [[179.0, 180.0, 179.0]]),
        ([180.0, -179.0], [[-180.0, -179.0]]),
        ([-179.0, 180.0, -180.0, 179.0], [[-179.0, -180.0, -180.0], [180.0, 179.0]]),
        ([180.0, -180.0], [[180.0, 180.0]]),
        ([1.0, -1.0], [[1.0, -1.0]]),
    ],
)
def test_corners_at_180_degrees_are_on_the_side_of_their_part(
    longitudes: list[float], parts: list[list[float]]
) -> None:
    assert [at.tolist() for _, at in sides_of_180(np.array(longitudes))] == parts
