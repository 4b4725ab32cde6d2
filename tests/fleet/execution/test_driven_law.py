"""Where a robot was when, told by its law, beside what it drove, reckoned piece by piece."""

import math

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.fleet.courses import FleetCourses, FleetPath, courses_along
from viaspline.fleet.execution.driven_law import driven_laws
from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_certificate import certify_fleet
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


@given(stop=st.floats(0.5, 8.0), stands=st.floats(1.0, 20.0), ends=st.booleans())
@example(stop=4.3, stands=12.0, ends=False)
def test_a_robot_that_stands_between_nodes_is_proven_apart_where_it_is_and_not_on_its_chord(
    stop: float, stands: float, ends: bool
) -> None:
    """Found by strange_fleet_runs.py: 1.26737 m proven, 1.26715 m sampled (912610)."""
    bend = Path([[[0, 0], [3, 0], [6, 2], [8, 5]]], vias=[])
    line = Path([[[-4, -1.5], [0, -1.5], [4, -1.5], [8, -1.5]]], vias=[])
    courses = courses_along(
        ("a", "b"),
        [FleetPath(one, np.array([0.0, one.length]), reach=0.5) for one in (bend, line)],
    )
    left = 0.0 if ends else bend.length - stop
    on = [] if ends else [(0.5 * left, 0.8, 0.0), (0.5 * left, 0.0, 0.0)]
    rows, _ = driven([(0.4 * stop, 1.0, 0.0), (0.6 * stop, 0.0, stands), *on])
    other, _ = driven([(6.0, 1.2, 0.0), (6.0, 0.0, 0.0)])
    rows[-1, 0] = max(rows[-1, 0], other[-1, 0])
    lengths = np.array([stop + left, line.length])
    found, laws = driven_laws(courses, [rows, other], lengths, np.full(2, math.inf))
    proven = certify_fleet(found, laws, 0.0).separation
    run = FleetRun({}, {}, (), (), found, laws, 0.0, float(rows[-1, 0]))
    times = np.linspace(0.0, run.end_s, 4000)
    a, b = (
        np.asarray(path.at_distance(np.minimum(run.distance_at(name, times), path.length)))
        for name, path in (("a", bend), ("b", line))
    )
    apart = np.hypot(*(a - b).T) - 1.0
    assert proven <= apart.min() + 1e-9
    assert proven >= apart.min() - 0.05
