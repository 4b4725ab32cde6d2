import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.routing.navmesh.dilate import grow_into


@settings(max_examples=60)
@given(
    st.integers(0, 100_000),
    st.floats(0.0, 4.0),
    st.integers(-3, 4),
    st.integers(-3, 4),
    st.integers(1, 3),
)
def test_a_cell_is_blocked_when_its_middle_is_nearer_than_the_reach_to_a_square(
    seed: int, reach: float, row0: int, column0: int, parts: int
) -> None:
    rng = np.random.default_rng(seed)
    blocked = (rng.random(rng.integers(1, 9, 2)) < 0.3).astype(np.uint8)
    cells = np.zeros((9, 10), np.uint8)
    grow_into(blocked, reach, row0, column0, parts, cells)
    for row, column in np.ndindex(cells.shape):
        x, y = column + 0.5 - column0, row + 0.5 - row0
        gaps = [
            np.hypot(max(c - x, x - c - parts, 0.0), max(r - y, y - r - parts, 0.0))
            for r, c in parts * np.argwhere(blocked)
        ]
        nearest = min(gaps, default=np.inf)
        if abs(nearest - reach) > 1e-9:
            assert bool(cells[row, column]) == (nearest < reach)
