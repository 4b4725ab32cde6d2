from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import shapely

from viaspline.errors import MissionError, MissionWarning
from viaspline.maps.area import Area
from viaspline.maps.svg import read_svg

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" '
    'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape">\n'
)


def drawn(tmp_path: Path, body: str) -> Path:
    file = tmp_path / "a.svg"
    file.write_text(HEAD + body + "\n</svg>")
    return file


def ground(areas: tuple[Area, ...]) -> shapely.Geometry:
    return shapely.union_all([shapely.Polygon(area.outline, area.holes) for area in areas])


def test_y_grows_upwards_and_groups_shift(tmp_path: Path) -> None:
    file = drawn(
        tmp_path,
        '<g transform="translate(10, 20) translate(1)"><g transform="translate(-1 -5)">'
        '<path d="m 1,2 h 3 v 4 z"/></g></g>',
    )
    (area,) = read_svg(file)
    assert area == Area(((11, -17), (14, -17), (14, -21)))


def test_a_unit_of_the_drawing_is_a_metre_unless_said_otherwise(tmp_path: Path) -> None:
    file = drawn(tmp_path, '<path d="M0 0H1000V-2000z" inkscape:label="hall"/>')
    assert read_svg(file, 0.001) == (Area(((0, 0), (1, 0), (1, 2)), name="hall"),)


@pytest.mark.parametrize(
    "d",
    [
        "m 1,1 h 2 v 2 h -2 z", "M1 1H3V3H1Z", "M 1,1 3,1 3,3 1,3", "m1 1 2 0 0 2-2 0",
        "M1,1L3,1L3,3L1,3L1,1", "m 1e0 1.0 l +2,0 l 0 2e+0 l -.2e1,0",
    ],
)  # fmt: skip
def test_a_path_may_be_written_in_every_way(tmp_path: Path, d: str) -> None:
    assert ground(read_svg(drawn(tmp_path, f'<path d="{d}"/>'))).equals(shapely.box(1, -3, 3, -1))


@pytest.mark.parametrize(
    ("rule", "d", "area"),
    [
        ("nonzero", "M0 0H9V9H0Z M3 3H6V6H3Z", 81),  # both the same way round: no hole
        ("nonzero", "M0 0H9V9H0Z M3 3V6H6V3Z", 72),
        ("evenodd", "M0 0H9V9H0Z M3 3H6V6H3Z", 72),
        ("evenodd", "m0 0h9v9h-9z m3 3h3v3h-3z m1 1h1v1h-1z", 73),  # an island in the hole
        ("nonzero", "M0 0H4V4H0Z M2 2H6V6H2Z", 28),
        ("evenodd", "M0 0H4V4H0Z M2 2H6V6H2Z", 24),
        ("nonzero", "M0 0 4 4 4 0 0 4z", 8),  # a bow tie
        ("nonzero", "M0 0H4V4H0V0H4V4H0z", 16),  # twice round
        ("evenodd", "M0 0H4V4H0V0H4V4H0z", 0),
    ],
)
def test_paths_are_filled_as_svg_fills_them(tmp_path: Path, rule: str, d: str, area: float) -> None:
    file = drawn(tmp_path, f'<path style="fill:#123; fill-rule:{rule}" d="{d}"/>')
    if area == 0:
        with pytest.warns(MissionWarning, match="has no area"), pytest.raises(MissionError):
            read_svg(file)
        return
    areas = read_svg(file)
    assert all(shapely.Polygon(a.outline, a.holes).is_valid for a in areas)
    assert ground(areas).area == pytest.approx(area)


def test_what_is_not_drawn_and_what_belongs_to_others_is_left_out(tmp_path: Path) -> None:
    file = drawn(
        tmp_path,
        '<defs><path d="m 0,0 c 1,1"/><rect/></defs><title>A hall</title>'
        '<g style="display:none"><path d="m 5,5 h 1 v 1 z"/></g>'
        '<other:rect xmlns:other="http://example.com"/>'
        '<path d="m 0,0 h 1 v 1 z"/><path d="m 1,1 v -1 h -1 z"/>',
    )
    assert len(read_svg(file)) == 1  # the two paths are one triangle


