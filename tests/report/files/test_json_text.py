from __future__ import annotations

import json
import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.report.files.json_text import dumps, plain

SCALARS = st.none() | st.booleans() | st.integers() | st.floats() | st.text()
VALUES = st.recursive(
    SCALARS, lambda v: st.lists(v, max_size=4) | st.dictionaries(st.text(), v, max_size=4)
)


def _without_infinite(value: object) -> object:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, list):
        return [_without_infinite(item) for item in value]
    if isinstance(value, dict):
        return {key: _without_infinite(item) for key, item in value.items()}
    return value


@given(VALUES)
def test_json_gives_back_what_went_in_and_null_for_what_is_not_finite(value: object) -> None:
    assert json.loads(dumps(value)) == _without_infinite(value)


def test_numpy_values_become_plain_ones() -> None:
    assert plain({"a": np.float64(1.5), "b": np.arange(2), "c": np.bool_(True)}) == {
        "a": 1.5,
        "b": [0, 1],
        "c": True,
    }


def test_minus_zero_is_written_as_zero() -> None:
    assert dumps([-0.0]) == "[0.0]\n"


def test_a_float_is_written_so_that_it_is_read_back_exactly() -> None:
    value = 0.1 + 0.2
    assert json.loads(dumps([value]))[0] == value
