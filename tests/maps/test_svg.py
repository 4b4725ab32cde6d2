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


CURVES = {
    "a circle": ('<circle cx="3" cy="4" r="2"/>', np.pi * 4),
    "an ellipse": ('<ellipse cx="3" cy="4" rx="2" ry="0.5"/>', np.pi),
    "a rounded rectangle": ('<rect width="6" height="4" rx="1"/>', 24 - 4 + np.pi),
    "a rectangle": ('<rect x="1" y="2" width="6" height="4"/>', 24),
    "a polygon": ('<polygon points="0,0 4,0 4,3"/>', 6),
    "a polyline that a painter closes": ('<polyline points="0 0 4 0 4 3"/>', 6),
    "a half disc": ('<path d="M0 0A2 2 0 0 1 4 0z"/>', 2 * np.pi),
    "run-together flags": ('<path d="M0 0a2 2 0 014 0z"/>', 2 * np.pi),
    "the larger arc": ('<path d="M0 0A2 2 0 1 1 2 2z"/>', 3 * np.pi + 2),
    "an arc that is too small and grows": ('<path d="M0 0A1 1 0 0 1 4 0z"/>', 2 * np.pi),
    "an arc without a radius is a line": ('<path d="M0 0A0 1 0 0 1 4 0V2z"/>', 4),
    "a parabola": ('<path d="M0 0Q2 3 4 0z"/>', 2 / 3 * 6),
    "a smooth parabola": ('<path d="M0 0Q1 3 2 0T4 0V-9H0z"/>', 36),
    "a cubic": ('<path d="M0 0C0 2 4 2 4 0z"/>', 144 / 30),
    "a smooth cubic": ('<path d="M0 0C0 2 4 2 4 0S8-2 8 0z m 20 0h1v1z"/>', 10.1),
    "an annulus": (
        '<path fill-rule="evenodd" d="M0 2a2 2 0 1 0 0-4 2 2 0 1 0 0 4z '
        'M0 1A1 1 0 0 0 0-1 1 1 0 0 0 0 1z"/>', 3 * np.pi,
    ),
    "numbers with a point at their end": ('<path d="M0. 0.L4. 0.L4.,3.z"/>', 6),
}  # fmt: skip


@pytest.mark.parametrize("name", CURVES)
@pytest.mark.parametrize(
    ("transform", "factor"),
    [
        ("", 1), ("rotate(30)", 1), ("translate(5) scale(2, -3)", 6), ("skewX(50)", 1),
        ("matrix(2 1 -1 3 50 60)", 7), ("rotate(20 3 4) skewY(-30) scale(0.1)", 0.01),
    ],
)  # fmt: skip
def test_curves_and_shapes_have_the_area_that_geometry_says(
    tmp_path: Path, name: str, transform: str, factor: float
) -> None:
    body, area = CURVES[name]
    areas = read_svg(drawn(tmp_path, f'<g transform="{transform}">{body}</g>'))
    found = ground(areas)
    slack = found.length * min(5e-3, 1e-3 * max(np.ptp(np.reshape(found.bounds, (2, 2)), axis=0)))
    assert found.area == pytest.approx(area * factor, abs=slack)


@pytest.mark.parametrize("radius", [0.02, 1.0, 40.0, 3e3, 1e6])
def test_no_chord_is_farther_from_its_curve_than_is_said(tmp_path: Path, radius: float) -> None:
    error = max(min(5e-3, 2e-3 * radius), 2e-7 * radius)
    (round_area,) = read_svg(drawn(tmp_path, f'<circle r="{radius}"/>'))
    corners = np.array(round_area.outline)
    assert np.allclose(np.linalg.norm(corners, axis=1), radius)
    middles = (corners + np.roll(corners, 1, axis=0)) / 2
    assert radius - np.linalg.norm(middles, axis=1).min() <= error * 1.0001
    assert len(corners) < 20_000


def test_transforms_are_applied_from_the_inside_out(tmp_path: Path) -> None:
    body = (
        '<g transform="translate(10 20)"><g transform="rotate(90)"><g transform="scale(2 3)">'
        '<rect width="1" height="1" transform="translate(1)"/></g></g></g>'
    )
    # (1..2, 0..1), twice and three times as large, turned (x, y) -> (-y, x), moved
    assert ground(read_svg(drawn(tmp_path, body))).equals(shapely.box(7, -24, 10, -22))


def test_lengths_with_a_unit_are_what_css_makes_of_them_and_the_page_plays_no_part(
    tmp_path: Path,
) -> None:
    file = tmp_path / "a.svg"
    sizes = {"2in": 192, "2.54cm": 96, "25.4mm": 96, "72pt": 96, "6pc": 96, "5px": 5, "5": 5}
    for size, units in sizes.items():
        file.write_text(
            f'{HEAD[:-2]} width="210mm" viewBox="9 9 210 297">'
            f'<rect width="{size}" height="1"/></svg>'
        )
        x0, y0, x1, y1 = ground(read_svg(file, 0.5)).bounds
        assert (x0, y0, y1) == (0, -0.5, 0)
        assert x1 == pytest.approx(units / 2, rel=1e-6)


def test_what_is_used_again_is_drawn_again_where_it_is_moved_to(tmp_path: Path) -> None:
    file = drawn(
        tmp_path,
        '<defs><g id="pair"><rect id="one" width="1" height="1"/>'
        '<use href="#one" y="2"/></g></defs>'
        '<symbol id="sign"><rect width="2" height="2"/></symbol>'
        '<use href="#pair" x="10"/><use xmlns:x="http://www.w3.org/1999/xlink" x:href="#pair" '
        'transform="scale(2)" x="10"/><use href="#sign" x="-9"/>',
    )
    squares = [
        shapely.box(10, -1, 11, 0), shapely.box(10, -3, 11, -2), shapely.box(20, -2, 22, 0),
        shapely.box(20, -6, 22, -4), shapely.box(-9, -2, -7, 0),
    ]  # fmt: skip
    assert ground(read_svg(file)).equals(shapely.union_all(squares))


