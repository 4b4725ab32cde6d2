from typing import Any

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from viaspline.maps.area import Area, filled


def turned(ring: Any, point: Any) -> int:
    """How often a ring goes round a point: the sum of the angles, no corner being at the point."""
    away = np.vstack((ring, ring[:1])) - point
    angles = np.arctan2(away[:, 1], away[:, 0])
    steps = (np.diff(angles) + np.pi) % (2 * np.pi) - np.pi
    return round(steps.sum() / (2 * np.pi))


@settings(deadline=None)
@given(
    ring=arrays.arrays(float, st.tuples(st.integers(3, 9), st.just(2)), elements=st.integers(0, 9)),
    rule=st.sampled_from(["nonzero", "evenodd"]),
)
def test_what_a_ring_goes_round_is_filled_and_nothing_else(ring: Any, rule: Any) -> None:
    parts = filled([ring], rule)
    assert all(part.is_valid for part in parts)
    ground = shapely.union_all(parts)
    # Corners are whole, so that no edge runs through these.
    for point in np.random.default_rng(0).uniform(0, 9, (40, 2)):
        turns = turned(ring, point)
        inside = turns != 0 if rule == "nonzero" else turns % 2 == 1
        assert shapely.contains_xy(ground, *point) == inside


def test_areas_are_values() -> None:
    assert hash(Area(((0, 0), (1, 0), (1, 1)))) == hash(Area(((0, 0), (1, 0), (1, 1))))
