"""Where a robot was when, told by its law, beside what it drove, reckoned piece by piece."""

import math

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.execution.driven_law import driven_laws
from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_courses import PackedCourses

Pieces = list[tuple[float, float, float]]
"""How far each piece of even acceleration goes [m], the speed at its end [m/s], and how long the
robot stands there if that is 0 [s]."""

PIECES = st.lists(
    st.tuples(
        st.sampled_from([3e-9, 5e-8, 1e-6, 0.01, 0.7]),
        st.sampled_from([0.0, 1e-5, 2e-4, 0.3, 1.0]),
        st.floats(0.0, 5.0),
    ),
    min_size=1,
    max_size=12,
)


def driven(pieces: Pieces) -> tuple[Floats, list[tuple[float, float, float, float]]]:
    """Rows as a drive has them, and of each piece when it begins, where, its speed and rise."""
    rows, ways = [[0.0, 0.0, 0.0]], []
    time, place, speed = 0.0, 0.0, 0.0
    for far, then, stands in [*pieces, (0.2, 0.0, 0.0)]:  # it comes to rest
        if speed == then == 0.0:
            continue  # it has come to rest
        lasts = 2.0 * far / (speed + then)
        ways.append((time, place, speed, 0.5 * (then - speed) / lasts))
        time, place, speed = time + lasts, place + far, then
        rows.append([time, place, speed**2])
        if speed == 0.0:
            ways.append((time, place, 0.0, 0.0))
            time += stands
            rows.append([time, place, 0.0])
    return np.array([*rows, [time, place, 0.0]]), [*ways, (time, place, 0.0, 0.0)]


@given(pieces=PIECES)
@example(pieces=[(0.5, 1.0, 0.0), (0.5, 0.0, 4.0), (5e-8, 2e-4, 0.0), (0.5, 0.9, 0.0)])
@example(pieces=[(0.5, 1.0, 0.0), (0.5, 2e-4, 0.0), (5e-8, 1e-5, 0.0), (3e-9, 0.3, 0.0)])
def test_a_law_tells_where_a_robot_was_however_near_to_each_other_it_changed(
    pieces: Pieces,
) -> None:
    rows, ways = driven(pieces)
    end = float(rows[-1, 1])
    nodes = np.append(np.arange(0.0, end, 0.3), end)
    places = np.column_stack((nodes, np.zeros_like(nodes)))
    packed = PackedCourses(
        np.array([0, len(nodes)]), nodes, places, np.zeros_like(nodes), np.ones(1)
    )
    courses, laws = driven_laws(
        FleetCourses(("r",), packed), [rows], np.array([end]), np.array([math.inf])
    )
    run = FleetRun({}, {}, (), (), courses, laws, 0.0, float(rows[-1, 0]))
    times = np.linspace(0.0, run.end_s + 1.0, 500)
    begins = np.array([way[0] for way in ways])
    for time, told in zip(times, run.distance_at("r", times), strict=True):
        begin, place, speed, rise = ways[int(np.searchsorted(begins, time, side="right")) - 1]
        late = time - begin
        assert abs(told - (place + (speed + rise * late) * late)) < 1e-9
