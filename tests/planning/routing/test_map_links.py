"""Gaps between the cells of a map."""

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.maps.grid import Grid
from viaspline.planning.routing import map_links
from viaspline.planning.routing.gap_links import GapLinks, links_among
from viaspline.planning.routing.map_links import MapPieces, rim_cells


def links_of(cells: np.ndarray, reach: float, **more: float) -> tuple[MapPieces, GapLinks]:
    pieces = MapPieces(Grid(cells, **{"resolution": 1.0, **more}), 0)
    return pieces, pieces.links(reach)


def test_only_cells_that_free_ones_touch_are_pieces() -> None:
    cells = np.zeros((6, 6), bool)
    cells[1:5, 1:5] = True
    assert len(rim_cells(cells)) == 12
    assert len(rim_cells(np.ones((3, 3), bool))) == 8


@settings(max_examples=30)
@given(st.integers(0, 10**6), st.floats(0.5, 5.0))
def test_links_are_gaps_between_cells_and_join_what_all_gaps_join(seed: int, reach: float) -> None:
    random = np.random.default_rng(seed)
    pieces, links = links_of(random.random((12, 9)) < 0.25, reach)
    shapes = pieces.pieces(np.arange(len(pieces.cells)))
    a, b = links.pairs.T
    gap = shapely.distance(shapes.cores[a], shapes.cores[b])
    assert links.widths == pytest.approx(gap)
    for k in (0, 2):
        feet = shapely.points(links.feet[:, k : k + 2])
        assert np.all(shapely.distance(feet, shapes.cores[links.pairs[:, k // 2]]) == 0.0)
    everything = links_among(shapes, reach)
    for width in np.unique(everything.widths):
        joined = [components(which, width, len(pieces.cells)) for which in (links, everything)]
        assert joined[0] == joined[1]


def components(links: GapLinks, width: float, count: int) -> list[int]:
    """The lowest number that each piece is joined with by gaps of no more than a width."""
    lowest = list(range(count))
    pairs = links.pairs[links.widths <= width + 1e-12].tolist()
    while True:
        before = list(lowest)
        for a, b in pairs:
            lowest[a] = lowest[b] = min(lowest[a], lowest[b])
        if lowest == before:
            return lowest


def test_a_map_that_is_looked_at_in_parts_has_the_same_links(monkeypatch) -> None:
    cells = np.random.default_rng(3).random((30, 40)) < 0.1
    whole = links_of(cells, 4.0)[1]
    monkeypatch.setattr(map_links, "NODES_ASIDE", 13)
    parts = links_of(cells, 4.0)[1]
    assert np.sort(whole.widths) == pytest.approx(np.sort(parts.widths))


def test_links_are_told_in_metres_where_a_map_is_turned() -> None:
    cells = np.zeros((1, 5), bool)
    cells[0, [0, 3]] = True
    links = links_of(cells, 9.0, resolution=0.5, origin=(1.0, 2.0, np.pi / 2))[1]
    assert links.widths == pytest.approx(1.0)
    assert links.feet[:, (0, 2)] == pytest.approx(0.75, abs=0.26)
    assert np.sort(links.feet[:, (1, 3)]) == pytest.approx(
        np.tile((2.5, 3.5), (len(links.feet), 1))
    )
