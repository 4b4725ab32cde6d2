"""For all tests: a hypothesis profile, an independent oracle for distances, a mission to spoil."""

import copy
import gc
import math
import os
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import HealthCheck, settings
from numpy.typing import NDArray

import viaspline as vs
from viaspline.errors import MissionWarning
from viaspline.kernels.loaded_kernels import LoadedKernel, loaded_kernels
from viaspline.maps.grid import Grid
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import GridPrism, Prism, RoundedSegment, Solid

# With the JIT off the kernels are a thousand times slower: fewer examples.
settings.register_profile(
    "viaspline",
    deadline=None,  # the first example may compile a kernel
    derandomize=True,  # the check says the same of the same code; benchmarks hunt at random
    max_examples=8 if os.environ.get("NUMBA_DISABLE_JIT") == "1" else 25,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
)
settings.load_profile("viaspline")

SHARE = 0.5
"""Of the examples of a property, where slow tests are left out."""


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Try fewer examples of each property than ``check.py --all`` does; those with a name, all."""
    if "not slow" not in config.option.markexpr:
        return
    tests = {id(test): test for item in items if (test := getattr(item, "obj", None))}
    for test in tests.values():
        own: settings | None = getattr(test, "_hypothesis_internal_use_settings", None)
        if own is not None:
            fewer = math.ceil(SHARE * own.max_examples)
            test._hypothesis_internal_use_settings = settings(own, max_examples=fewer)


LOADED_TO_COLLECT = pytest.StashKey[frozenset[LoadedKernel]]()


def pytest_collection_finish(session: pytest.Session) -> None:
    """Note what the tests have computed by then, where they are imported.

    What was made by then stays to the end: the garbage collector needn't look through it again.
    """
    session.config.stash[LOADED_TO_COLLECT] = loaded_kernels()
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="session")
def loaded_to_collect(pytestconfig: pytest.Config) -> frozenset[LoadedKernel]:
    """The kernels that were compiled, or loaded, before the first test ran."""
    return pytestconfig.stash[LOADED_TO_COLLECT]


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


def _combined(a: Floats, b: Floats) -> Floats:
    """Signed distance of a product from those of its parts."""
    return np.where((a > 0) & (b > 0), np.hypot(a, b), np.maximum(a, b))


def _boxes(places: Floats, low: Floats, high: Floats, core: tuple[float, float]) -> Floats:
    """Signed distance of an upright cylinder at places (n, 3) from the nearest of boxes (k, 3)."""
    found = np.full(len(places), np.inf)
    for k in range(0, len(low), 50):
        one, other = low[k : k + 50, None], high[k : k + 50, None]
        gap = np.maximum(one - places, places - other)
        plan = _combined(gap[..., 0], gap[..., 1]) - core[0]
        found = np.minimum(found, _combined(plan, gap[..., 2] - core[1]).min(axis=0))
    return found


def _from_line(places: Floats, line: RoundedSegment, core: tuple[float, float]) -> Floats:
    """Distance of an upright cylinder at places (n, 3) from a line, by thirds of a convex one."""
    first, last = np.array(line.first), np.array(line.last)

    def at(t: Floats) -> Floats:
        apart = first + t[:, None] * (last - first) - places
        level = np.maximum(np.hypot(apart[:, 0], apart[:, 1]) - core[0], 0.0)
        return np.hypot(level, np.maximum(np.abs(apart[:, 2]) - core[1], 0.0))

    low, high = np.zeros(len(places)), np.ones(len(places))
    for _ in range(90):
        one, other = low + (high - low) / 3, high - (high - low) / 3
        left = at(one) <= at(other)
        low, high = np.where(left, low, one), np.where(left, other, high)
    return np.minimum(at(0.5 * (low + high)), np.minimum(at(low * 0), at(low * 0 + 1)))


def _from_solid(places: Floats, solid: Solid, core: tuple[float, float]) -> Floats:
    if isinstance(solid, RoundedSegment):
        return _from_line(places, solid, core) - solid.radius
    if isinstance(solid, Voxels):
        low = np.argwhere(solid.blocked) * solid.cell + solid.origin
        return _boxes(places, low, low + solid.cell, core)
    points = shapely.points(places[:, :2])
    if isinstance(solid, GridPrism):
        plan = _signed(_squares(solid.grid), points)
    else:
        shape = solid.ring.core()
        plan = _signed(shape, points) if shape.area else shapely.distance(shape, points)
        plan = plan - solid.ring.radius
    gap = np.maximum(solid.low - places[:, 2], places[:, 2] - solid.high)
    return _combined(plan - core[0], gap - core[1])


def _from_ground(places: Floats, ground: Any, core: tuple[float, float], free: bool) -> Floats:
    if not isinstance(ground, Terrain):
        return places[:, 2] - ground - core[1]
    nodes, cell = ground.heights, ground.cell
    top = np.max([nodes[:-1, :-1], nodes[:-1, 1:], nodes[1:, :-1], nodes[1:, 1:]], axis=0)
    top = np.where(np.isnan(top), -np.inf if free else np.inf, top)
    rows, columns = np.indices(top.shape).reshape(2, -1)
    corner = np.array(ground.origin) + cell * np.column_stack((columns, rows))
    low = np.column_stack((corner, np.full(len(corner), -np.inf)))
    high = np.column_stack((corner + cell, top.ravel()))
    found = _boxes(places, low[np.isfinite(high[:, 2]) | (high[:, 2] > 0)],
                   high[np.isfinite(high[:, 2]) | (high[:, 2] > 0)], core)  # fmt: skip
    if free:
        return found
    points = shapely.points(places[:, :2])
    return np.minimum(found, -_signed(shapely.box(*ground.extent), points) - core[0])


@pytest.fixture(scope="session")
def space_oracle() -> Oracle:
    """Signed distance of an upright cylinder at places (n, 3) from solids, ground and bounds."""

    def distance(
        places: Any,
        solids: Sequence[Solid] = (),
        ground: Any = None,
        bounds: Any = None,
        core: tuple[float, float] = (0.0, 0.0),
        nodata: str = "blocked",
    ) -> Floats:
        at = np.asarray(places, float)
        found = np.full(len(at), np.inf)
        for solid in solids:
            found = np.minimum(found, _from_solid(at, solid, core))
        if ground is not None:
            found = np.minimum(found, _from_ground(at, ground, core, nodata == "free"))
        if bounds is not None:
            points = shapely.points(at[:, :2])
            found = np.minimum(found, -_signed(shapely.box(*bounds), points) - core[0])
        return found

    return distance


def _random_solid(rng: np.random.Generator) -> Solid:
    """A solid of any kind within 40 m, degenerate ones among them."""
    x, y, z = rng.uniform(0, 40, 3)
    low = float(rng.choice([-np.inf, 0.0, z]))
    high = float(rng.choice([np.inf, z + 8.0, max(low, z)]))
    kind = rng.integers(6)
    if kind == 0:
        return Prism(RoundedRing([[(x, y)]], rng.uniform(0, 5)), low, high)
    if kind == 1:
        other = (x, y) if rng.random() < 0.2 else tuple(rng.uniform(0, 40, 2).tolist())
        return Prism(RoundedRing([[(x, y), other]], rng.uniform(0.1, 2)), low, high)
    if kind == 2:
        corners = int(rng.integers(3, 40))
        angle = np.linspace(0, 2 * np.pi, corners, endpoint=False) + rng.uniform(0, 0.1, corners)
        arm = rng.uniform(2, 9, corners)
        loops = [[(x + r * np.cos(a), y + r * np.sin(a)) for a, r in zip(angle, arm, strict=True)]]
        if corners > 5:
            loops.append([(x + 0.5, y), (x - 0.3, y + 0.4), (x - 0.3, y - 0.4)])
        return Prism(RoundedRing(loops, float(rng.choice([0.0, 0.3]))), low, high)
    if kind == 3:
        shape = tuple(rng.integers(1, 8, 3).tolist())
        cubes = rng.random(shape) < rng.choice([0.05, 0.3])
        cubes.flat[0] = True
        return Voxels(cubes, float(rng.choice([0.5, 1.0, 3.0])), (x, y, z))
    if kind == 4:
        squares = rng.random(tuple(rng.integers(1, 9, 2).tolist())) < 0.3
        squares.flat[0] = True
        return GridPrism(Grid(squares, 1.5, (x, y, float(rng.choice([0.0, 0.7])))), low, high)
    end = [(x, y, z), (x, y, z + 9), (x + 9, y, z), tuple(rng.uniform(0, 40, 3).tolist())]
    return RoundedSegment((x, y, z), end[int(rng.integers(4))], float(rng.choice([0.0, 0.2, 3.0])))


@pytest.fixture(scope="session")
def random_space() -> Callable[[np.random.Generator, int], dict[str, Any]]:
    """Makes what a spatial world of at most so many solids is made of, for the oracle as well."""

    def make(rng: np.random.Generator, most: int) -> dict[str, Any]:
        world: dict[str, Any] = {"solids": [_random_solid(rng) for _ in range(rng.integers(most))]}
        world["core"] = [(0.0, 0.0), (0.8, 0.0), (0.5, 0.3), (0.0, 1.0)][rng.integers(4)]
        if rng.random() < 0.6 or not world["solids"]:
            world["bounds"] = (-15.0, -10.0, 55.0, 60.0)
        if rng.random() < 0.3:
            world["ground"] = float(rng.uniform(-9, 0))
        elif rng.random() < 0.5:
            nodes = rng.uniform(-9, 3, tuple(rng.integers(2, 22, 2).tolist()))
            nodes[rng.random(nodes.shape) < rng.choice([0.0, 0.02])] = np.nan
            world["ground"] = Terrain(nodes, float(rng.choice([2.0, 11.0])), (-9.0, -5.0))
            world["nodata"] = str(rng.choice(["blocked", "free"]))
        return world

    return make


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
    with warnings.catch_warnings():  # lines keep no heading, as is said
        warnings.simplefilter("ignore", MissionWarning)
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
