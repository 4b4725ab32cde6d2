import copy
import math
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.maps.grid import Grid

coordinates = st.floats(-1e4, 1e4)


@given(
    x=coordinates, y=coordinates, yaw=st.floats(-7, 7), side=st.floats(0.01, 10),
    u=st.floats(-50, 50), v=st.floats(-50, 50),
)  # fmt: skip
def test_to_cells_undoes_to_world(
    x: float, y: float, yaw: float, side: float, u: float, v: float
) -> None:
    grid = Grid(np.zeros((3, 4)), side, (x, y, yaw))
    assert np.allclose(grid.to_cells(grid.to_world([(u, v)])), [(u, v)], atol=1e-8)


def test_the_array_that_is_given_can_be_written_to_without_changing_the_grid() -> None:
    cells = np.zeros((2, 2), bool)
    grid = Grid(cells, 1.0, unknown=cells)
    cells[0, 0] = True
    assert not grid.blocked.any()
    assert grid.unknown is not None
    assert not grid.unknown.any()
    with pytest.raises(ValueError, match="read-only"):
        grid.blocked[0, 0] = True


def test_an_array_that_nobody_can_write_to_is_kept_as_it_is() -> None:
    cells = np.zeros((2, 2), bool)
    cells.flags.writeable = False
    assert Grid(cells, 1.0).blocked is cells
    assert Grid(cells.T[::-1], 1.0).blocked.flags.c_contiguous


def test_grids_are_equal_where_they_block_the_same_ground() -> None:
    cells = np.eye(3, dtype=bool)
    grid = Grid(cells, 0.5, (1, 2, 0), source="a.yaml", unknown=cells)
    assert grid == Grid(cells.astype(int), 0.5, (1.0, 2.0, -0.0))
    assert hash(grid) == hash(Grid(cells, 0.5, (1, 2, 0)))
    others = Grid(~cells, 0.5, (1, 2, 0)), Grid(cells, 0.6, (1, 2, 0)), Grid(cells, 0.5)
    assert grid not in others


@pytest.mark.parametrize("duplicate", [lambda g: pickle.loads(pickle.dumps(g)), copy.deepcopy])
def test_copies_are_equal_and_as_read_only(duplicate: object) -> None:
    grid = Grid(np.eye(3), 0.5, (1, 2, 0.3), source="a.yaml", unknown=np.eye(3))
    copied = duplicate(grid)  # type: ignore[operator]
    assert copied == grid
    assert (copied.source, copied.unknown is None) == ("a.yaml", False)
    assert not copied.blocked.flags.writeable
    assert not copied.unknown.flags.writeable


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"blocked": np.zeros(3)}, r"has shape \(height, width\), not \(3,\)"),
        ({"blocked": np.zeros((0, 3))}, "not"),
        ({"blocked": np.zeros((1, 32_001))}, "32001 x 1 cells is too large; at most 32000 aside"),
        ({"resolution": 0}, "resolution is 0; give a side above 0 m"),
        ({"resolution": math.inf}, "resolution is inf"),
        ({"origin": (1, 2)}, r"origin is x, y \[m\] and yaw \[rad\], not \(1, 2\)"),
        ({"origin": (1, 2, math.nan)}, "origin is x, y"),
        ({"unknown": np.eye(3)}, "unknown squares have to be blocked"),
        ({"unknown": np.zeros((2, 2))}, "unknown squares have to be blocked"),
    ],
)
def test_what_is_no_grid_is_refused(arguments: dict[str, object], words: str) -> None:
    sound = {"blocked": np.zeros((3, 3)), "resolution": 1.0}
    with pytest.raises(GeometryError, match=words):
        Grid(**{**sound, **arguments})  # type: ignore[arg-type]
