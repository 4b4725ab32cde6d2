"""Places along a chain of segments, by summing up."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Chained = Callable[[Floats], tuple[Floats, Floats, Floats]]


@pytest.fixture(scope="session")
def chained() -> Chained:
    """Places and headings along segments of evenly changing curvature, in small steps."""

    def summed(segments: Floats, count: int = 2000) -> tuple[Floats, Floats, Floats]:
        at = np.concatenate([np.full(count, k) for k in range(len(segments))])
        w = np.tile((np.arange(count) + 0.5) / count, len(segments))
        first, last, length = segments[at].T
        step = length / count
        heading = np.cumsum((first + w * (last - first)) * step)
        middle = heading - 0.5 * (first + w * (last - first)) * step
        return np.cumsum(step * np.cos(middle)), np.cumsum(step * np.sin(middle)), heading

    return summed
