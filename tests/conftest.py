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

import viaspline as vs
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


FENCES = [
    [(-5, -5), (105, -5), (105, 45), (55, 50), (50, 105), (-5, 105)],
    [(-5, -5), (60, 20), (105, -5), (90, 50), (105, 105), (-5, 105)],
]


def _random_shapes(rng: np.random.Generator, count: int, size: float) -> list[dict[str, Any]]:
    """Circles and star-shaped polygons, overlapping as they please."""
    made: list[dict[str, Any]] = []
    for _ in range(count):
        x, y, reach = *rng.uniform(0, size, 2), rng.uniform(0.01, 0.07) * size
        if rng.random() < 0.5:
            made.append({"circle": {"center": [x, y], "radius": reach}})
            continue
        corners = int(rng.integers(3, 9))
        angle = np.linspace(0, 2 * np.pi, corners, endpoint=False) + rng.uniform(0, 0.3, corners)
        arm = reach * rng.uniform(0.4, 1.5, corners)
        ring = np.column_stack((x + arm * np.cos(angle), y + arm * np.sin(angle)))
        made.append({"polygon": ring[:: rng.choice([1, -1])].tolist()})
    for i in rng.permutation(len(made))[: len(made) // 6]:
        made[i][str(rng.choice(["pass_on", "never_pass_on"]))] = str(rng.choice(["left", "right"]))
    return made


def _random_mission(seed: int, most: int = 30, *, sides: bool = True) -> vs.Mission | None:
    """A mission in a square of 100 m; None where the via points find no room."""
    rng = np.random.default_rng(seed)
    shapes = _random_shapes(rng, int(rng.integers(0, most + 1)), 100.0)
    if not sides:
        shapes = [{k: v for k, v in s.items() if "pass" not in k} for s in shapes]
    radius, clearance = rng.uniform(0, 1, 2) * (rng.random(2) < 0.9)
    bounds = [-5.0, -5.0, 105.0, 105.0]
    fences = FENCES[: seed % 3]
    known = [vs.Obstacle(**shape) for shape in shapes]
    world = vs.World(known, bounds=bounds, fences=fences)
    places = rng.uniform(0, 100, (60, 3 if rng.random() < 0.2 else 2))
    free = places[world.distance(places) >= radius + clearance]
    count = int(rng.integers(2, 7))
    if len(free) < count:
        return None
    stops = free[:count].tolist()
    closed = bool(rng.random() < 0.2)
    spans = count if closed else count - 1
    tension: Any = float(rng.choice([1.0, 0.5, 0.0, -1.0]))
    if rng.random() < 0.3:
        tension = rng.uniform(-1, 1, spans).tolist()
    route: dict[str, Any] = {"start": {"at": stops[0]}, "closed": closed}
    if closed:
        route["via"] = stops[1:]
    else:
        route |= {"via": stops[1:-1], "goal": {"at": stops[-1]}}
        for end in ("start", "goal"):
            if rng.random() < 0.3:
                route[end]["heading_deg"] = float(rng.uniform(-180, 180))
    return vs.Mission.model_validate(
        {
            "world": {"bounds": bounds, "known": shapes, "fences": fences},
            "robot": {"radius_m": radius, "clearance_m": clearance},
            "route": route,
            "spline": {
                "tension": tension,
                "knots": str(rng.choice(["uniform", "centripetal", "chordal"])),
                "tangents": str(rng.choice(["cardinal", "cardinal", "continuous"])),
            },
        }
    )


@pytest.fixture(scope="session")
def random_mission() -> Callable[..., vs.Mission | None]:
    """Makes a mission of a seed in a square of 100 m; None where its points find no room."""
    return _random_mission