@pytest.mark.parametrize(
    ("body", "fault"),
    [
        ('<path id="p1" d="m 0,0 c 1,1 2,2 3,3 z"/>', ":2:1: p1: the path has a curve (command 'c"),
        (
            '<path d="m 0,0 A 1 1"/>',
            ":2:1: the path has a curve (command 'A'); draw it with straig",
        ),
        ('<path d="m 0,0 1 z"/>', ":2:1: the path lacks a number after 'l'; correct its d"),
        ('<path d="m 0,0 h v 1"/>', ":2:1: the path lacks a number after 'h'"),
        ('<path d="l 0,0 1,1 0,1"/>', ":2:1: the path begins with 'l', not with a move"),
        ('<path d="1,1"/>', ":2:1: the path has the number 1 where a command should be"),
        ('<path d="m 0,0 1,1 z 3"/>', ":2:1: the path has the number 3 where a command should"),
        ('<path d="m 0,0 1,1 x"/>', ":2:1: the path has the unknown command 'x'"),
        ('<path d="m 0,0 1,1 ?"/>', ":2:1: the path has the character '?'"),
        ('<path d="M 0,0 2e9,1 1,2"/>', ":2:1: the path has a coordinate that is too far away; it"),
        ('<path fill="none" d="m 0,0 1,0 1,1"/>', ":2:1: the path isn't filled; fill it, or leav"),
        ('<g>\n <rect id="r"/></g>', ":3:2: r: <rect> isn't understood; make it a path (in Inks"),
        ('<g transform="scale(2)"/>', ":2:1: the transform scale(2) isn't understood; apply it in"),
        ('<g transform="translate(e)"/>', ":2:1: the transform translate(e) isn't understood"),
        ("", ": the drawing has no filled path; draw what is to be kept clear of"),
        ("<g>", ":3:3: is not XML: mismatched tag; give an SVG drawing"),
    ],
)
def test_what_is_not_understood_is_said_in_its_place(tmp_path: Path, body: str, fault: str) -> None:
    file = drawn(tmp_path, body)
    with pytest.raises(MissionError) as caught:
        read_svg(file)
    assert str(caught.value).startswith(f"{file}{fault}")


def test_all_faults_of_a_drawing_come_at_once(tmp_path: Path) -> None:
    file = drawn(tmp_path, '<circle/>\n<path d="m 0,0 q 1,1"/>\n<text/>')
    with pytest.raises(MissionError) as caught:
        read_svg(file)
    assert [fault.line for fault in caught.value.faults] == [2, 3, 4]


def test_other_xml_is_no_drawing(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text("<html/>")
    with pytest.raises(MissionError, match=r"a\.svg:1:1: the file is <html>; give an SVG drawing"):
        read_svg(tmp_path / "a.svg")
    (tmp_path / "a.svg").write_text("")
    with pytest.raises(MissionError, match="is not XML: no element found"):
        read_svg(tmp_path / "a.svg")


def test_a_path_without_area_is_named_and_left_out(tmp_path: Path) -> None:
    file = drawn(tmp_path, '<path id="wall" d="m 0,0 h 9"/><path d="m 0,0 h 1 v 1"/>')
    with pytest.warns(MissionWarning, match="the path wall has no area"):
        assert len(read_svg(file)) == 1


@pytest.mark.parametrize(("name", "count"), [("parking1", 13), ("warehouse", 88)])
def test_the_real_drawings_lie_on_their_pages_and_every_path_is_an_area(
    data: Path, name: str, count: int
) -> None:
    file = data / f"{name}.svg"
    areas = read_svg(file)
    polygons = [shapely.Polygon(area.outline, area.holes) for area in areas]
    root = ElementTree.parse(file).getroot()
    assert len(areas) == count == len(root.findall(".//{*}path"))
    assert all(polygon.is_valid for polygon in polygons)
    _, _, width, height = map(float, root.attrib["viewBox"].split())
    # The pages were fitted to what is drawn, its strokes and all.
    stroke = 0.11
    expected = (0, -height, width, 0)
    assert np.allclose(shapely.total_bounds(polygons), expected, atol=stroke)
