import json
from pathlib import Path
from typing import Any

import pytest
import shapely

from viaspline.errors import MissionError, MissionWarning
from viaspline.maps.geojson import read_geojson

SQUARE = [[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]
INNER = [[3, 3, 1.5], [3, 6, 1.5], [6, 6, 1.5], [6, 3, 1.5], [3, 3, 1.5]]


def saved(tmp_path: Path, content: Any) -> Path:
    file = tmp_path / "a.geojson"
    file.write_text(content if isinstance(content, str) else json.dumps(content))
    return file


def polygon(*rings: Any) -> dict[str, Any]:
    return {"type": "Polygon", "coordinates": list(rings)}


def feature(geometry: Any, **properties: Any) -> dict[str, Any]:
    return {"type": "Feature", "geometry": geometry, "properties": properties}


def collection(*features: Any, **members: Any) -> dict[str, Any]:
    return {"type": "FeatureCollection", "features": list(features), **members}


def test_polygons_have_holes_and_names(tmp_path: Path) -> None:
    many = {"type": "MultiPolygon", "coordinates": [[SQUARE], [[[20, 0], [30, 0], [30, 5]]]]}
    nested = {"type": "GeometryCollection", "geometries": [polygon([[50, 0], [51, 0], [51, 1]])]}
    file = saved(
        tmp_path,
        collection(
            feature(polygon(SQUARE, INNER), Name="yard"), feature(many, name="sheds"),
            feature(nested), feature(None, Name="nothing"),
        ),
    )  # fmt: skip
    areas = read_geojson(file)
    assert [area.name for area in areas] == ["yard", "sheds", "sheds", None]
    assert shapely.Polygon(areas[0].outline, areas[0].holes).area == 72
    assert areas[0].outline == ((0, 0), (9, 0), (9, 9), (0, 9))
    assert [shapely.Polygon(area.outline).area for area in areas[1:]] == [81, 25, 0.5]


@pytest.mark.parametrize("root", [polygon(SQUARE), feature(polygon(SQUARE)), collection(feature(
    polygon(SQUARE)))])  # fmt: skip
def test_every_object_of_geojson_may_stand_at_the_top(tmp_path: Path, root: Any) -> None:
    assert len(read_geojson(saved(tmp_path, root))) == 1


def test_a_ring_that_crosses_itself_and_one_that_is_there_twice_are_put_right(
    tmp_path: Path,
) -> None:
    bow_tie = [[0, 0], [4, 4], [4, 0], [0, 4], [0, 0]]
    file = saved(tmp_path, collection(*map(feature, [polygon(bow_tie)] * 2)))
    areas = read_geojson(file)
    assert [shapely.Polygon(area.outline).area for area in areas] == [4, 4]


def test_a_polygon_without_area_is_named_and_left_out(tmp_path: Path) -> None:
    flat = [[0, 0], [5, 5], [9, 9], [0, 0]]
    file = saved(tmp_path, collection(feature(polygon(flat)), feature(polygon(SQUARE))))
    with pytest.warns(MissionWarning, match=r"features\[0\].geometry.coordinates: the polygon has"):
        assert len(read_geojson(file)) == 1


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        ("", ":1:1: is not JSON: Expecting value; give GeoJSON"),
        ('{"type": }', ":1:10: is not JSON: Expecting value"),
        ("[]", ":1:1: is not GeoJSON; it should be an object with a type"),
        ('{"type": "Point"}', ": found a Point, which isn't an area; give Polygon or MultiPolygon"),
        ({"type": "FeatureCollection"}, ": features: lacks its features; it should be a list"),
        (collection(), ": the file has no polygon"),
        (collection(3), ": features[0]: found an object without a type, which isn't an area"),
        (
            collection(feature({"type": "LineString", "coordinates": []})),
            ": features[0].geometry: found a LineString, which isn't an area;",
        ),
        (polygon(), ": coordinates: isn't a ring of corners; it should be [[x, y], [x, y]"),
        (polygon(SQUARE, 3), ": coordinates[1]: isn't a ring of corners"),
        (polygon([[0, 0], [1, 1]]), ": coordinates[0]: isn't a ring of corners"),
        (polygon([[0], [1, 1], [2, 2]]), ": coordinates[0]: isn't a ring of corners"),
        (polygon([[0, 0], [1e10, 1], [2, 2]]), ": coordinates[0]: a corner is too far away; it"),
        (polygon([[0, 0], [float("nan"), 1], [2, 2]]), ": coordinates[0]: a corner is too far"),
        (
            collection(crs={"properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}),
            ": crs: the file says that it has longitudes and latitudes; project it to metres",
        ),
        (
            polygon([[5.5231, 52.5384], [5.5269, 52.5385], [5.5231, 52.5484]]),
            ": all of it lies within 0.01 m: these are degrees, not metres; project it",
        ),
    ],
)
def test_what_is_no_area_in_metres_is_said_in_its_place(
    tmp_path: Path, content: Any, fault: str
) -> None:
    file = saved(tmp_path, content)
    with pytest.raises(MissionError) as caught:
        read_geojson(file)
    assert str(caught.value).startswith(f"{file}{fault}")


def test_something_small_far_from_everything_is_no_degrees(tmp_path: Path) -> None:
    file = saved(tmp_path, polygon([[500, 0], [500.05, 0], [500.05, 0.05], [500, 0.05]]))
    assert len(read_geojson(file)) == 1
