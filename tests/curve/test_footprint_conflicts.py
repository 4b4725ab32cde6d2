"""A polygonal body along a curve, in a pose, and span by span; beside shapely."""

import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.certificate import PROOF_SLACK_M, PROOF_TOLERANCE_M, Certificate, certify
from viaspline.curve.footprint_conflicts import body_conflicts
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

Floats = NDArray[np.float64]
seeds = st.integers(0, 100_000)

CAR = np.array([(-1, -0.5), (3, -0.5), (3, 0.5), (-1, 0.5)], float)
BOOT = np.array([(-1, -0.5), (2, -0.5), (2, -0.1), (0.5, -0.1), (0.5, 0.8), (-1, 0.8)], float)
KITE = np.array([(-2, 0), (0.3, -0.6), (1.5, 0.2), (0, 1.1)], float)
BODIES = (CAR, BOOT, KITE)


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (float(x), float(y)), "radius": float(radius)})


def box(x0: float, y0: float, x1: float, y1: float) -> Obstacle:
    return Obstacle(polygon=[(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


class Around:
    """The world as shapely sees it: the distance of polygons to everything."""

    def __init__(
        self, obstacles: list[Obstacle], bounds: Any = None, fences: Any = (), far: float = 1e4
    ) -> None:
        self.shapes: list[tuple[Any, float]] = []
        for obstacle in obstacles:
            if obstacle.circle is not None:
                self.shapes.append((shapely.Point(obstacle.circle.center), obstacle.circle.radius))
            elif obstacle.grid is not None:
                self.shapes.append((squares(obstacle.grid), 0.0))
            else:
                self.shapes.append((shapely.Polygon(obstacle.polygon, obstacle.holes), 0.0))
        everywhere = shapely.box(-far, -far, far, far)
        if bounds is not None:
            self.shapes.append((everywhere.difference(shapely.box(*bounds)), 0.0))
        for fence in fences:
            self.shapes.append((everywhere.difference(shapely.Polygon(fence)), 0.0))
        for shape, _ in self.shapes:
            shapely.prepare(shape)

    def __call__(self, bodies: Any) -> Floats:
        found = np.full(len(bodies), np.inf)
        for shape, radius in self.shapes:
            found = np.minimum(found, shapely.distance(shape, bodies) - radius)
        return np.maximum(found, 0.0)


def squares(grid: Grid) -> Any:
    rows, columns = np.nonzero(grid.blocked)
    x, y, yaw = grid.origin
    cells = shapely.box(columns, rows, columns + 1, rows + 1)
    c, s, side = math.cos(yaw), math.sin(yaw), grid.resolution
    turn = np.array([(c, -s), (s, c)]) * side
    return shapely.transform(shapely.union_all(cells), lambda uv: uv @ turn.T + (x, y))


def standing(footprint: Floats, positions: Floats, headings: Floats) -> Any:
    """The body in poses, as shapely polygons."""
    c, s = np.cos(headings)[:, None], np.sin(headings)[:, None]
    x, y = footprint[:, 0], footprint[:, 1]
    rings = np.stack((c * x - s * y, s * x + c * y), axis=-1) + positions[:, None, :2]
    return shapely.polygons(rings)


def hodograph(spans: Floats, w: Floats) -> Floats:
    step = np.diff(spans[:, :, :2], axis=1)
    basis = np.array([(1 - w) ** 2, 2 * w * (1 - w), w * w])
    return np.einsum("kw,mkd->mwd", basis, step)


def poses(curve: PiecewiseCubic, count: int) -> tuple[Floats, Floats]:
    """Places and headings all along, turns on the spot at corners and at the seam among them."""
    u = np.linspace(*curve.domain, count * len(curve.spans) + 1)
    at, heading = [curve.evaluate(u)[:, :2]], [curve.heading(u)]
    joints = np.arange(1.0, len(curve.spans) + (1 if curve.closed else 0))
    for joint in joints:
        before = curve.heading(joint - 1e-9)
        after = curve.heading(joint - len(curve.spans) if joint == len(curve.spans) else joint)
        turn = math.remainder(after - before, math.tau)
        heading.append(before + np.linspace(0, 1, 50) * turn)
        at.append(np.repeat(curve.evaluate(joint)[None, :2], 50, axis=0))
    return np.concatenate(at), np.concatenate(heading)


def random_world(rng: np.random.Generator, near: Floats) -> tuple[list[Obstacle], dict[str, Any]]:
    """Obstacles of all kinds beside a curve, whose points are given."""
    obstacles = []
    for _ in range(rng.integers(0, 7)):
        aside = rng.normal(0, 1, 2)
        x, y = near[rng.integers(len(near))] + aside / np.hypot(*aside) * rng.uniform(3, 20)
        size = 10.0 ** rng.uniform(-2, 0.5)
        if rng.random() < 0.4:
            obstacles.append(disc(x, y, size))
        elif rng.random() < 0.7:
            angle = np.sort(rng.uniform(0, 2 * np.pi, 5) + np.arange(5) * 1e-2)
            reach = size * rng.uniform(0.5, 2, 5)
            ring = np.column_stack((x + reach * np.cos(angle), y + reach * np.sin(angle)))
            if not shapely.Polygon(ring).is_valid:
                continue
            obstacles.append(Obstacle(polygon=ring))
        else:
            around = np.array([(-30, -30), (90, -20), (100, 100), (-40, 90)], float)
            way = shapely.LineString(near).buffer(rng.uniform(2, 6))
            if way.geom_type == "Polygon" and shapely.Polygon(around).contains(way):
                hole = np.array(way.exterior.coords)[:-1]
                obstacles.append(Obstacle(polygon=around, holes=[hole]))
    if rng.random() < 0.5:
        blocked = rng.random(rng.integers(1, 20, 2)) < rng.choice([0.05, 0.3, 0.9])
        blocked[0, 0] = True
        place = (*rng.uniform(0, 60, 2).tolist(), float(rng.choice([0.0, 0.4, -1.9])))
        obstacles.append(Obstacle(grid=Grid(blocked, float(rng.choice([0.1, 0.7])), place)))
    frame: dict[str, Any] = {}
    if not obstacles or rng.random() < 0.4:
        frame["bounds"] = (-10.0, -12.0, 75.0, 80.0)
    if rng.random() < 0.4:
        frame["fences"] = [[(-40, -40), (160, -50), (90, 60), (150, 170), (-60, 150)]]
    return obstacles, frame


def random_curve(rng: np.random.Generator) -> PiecewiseCubic:
    return CardinalSpline(
        rng.uniform(0, 60, (rng.integers(2, 6), 2)),
        slack=float(rng.choice([0.0, 0.2, 0.5, 1.0, 1.5])),
        knots=str(rng.choice(["uniform", "centripetal", "chordal"])),  # type: ignore[arg-type]
        closed=bool(rng.random() < 0.3),
    )


@settings(max_examples=150)
@given(seeds)
def test_the_bound_is_proven_and_attained_to_a_millimetre(shapely_distance: Any, seed: int) -> None:
    rng = np.random.default_rng(seed)
    curve = random_curve(rng)
    obstacles, frame = random_world(rng, curve.sample(1.0)[2])
    world, body = World(obstacles, **frame), BODIES[seed % 3]
    found = certify(curve, world, 0.5, footprint=body)
    least = Around(obstacles, **frame)(standing(body, *poses(curve, 300))).min()
    if least == 0.0:
        assert found.clearance <= 0.0
        return
    assert found.clearance <= least + 1e-9
    check_contact(found, curve, body)
    at = float(shapely_distance([found.contact], obstacles, **frame)[0])
    assert found.clearance <= at + 1e-9
    assert at - max(PROOF_TOLERANCE_M, -0.3 * at) - 1e-9 <= found.clearance


def check_contact(found: Certificate, curve: PiecewiseCubic, body: Floats) -> None:
    """The contact is a point of the outline in a pose of the motion."""
    assert found.contact is not None
    assert found.tightest_heading is not None
    np.testing.assert_allclose(curve.evaluate(found.tightest_u), found.tightest_at, atol=1e-9)
    (there,) = standing(body, np.array([found.tightest_at]), np.array([found.tightest_heading]))
    assert there.exterior.distance(shapely.Point(found.contact)) < 1e-7
    w = found.tightest_u % 1.0
    if w != 0.0:  # at a joint it may be turning on the spot
        off = math.remainder(curve.heading(found.tightest_u) - found.tightest_heading, math.tau)
        assert abs(off) < 1e-6


@settings(max_examples=80)
@given(seeds)
def test_conflicts_agree_with_the_certificate(seed: int) -> None:
    rng = np.random.default_rng(seed)
    curve = random_curve(rng)
    obstacles, frame = random_world(rng, curve.sample(1.0)[2])
    world, body = World(obstacles, **frame), BODIES[seed % 3]
    open_curve = PiecewiseCubic(curve.spans)
    found = certify(open_curve, world, 0.5, footprint=body)
    spans = np.array(curve.spans)
    for required in (0.0, 0.3, 1.0, found.clearance - 2e-6):
        if required < -PROOF_SLACK_M:  # how deep is no question for a body
            continue
        clear = (body_conflicts(world.packed, spans, body, required) == -1).all()
        if found.clearance >= required + 1e-6:
            assert clear
        if found.clearance + PROOF_TOLERANCE_M < required:
            assert not clear


@settings(max_examples=100)
@given(seeds)
def test_a_body_that_stands_is_as_far_as_shapely_says(seed: int) -> None:
    rng = np.random.default_rng(seed)
    obstacles, frame = random_world(rng, rng.uniform(0, 60, (9, 2)))
    at, heading = rng.uniform(-20, 80, (200, 2)), rng.uniform(-9, 9, 200)
    body = BODIES[seed % 3]
    distance, index = World(obstacles, **frame).body_nearest(at, heading, body)
    truth = Around(obstacles, **frame)(standing(body, at, heading))
    np.testing.assert_allclose(distance, truth, atol=1e-6)
    assert (index != -1).all()
    for i, obstacle in enumerate(obstacles):
        mine = index == i
        one = Around([obstacle])(standing(body, at[mine], heading[mine]))
        np.testing.assert_allclose(one[distance[mine] > 0], truth[mine][distance[mine] > 0])


@settings(max_examples=40)
@given(seeds)
@example(8)
def test_moving_or_mirroring_everything_changes_nothing(seed: int) -> None:
    rng = np.random.default_rng(seed)
    curve = random_curve(rng)
    near = curve.sample(1.0)[2]
    discs = [
        disc(*(near[rng.integers(len(near))] + rng.uniform(-9, 9, 2)), rng.uniform(0.1, 2))
        for _ in range(4)
    ]
    body = BODIES[seed % 3]
    here = certify(curve, World(discs), 0.5, footprint=body).clearance
    angle, mirror = rng.uniform(0, 6), np.diag([1.0, rng.choice([-1.0, 1.0])])
    turn = mirror @ np.array(
        [(math.cos(angle), math.sin(angle)), (-math.sin(angle), math.cos(angle))]
    )
    moved = PiecewiseCubic(curve.spans @ turn.T + 7.0, closed=curve.closed)
    others = [disc(*(turn @ d.circle.center + 7.0), d.circle.radius) for d in discs if d.circle]
    there = certify(moved, World(others), 0.5, footprint=body @ mirror).clearance
    if min(here, there) > 0.0:
        assert here == pytest.approx(there, abs=PROOF_TOLERANCE_M)
    else:
        assert max(here, there) <= PROOF_TOLERANCE_M


@settings(max_examples=30)
@given(seeds)
def test_a_polygon_of_many_corners_is_nearly_a_disc(seed: int) -> None:
    rng = np.random.default_rng(seed)
    curve = random_curve(rng)
    obstacles, frame = random_world(rng, curve.sample(1.0)[2])
    world = World(obstacles, **frame)
    angle = np.arange(48) * math.tau / 48
    round_body = np.column_stack((np.cos(angle), np.sin(angle)))
    whole = certify(curve, world, 0.5, radius=1.0)
    cut = certify(curve, world, 0.5, footprint=round_body)
    if whole.clearance > 0.0:
        least = whole.clearance - PROOF_TOLERANCE_M
        assert (
            least
            <= cut.clearance
            <= whole.clearance + 1 - math.cos(math.pi / 48) + PROOF_TOLERANCE_M
        )
