from __future__ import annotations

import csv
import io
import json
from dataclasses import replace

import numpy as np
import pytest
import shapely
from PIL import Image

from viaspline.mission.model import Mission
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism, RoundedSegment
from viaspline.report.space.elevation_profile import silhouette
from viaspline.report.space.spatial_film import flight_frames
from viaspline.report.space.spatial_picture import band_of, drawn_page, scene_of
from viaspline.report.space.spatial_results import spatial_plan_contents, spatial_run_contents
from viaspline.report.space.spatial_scene import NamedSolid
from viaspline.report.space.spatial_tables import spatial_plan_tables
from viaspline.report.terminal.terminal_tables import console
from viaspline.space.online.fly import fly
from viaspline.space.plan_spatial import plan_spatial
from viaspline.space.spatial_plan import SpatialPlan


@pytest.fixture(scope="module")
def flown() -> SpatialPlan:
    return plan_spatial(
        Mission.model_validate(
            {
                "world": {
                    "bounds": [0, 0, 120, 100],
                    "altitude": {"min_m": 2, "max_m": 60, "above": "ground"},
                    "ground": {"flat_m": 0},
                    "known": [
                        {"name": "hall", "polygon": [[50, 30], [70, 30], [70, 50], [50, 50]],
                         "height_m": [0, 12]},
                        {"name": "balloon", "ball": {"center": [90, 80, 30], "radius": 4}},
                        {"name": "bridge", "box": {"min": [20, 60, 8], "max": [40, 64, 10]}},
                    ],
                },
                "robot": {"radius_m": 0.4, "half_height_m": 0.2, "clearance_m": 1,
                          "max_speed_mps": 6, "max_climb_mps": 2},
                "route": {
                    "start": [10, 10],
                    "takeoff": {"to_agl_m": 10},
                    "via": [{"at": [60, 40, 20]}, {"at": [100, 60, 25], "dwell_s": 3}],
                    "land": {"at": [15, 80]},
                },
            }
        )
    )  # fmt: skip


def test_a_plan_leaves_its_curve_its_proofs_and_a_picture(flown: SpatialPlan) -> None:
    contents = spatial_plan_contents(flown, "tower")
    assert contents == spatial_plan_contents(flown, "tower")
    told = json.loads(contents["plan.json"])
    assert np.array_equal(told["path"]["spans"], flown.path.spans)
    assert told["certificate"]["holds"]
    assert told["heights"]["holds"]
    assert told["heights"]["least_agl_m"] >= 2.0
    rows = list(csv.DictReader(io.StringIO(str(contents["path.csv"]))))
    assert float(rows[-1]["z_m"]) == pytest.approx(0.2, abs=1e-6)
    assert float(rows[-1]["time_s"]) == pytest.approx(flown.trajectory.duration, abs=1e-5)
    assert max(float(row["climb_mps"]) for row in rows) <= 2.0 + 1e-6
    picture = Image.open(io.BytesIO(contents["plan.png"]))  # type: ignore[arg-type]
    assert min(picture.size) > 600


def test_a_flight_is_written_and_filmed(flown: SpatialPlan) -> None:
    run = fly(flown)
    told = json.loads(spatial_run_contents(run, "tower")["run.json"])
    assert told["reached"]
    assert told["duration_s"] == pytest.approx(flown.trajectory.duration)
    first, last = flight_frames(run, "tower", 2)
    assert first.shape == last.shape
    assert (first != last).any()


def test_the_band_that_is_drawn_is_the_one_that_is_kept(flown: SpatialPlan) -> None:
    band = band_of(flown)
    assert band is not None
    assert np.allclose(band.low, 2.0)
    assert np.allclose(band.high, 60.0)
    assert [one.name for one in scene_of(flown).solids] == ["hall", "balloon", "bridge"]


def test_tables_tell_the_figures(flown: SpatialPlan) -> None:
    out = console()
    with out.capture() as said:
        out.print(spatial_plan_tables(flown, "tower"))
    words = said.get()
    assert "above ground, proven" in words
    assert "clearance, proven" in words


def test_what_stands_beside_a_path_is_told_from_what_stands_under_it() -> None:
    hall = NamedSolid(Prism(RoundedRing([[(0, 0), (10, 0), (10, 10), (0, 10)]]), 0.0, 8.0))
    places = np.array([[5.0, 5, 20], [15, 5, 20], [30, 5, 20]])
    seen = silhouette(hall, places, 0.5)
    assert seen.meets.tolist() == [True, False, False]
    assert np.isfinite(seen.low).tolist() == [True, True, False]
    cable = NamedSolid(RoundedSegment((0, 0, 10), (0, 100, 30), 0.1))
    beside = silhouette(cable, np.array([[3.0, 50, 5]]), 0.5)
    assert beside.low[0] == pytest.approx(19.9)
    assert beside.high[0] == pytest.approx(20.1)


def test_the_height_of_a_roof_is_written_on_it_beside_the_path(flown: SpatialPlan) -> None:
    sheet = drawn_page(flown, "tower")
    sheet.figure.draw_without_rendering()
    (text,) = [one for one in sheet.map.texts if one.get_text() == "12"]
    box = shapely.box(*text.get_window_extent().extents)
    to_pixels = sheet.map.transData.transform
    hall = shapely.Polygon(to_pixels([(50, 30), (70, 30), (70, 50), (50, 50)]))
    places = flown.path.at_distance(np.linspace(0.0, flown.path.length, 4000))
    assert hall.contains(box)
    assert not box.intersects(shapely.LineString(to_pixels(places[:, :2])))


def test_what_stands_on_high_ground_is_not_overhead(flown: SpatialPlan) -> None:
    ring = RoundedRing([[(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)]])
    hut, bridge = NamedSolid(Prism(ring, 100.0, 120.0)), NamedSolid(Prism(ring, 115.0, 120.0))
    scene = replace(scene_of(flown), flat=110.0)
    assert not scene.is_overhead(hut)
    assert scene.is_overhead(bridge)
    assert replace(scene, flat=None).is_overhead(hut)  # over zero, where no ground is known
