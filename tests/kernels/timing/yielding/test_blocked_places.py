"""Places of a path that something which moves blocks, by shapely's distances."""

import numpy as np
import shapely
from hypothesis import example, given
from hypothesis import strategies as st
from shapely import affinity

from viaspline.curve.cardinal import CardinalSpline
from viaspline.kernels.arrays import Floats
from viaspline.kernels.timing.yielding.blocked_places import Driving, PlaceGrid, block_places
from viaspline.kernels.timing.yielding.path_tree import path_tree
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.pack_motion import pack_motion

PITCH, STEP, COUNT = 0.05, 0.2, 33
PLACE = st.tuples(*[st.floats(-8.0, 8.0)] * 2)
CAPSULE = st.tuples(PLACE, PLACE).filter(lambda ends: np.hypot(*np.subtract(*ends)) > 0.1)


def _blocked(
    ends: tuple[tuple[float, float], ...], radius: float, velocity: tuple[float, float],
    path: CardinalSpline, required: float,
) -> tuple[np.ndarray, int]:  # fmt: skip
    """Which places are blocked at which instants, (r, n), and how many looks that took."""
    shape = {"capsule": {"from": ends[0], "to": ends[1], "radius": radius}}
    motion = {"from": [0, 0], "velocity_mps": velocity}
    packed = pack_motion([Obstacle.model_validate(shape | {"motion": motion})], [0.0])
    _, along, points = path.sample(0.3)
    tree = path_tree(along, points)
    rows = np.zeros((COUNT, int(path.length / PITCH) // 64 + 1), np.uint64)
    grid = PlaceGrid(0.0, STEP, 0.0, PITCH, 0.0, np.zeros(COUNT, np.int64))
    driving = Driving(required, 0.0, 0.0, 0.0, 0.0)
    seen = block_places(packed, driving, tree, -1.0, path.length + 1.0, grid, rows)
    bits = np.unpackbits(rows.view(np.uint8), axis=1, bitorder="little")
    return bits[:, : int(path.length / PITCH)].astype(bool), seen


def _gaps(
    ends: tuple[tuple[float, float], ...], radius: float, velocity: tuple[float, float],
    places: Floats,
) -> Floats:  # fmt: skip
    """How far from the capsule each place is at each instant [m], (r, n)."""
    line, points = shapely.LineString(ends), shapely.points(places)
    moved = [affinity.translate(line, *(np.array(velocity) * STEP * k)) for k in range(COUNT)]
    return np.array([shapely.distance(one, points) for one in moved]) - radius


@example(((3.0, -9.0), (3.0, 9.0)), 0.5, (-0.5, 0.0), [(0, 0), (6, 1), (9, -6)])
@given(
    CAPSULE, st.floats(0.05, 2.0), st.tuples(*[st.floats(-2.0, 2.0)] * 2),
    st.lists(st.tuples(*[st.integers(-9, 9)] * 2), min_size=3, max_size=5, unique=True),
)  # fmt: skip
def test_just_the_places_are_blocked_that_are_too_near(
    ends: tuple[tuple[float, float], ...],
    radius: float,
    velocity: tuple[float, float],
    vias: list[tuple[int, int]],
) -> None:
    path, required = CardinalSpline(vias), 0.4
    blocked, _ = _blocked(ends, radius, velocity, path, required)
    places = path.at_distance(PITCH * np.arange(blocked.shape[1]))
    gaps = _gaps(ends, radius, velocity, places)
    _, along, points = path.sample(0.3)
    misses = float(path_tree(along, points).misses.max())
    assert blocked[gaps < required - 1e-6].all()
    assert not blocked[gaps > required + 2.0 * misses + PITCH].any()


def test_something_long_in_the_way_takes_few_looks_an_instant() -> None:
    path = CardinalSpline([(0, 0), (100, 3), (200, 0)])
    ends = ((100.0, -30.0), (100.0, 30.0))
    blocked, seen = _blocked(ends, 0.5, (0.1, 0.0), path, 0.8)
    assert blocked.any(axis=1).all()
    assert seen < 100 * COUNT
