"""For all tests: a hypothesis profile, an independent oracle for distances, a mission to spoil."""

import copy
import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, settings
from numpy.typing import NDArray

from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle

# With the JIT off the kernels are a thousand times slower: fewer examples.
settings.register_profile(
    "viaspline",
    deadline=None,  # the first example may compile a kernel
    derandomize=True,  # the check says the same of the same code; benchmarks hunt at random
    max_examples=8 if os.environ.get("NUMBA_DISABLE_JIT") == "1" else 40,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)
settings.load_profile("viaspline")

Floats = NDArray[np.float64]
Oracle = Callable[..., Floats]


def _ring(ring: Sequence[Any]) -> shapely.Polygon:
    return shapely.Polygon(ring)


def _squares(grid: Grid) -> Any:
    """The union of a grid's blocked cells."""
    row, column = np.nonzero(grid.blocked)
    cells = shapely.union_all(shapely.box(column, row, column + 1, row + 1))
    return shapely.transform(cells, grid.to_world)


def _signed(shape: Any, points: Any) -> Floats:
    distance = shapely.distance(shape.boundary, points)
    return np.where(shapely.contains(shape, points), -distance, distance)


@pytest.fixture(scope="session")
def shapely_distance() -> Oracle:
    """Signed distance of points (n, 2) to obstacles, bounds and fences, by shapely."""

    def distance(
        xy: Any, obstacles: Sequence[Obstacle] = (), bounds: Any = None, fences: Any = ()
    ) -> Floats:
        points = shapely.points(np.asarray(xy, float))
        found = np.full(len(points), np.inf)
        for obstacle in obstacles:
            if obstacle.circle is not None:
                centre = shapely.Point(obstacle.circle.center)
                one = shapely.distance(centre, points) - obstacle.circle.radius
            elif obstacle.grid is not None:
                one = _signed(_squares(obstacle.grid), points)
                one[np.isnan(one)] = np.inf  # nothing is blocked
            else:
                one = _signed(shapely.Polygon(obstacle.polygon, obstacle.holes), points)
            found = np.minimum(found, one)
        frames = [_ring(fence) for fence in fences]
        if bounds is not None:
            frames.append(shapely.box(*bounds))
        for frame in frames:
            found = np.minimum(found, -_signed(frame, points))
        return found

    return distance


GOOD: dict[str, Any] = {
    "world": {
        "bounds": [0, 0, 500, 500],
        "fences": [[[1, 1], [499, 1], [499, 499], [1, 499]]],
        "known": [
            {"circle": {"center": [120, 200], "radius": 12}, "pass_on": "left"},
            {"name": "tank", "polygon": [[200, 300], [230, 300], [215, 340]]},
            {
                "polygon": [[400, 400], [450, 400], [450, 450], [400, 450]],
                "holes": [[[410, 410], [440, 410], [440, 440], [410, 440]]],
            },
        ],
        "unseen": [{"circle": {"center": [240, 180], "radius": 8}}],
    },
    "robot": {"radius_m": 0.5, "clearance_m": 0.5, "sensor": {"range_m": 40}},
    "route": {
        "start": {"at": [50, 250], "heading_deg": 45},
        "via": [[90, 330], {"at": [140, 170], "name": "pump", "dwell_s": 20}],
        "goal": [350, 250],
        "closed": False,
    },
    "spline": {"tension": [0.1, 0, -0.5], "knots": "chordal"},
}


@pytest.fixture(scope="session")
def good() -> Callable[[], dict[str, Any]]:
    """Makes the good mission, a new one each time."""
    return lambda: copy.deepcopy(GOOD)


@pytest.fixture(scope="session")
def spoiled() -> Callable[[str, Any], dict[str, Any]]:
    """Makes the good mission with another value at a dotted path; indices are numbers."""

    def spoil(path: str, value: Any) -> dict[str, Any]:
        data = copy.deepcopy(GOOD)
        *parents, last = [int(part) if part.isdigit() else part for part in path.split(".")]
        node: Any = data
        for part in parents:
            node = node[part]
        node[last] = value
        return data

    return spoil
