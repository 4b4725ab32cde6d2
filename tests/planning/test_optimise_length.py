"""``optimise: length`` keeps the length near to that of the shortest path there is."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import dijkstra

import viaspline as vs

REQUIRED, REACH = 2.0, 1.0005
CHORDS = 32  # of a quarter of a circle: what is inflated is a little too small


def _world(seed: int) -> list[tuple[float, float, float]]:
    """Discs, none near another or the ends of the route: x, y, radius [m]."""
    random, found = np.random.default_rng(seed), [(60.0, 0.7, 9.0)]
    while len(found) < 5:
        x, y, radius = random.uniform((15, -35, 4), (105, 35, 12))
        if min(x, 120 - x) - radius < 4 and abs(y) - radius < 4:
            continue
        if all(np.hypot(x - a, y - b) > radius + c + 6 for a, b, c in found):
            found.append((float(x), float(y), float(radius)))
    return found


def _shortest(discs: list[tuple[float, float, float]]) -> float:
    """The shortest path among inflated discs as polygons, by what sees what [m]."""
    grown = [shapely.Point(x, y).buffer(r + REQUIRED, CHORDS) for x, y, r in discs]
    inner = shapely.union_all([one.buffer(-1e-6) for one in grown])
    rings = [shapely.get_coordinates(one.exterior)[:-1] for one in grown]
    places = np.vstack([[[0.0, 0.0], [120.0, 0.0]], *rings])
    a, b = np.triu_indices(len(places), 1)
    lines = shapely.linestrings(np.stack((places[a], places[b]), axis=1))
    shapely.prepare(inner)
    seen = ~shapely.intersects(inner, lines)
    lengths = np.hypot(*(places[a] - places[b]).T)[seen]
    graph = csr_matrix((lengths, (a[seen], b[seen])), shape=(len(places),) * 2)
    return float(dijkstra(graph, directed=False, indices=0)[1])


@pytest.mark.parametrize(
    "seed", [0, 1, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (2, 3))]
)
def test_the_length_is_within_a_two_thousandth_of_the_shortest(seed: int) -> None:
    discs = _world(seed)
    mission = vs.Mission.model_validate(
        {
            "world": {"known": [{"circle": {"center": [x, y], "radius": r}} for x, y, r in discs]},
            "robot": {"radius_m": 1.5, "clearance_m": 0.5},
            "route": {"start": [0, 0], "goal": [120, 0], "optimise": "length"},
        }
    )
    plan = vs.plan(mission)
    assert plan.ledger
    assert 0.9995 * _shortest(discs) <= plan.path.length <= REACH * _shortest(discs)


def _among_many(seed: int, required: float) -> float:
    """The length of a path across a square full of discs [m]."""
    width, count = 30.0, 2900
    random, low, high = np.random.default_rng(seed), np.array([1.0, 1.0]), np.array([29.0, 29.0])
    at, radii = random.uniform(0, width, (count, 2)), random.uniform(0.1, 0.33, count)
    room = np.minimum(np.hypot(*(at - low).T), np.hypot(*(at - high).T)) - radii
    discs = [
        {"circle": {"center": middle.tolist(), "radius": float(radius)}}
        for middle, radius in zip(at[room > 0.128], radii[room > 0.128], strict=True)
    ]
    mission = vs.Mission.model_validate(
        {
            "world": {"known": discs, "bounds": [0, 0, width, width]},
            "robot": {"radius_m": required, "clearance_m": 0},
            "route": {"start": low.tolist(), "goal": high.tolist(), "optimise": "length"},
        }
    )
    return vs.plan(mission).path.length


@pytest.mark.parametrize("seed", [8, 24])
def test_among_thousands_of_discs_a_slimmer_robot_has_no_longer_way(seed: int) -> None:
    """On cells much larger than itself it took ways that were up to a fifth longer."""
    lengths = [_among_many(seed, required) for required in (0.0256, 0.0512, 0.064)]
    assert lengths[0] <= lengths[1] * (1.0 + 1e-4)
    assert lengths[1] <= lengths[2] * (1.0 + 1e-4)


@pytest.mark.parametrize("heading", [None, 40.0])
@pytest.mark.parametrize("disc", [(25.0, -4.0, 2.0), (60.0, 18.0, 3.0)])
def test_no_path_by_time_is_shorter_and_none_is_sharper_than_the_robot(
    heading: float | None, disc: tuple[float, float, float]
) -> None:
    """The first disc is beside the way, the second on it; either way the via point is a corner."""
    plans = {}
    for optimise in ("length", "time"):
        plans[optimise] = vs.plan(vs.Mission.model_validate({
            "world": {"known": [{"circle": {"center": disc[:2], "radius": disc[2]}}]},
            "robot": {"radius_m": 0.6, "clearance_m": 0.4, "max_speed_mps": 2.0},
            "route": {
                "start": {"at": [0, 0], "heading_deg": heading},
                "via": [[50, 20]],
                "goal": [100, 0],
                "optimise": optimise,
            },
        }))  # fmt: skip
    length = plans["length"].path.length
    assert length <= plans["time"].path.length
    assert length >= 2.0 * np.hypot(50, 20)
    assert plans["length"].drivability.sharpest_radius >= 0.6
    assert not plans["length"].drivability.reasons