def test_style_sheets_say_what_is_filled(tmp_path: Path) -> None:
    file = drawn(
        tmp_path,
        "<style>/* a } */ .gone, #x {display: none} rect.hidden{visibility:hidden}"
        ".even{fill-rule:evenodd}</style>"
        '<rect class="gone" width="9" height="9"/><circle id="x" r="9"/>'
        '<rect class="a hidden" width="9" height="9"/>'
        '<g class="even"><path d="M0 0H9V9H0Z M3 3H6V6H3Z"/></g>',
    )
    assert ground(read_svg(file)).area == 72


def test_a_drawing_that_would_grow_without_end_is_refused(tmp_path: Path) -> None:
    twice = [f'<use href="#g{i}"/>' * 10 for i in range(11)]
    doubled = "".join(f'<g id="g{i}">{uses}</g>' for i, uses in enumerate(twice, 1))
    bomb = drawn(tmp_path, f'<defs><g id="g0"/>{doubled}</defs><use href="#g11"/>')
    with pytest.raises(MissionError, match="has more than 100000 elements; draw what is to be"):
        read_svg(bomb)
    deep = drawn(tmp_path, "<g>" * 2000 + "</g>" * 2000)
    with pytest.raises(MissionError, match=":2:298: more than 100 elements lie inside each other"):
        read_svg(deep)
    chain = "".join(f'<g id="g{i}"><use href="#g{i - 1}"/></g>' for i in range(1, 300))
    with pytest.raises(MissionError, match="more than 100 elements lie inside each other; make it"):
        read_svg(drawn(tmp_path, f'<defs><g id="g0"/>{chain}</defs><use href="#g299"/>'))


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
        ('<path id="p1" d="m 0,0 c 1,1 2,2 3 z"/>', ":2:1: p1: the path lacks a number after 'c';"),
        ('<path d="m 0,0 A 1 1"/>', ":2:1: the path lacks a number after 'A'; correct its d"),
        ('<path d="m 0,0 A 1 1 0 2 1 5 5"/>', ":2:1: the path lacks a number after 'A'; correct"),
        ('<path d="m 0,0 1 z"/>', ":2:1: the path lacks a number after 'l'; correct its d"),
        ('<path d="m 0,0 h v 1"/>', ":2:1: the path lacks a number after 'h'"),
        ('<path d="l 0,0 1,1 0,1"/>', ":2:1: the path begins with 'l', not with a move"),
        ('<path d="1,1"/>', ":2:1: the path has the number 1 where a command should be"),
        ('<path d="m 0,0 1,1 z 3"/>', ":2:1: the path has the number 3 where a command should"),
        ('<path d="m 0,0 1,1 x"/>', ":2:1: the path has the unknown command 'x'"),
        ('<path d="m 0,0 1,1 ?"/>', ":2:1: the path has the character '?'"),
        ('<path d="M 0,0 2e9,1 1,2"/>', ":2:1: the path has a coordinate that is too far away; it"),
        ('<path fill="none" d="m 0,0 1,0 1,1"/>', ":2:1: the path isn't filled; fill it, or leav"),
        ('<g>\n <line id="r"/></g>', ":3:2: r: <line> isn't understood; make it a path (in Inks"),
        ('<g transform="scale(2 3 4)"/>', ":2:1: the transform scale(2 3 4) isn't understood; giv"),
        ('<g transform="translate(5%)"/>', ":2:1: the transform translate(5%) isn't understood; g"),
        ('<g style="transform: rotateX(9deg)"/>', ":2:1: the transform rotateX(9deg) isn't under"),
        ('<rect width="5%"/>', ":2:1: the width '5%' isn't understood; it should be a number of "),
        ('<rect width="abc"/>', ":2:1: the width 'abc' isn't understood; it should be a number"),
        ('<circle r="-1"/>', ":2:1: the r '-1' isn't understood; it should be a number of at leas"),
        ('<circle cx="3em"/>', ":2:1: the cx '3em' isn't understood; it should be a number, with "),
        ('<polygon points="1,2 3"/>', ":2:1: the polygon has points that aren't pairs of numbers"),
        ('<ellipse fill="none"/>', ":2:1: the ellipse isn't filled; fill it, or leave it out"),
        ('<circle r="2e9"/>', ":2:1: the circle has a coordinate that is too far away; it should"),
        ('<circle r="1e999"/>', ":2:1: there is a coordinate that is too far away; it should be "),
        ('<path d="M0 0C1 2e9 2 0 3 0"/>', ":2:1: the path has a coordinate that is too far away"),
        ('<use href="#no"/>', ":2:1: <use> refers to '#no', which isn't in the drawing; make it a"),
        ('<use href="a.svg#b"/>', ":2:1: <use> refers to 'a.svg#b', which isn't in the drawing"),
        ('<g id="a"><use href="#a"/></g>', ":2:11: <use> refers to '#a', which it is a part of;"),
        (
            '<defs><symbol id="s" viewBox="0 0 1 1"/></defs><use href="#s"/>',
            ":2:48: <use> refers to '#s', which has a viewBox; make it a path",
        ),
        ('<svg viewBox="0 0 1 1"/>', ":2:1: a drawing lies inside of the drawing; ungroup it"),
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
    file = drawn(tmp_path, '<image/>\n<path d="m 0,0 q 1,1"/>\n<text/>')
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
