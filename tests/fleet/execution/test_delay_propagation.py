"""What one delay does to the others: exactly what reckoning the whole fleet anew says."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from straight_drives import CROSS, driven_on, timed_lines

from viaspline.errors import GeometryError
from viaspline.fleet.execution.delay_propagation import DelayPropagation
from viaspline.fleet.execution.fleet_orders import orders_of


@pytest.mark.slow
@given(
    seed=st.integers(0, 10_000), count=st.integers(1, 14), late=st.floats(0.0, 100.0),
    departs=st.lists(st.floats(0.0, 30.0), min_size=14, max_size=14),
)  # fmt: skip
@settings(max_examples=20, deadline=None)
def test_it_says_what_the_whole_fleet_reckoned_anew_says(
    seed: int, count: int, late: float, departs: list[float]
) -> None:
    orders = orders_of(driven_on(timed_lines(seed, count)))
    begin = np.array(departs[: len(orders.names)])
    found = DelayPropagation.of(orders, begin)
    for robot, name in enumerate(orders.names):
        later = begin.copy()
        later[robot] += late
        anew = orders.arrivals(later) - orders.arrivals(begin)
        delays = found.delays(name, late)
        assert [delays.get(one, 0.0) for one in orders.names] == pytest.approx(anew, abs=1e-6)


@pytest.mark.slow
@given(seed=st.integers(0, 10_000), late=st.floats(0.1, 100.0))
@settings(max_examples=25, deadline=None)
def test_a_delay_reaches_those_who_wait_and_never_grows(seed: int, late: float) -> None:
    orders = orders_of(driven_on(timed_lines(seed, 9)))
    delays = DelayPropagation.of(orders).delays("r0", late)
    assert delays["r0"] == pytest.approx(late)
    assert all(0.0 < one <= late + 1e-9 for one in delays.values())
    for name in delays.keys() - {"r0"}:  # it waits for somebody who is late
        robot = orders.names.index(name)
        bars = slice(orders.packed.first[robot], orders.packed.first[robot + 1])
        counts = orders.leaders[orders.packed.crossing[bars]] == orders.packed.other[bars]
        others = orders.packed.other[bars][counts].tolist()
        assert any(orders.names[other] in delays for other in others)


def test_who_crosses_nobody_delays_nobody() -> None:
    found = DelayPropagation.of(orders_of(driven_on([*CROSS, ((0.0, 30.0), (40.0, 30.0))])))
    assert found.delays("r2", 50.0) == {"r2": pytest.approx(50.0)}
    assert found.delays("r0", 50.0)["r1"] > 45.0
    assert found.delays("r0", 0.0) == {}


def test_what_is_no_robot_and_no_delay_is_an_error() -> None:
    found = DelayPropagation.of(orders_of(driven_on(CROSS)))
    with pytest.raises(GeometryError, match=r"no robot 'r9' in this fleet; it has r0, r1"):
        found.delays("r9", 1.0)
    with pytest.raises(GeometryError, match="seconds is -1"):
        found.delays("r0", -1.0)
