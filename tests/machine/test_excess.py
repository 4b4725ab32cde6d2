"""When a robot was farther beside its path than was kept, against each sample by itself."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.machine.excess import excesses
from viaspline.machine.tracking import Tracking


def errors(off: list[float], turned: list[float]) -> Tracking:
    count = len(off)
    along = np.arange(count, dtype=float)
    none = np.zeros(count)
    return Tracking(along, along, np.array(off), np.array(turned), none, np.ones(count, bool))


@given(
    st.lists(st.tuples(st.floats(-0.2, 0.2), st.floats(-1.0, 1.0)), min_size=1, max_size=40),
    st.floats(0.0, 0.15),
    st.sampled_from([0.0, 0.5]),
)
def test_every_sample_beyond_what_is_kept_is_in_one_of_them_and_no_other(
    samples: list[tuple[float, float]], kept: float, reach: float
) -> None:
    tracking = errors([off for off, _ in samples], [turned for _, turned in samples])
    found = excesses(tracking, kept, reach)
    for k, (off, turned) in enumerate(samples):
        gap = abs(off) + 2.0 * reach * np.sin(0.5 * abs(turned)) - kept
        if abs(gap) > 1e-8:
            assert sum(one.since <= k <= one.until for one in found) == (gap > 0.0)
    assert all(one.since <= one.worst_at <= one.until and one.off > one.kept for one in found)


def test_a_robot_that_stays_as_near_as_is_kept_has_none() -> None:
    assert excesses(errors([0.1, -0.1], [0.0, 0.0]), 0.1, 0.0) == ()
