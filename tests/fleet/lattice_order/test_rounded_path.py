import itertools

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.curve.path import Path
from viaspline.fleet.lattice_order.rounded_path import rounded_lines
from viaspline.world.world import World

STEPS = st.tuples(st.sampled_from([-3, -1, 0, 2]), st.sampled_from([-2, 0, 1, 3]))


def lines_through(steps):
    moves = np.array([step for step in steps if step != (0, 0)] or [(1, 0)], float)
    return np.vstack([[0.0, 0.0], np.cumsum(moves, axis=0)])


@given(st.lists(STEPS, min_size=1, max_size=7))
@settings(max_examples=60, deadline=None)
def test_rounded_lines_stay_near_their_corners_and_join_smoothly(steps):
    places = lines_through(steps)
    lines = rounded_lines(places, World(), kept=0.3, widest=2.0, farthest=0.25)
    path = Path(lines.spans, vias=[])
    assert path.evaluate(0.0) == pytest.approx(places[0])
    assert path.evaluate(float(len(lines.spans))) == pytest.approx(places[-1])
    middles = path.evaluate(lines.middles)
    assert np.hypot(*(middles - places).T).max() <= 0.25 + 1e-3
    sharp = shapely.LineString(places)
    drawn = path.evaluate(np.linspace(0.0, len(lines.spans), 400))
    assert shapely.distance(shapely.points(drawn), sharp).max() <= 0.26
    ways = np.diff(places, axis=0)
    turns = np.arctan2(
        ways[:-1, 0] * ways[1:, 1] - ways[:-1, 1] * ways[1:, 0], (ways[:-1] * ways[1:]).sum(axis=1)
    )
    tangents = [(span[1] - span[0], span[3] - span[2]) for span in lines.spans]
    bends = [
        abs(np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b))
        for (_, a), (b, _) in itertools.pairwise(tangents)
    ]
    assert sum(bend > 1e-6 for bend in bends) == (np.abs(turns) >= 2.8).sum()


def test_a_corner_without_room_beside_it_is_rounded_less():
    places = np.array([[0.0, 0.0], [5.0, 0.0], [5.0, 5.0]])
    world = World([vs.Obstacle(circle={"center": (4.0, 1.0), "radius": 0.5})])
    wide, tight = (
        Path(rounded_lines(places, one, 0.45, 3.0, 2.0).spans, []) for one in (World(), world)
    )
    assert wide.length < tight.length
    assert vs.certify(tight, world, 0.45).holds
    assert not vs.certify(wide, world, 0.45).holds
