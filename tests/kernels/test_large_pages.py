from __future__ import annotations

import numpy as np
import pytest

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.growable import new_floats, new_ints, sized_floats
from viaspline.kernels.jit import kernel
from viaspline.kernels.large_pages import LEAST_BYTES


@kernel
def counted(count: int) -> tuple[Floats, Ints]:
    floats, ints = new_floats(count, 2), new_ints(count, 1)
    for i in range(count):
        floats[i, 0], floats[i, 1], ints[i, 0] = i, -i, 2 * i
    return sized_floats(floats, count, count + 7), ints


@pytest.mark.parametrize("count", [0, 1, LEAST_BYTES // 16 - 1, LEAST_BYTES // 16, 1_000_003])
def test_tables_of_any_size_hold_what_is_written_to_them(count: int) -> None:
    floats, ints = counted(count)
    assert floats.shape == (count + 7, 2)
    assert (floats[:count, 0] == np.arange(count)).all()
    assert (floats[:count, 1] == -np.arange(count)).all()
    assert (ints[:, 0] == 2 * np.arange(count)).all()
