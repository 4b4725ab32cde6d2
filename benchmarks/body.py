"""The certificate of a polygonal body, beside poses every centimetre measured by shapely.

    python benchmarks/body.py [ROUNDS]

A vehicle of 4.5 m x 2 m, its reference point on the rear axle, along the planned paths of the
standard worlds (about 650 m, 20 obstacles) and of cluttered ones (300 obstacles), and along a
corridor on an occupancy grid. The poses prove nothing of what lies between them.
"""

from __future__ import annotations

import math
import sys
import time

import numpy as np
import shapely
from worlds import RADIUS, SIZE, crossing, dense, obstacles

import viaspline as vs
from viaspline.curve.bending import curvature_bound
from viaspline.curve.footprint_conflicts import body_conflicts

CAR = np.array([(-1, -1), (3.5, -1), (3.5, 1), (-1, 1)], float)
CLEARANCE = 0.5


def planned(seed: int, count: int) -> tuple[vs.Path, vs.World]:
    """The path of a disc that is as wide as the vehicle, and some."""
    found = obstacles(seed) if count == 20 else dense(seed, count, RADIUS)
    mission = crossing(found)
    return vs.plan(mission).path, vs.World.known(mission)


def corridor() -> tuple[vs.CardinalSpline, vs.World]:
    """A winding corridor 3.5 m wide on a grid of 0.1 m."""
    x = np.arange(0, 200, 10.0)
    curve = vs.CardinalSpline(np.column_stack((x, 20 + 4 * np.sin(x / 15))))
    _, _, points = curve.sample(0.05)
    line = shapely.LineString(points).buffer(1.75 + 1e-9)
    shapely.prepare(line)
    u, v = np.meshgrid(np.arange(2300), np.arange(400))
    free = shapely.contains_xy(line, (u + 0.5) * 0.1 - 15, (v + 0.5) * 0.1)
    grid = vs.Grid(~free, 0.1, (-15.0, 0.0, 0.0))
    return vs.CardinalSpline(points[200:-200:200]), vs.World([vs.Obstacle(grid=grid)])


def milliseconds(call: object, rounds: int) -> float:
    spent = []
    for _ in range(rounds):
        begin = time.perf_counter()
        call()
        spent.append(time.perf_counter() - begin)
    return 1e3 * float(np.median(spent))


def sampled(curve: vs.PiecewiseCubic, shapes: list, spacing: float) -> float:
    """The least distance of poses by shapely."""
    u, _, points = curve.sample(spacing)
    heading = curve.heading(u)
    c, s = np.cos(heading)[:, None], np.sin(heading)[:, None]
    rings = np.stack((c * CAR[:, 0] - s * CAR[:, 1], s * CAR[:, 0] + c * CAR[:, 1]), axis=-1)
    bodies = shapely.polygons(rings + points[:, None, :])
    tree = shapely.STRtree(shapes)
    _, distance = tree.query_nearest(bodies, return_distance=True, all_matches=False)
    return float(distance.min())


def shapes(world: vs.World) -> list:
    x0, y0, x1, y1 = world.bounds or (-1e9, -1e9, 1e9, 1e9)
    found = [shapely.LinearRing([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])]
    for one in world.obstacles:
        if one.circle is not None:
            found.append(shapely.Point(one.circle.center).buffer(one.circle.radius, quad_segs=256))
        elif one.polygon is not None:
            found.append(shapely.Polygon(one.polygon))
    return found


def report(name: str, curve: vs.PiecewiseCubic, world: vs.World, rounds: int) -> tuple[float, ...]:
    spans = np.array(curve.spans)
    found = vs.certify(curve, world, CLEARANCE, footprint=CAR)
    required = found.clearance - 0.05 if found.clearance > 0.05 else CLEARANCE
    disc = milliseconds(lambda: vs.certify(curve, world, CLEARANCE, radius=1.0), rounds)
    whole = milliseconds(lambda: vs.certify(curve, world, CLEARANCE, footprint=CAR), rounds)
    quick = milliseconds(lambda: body_conflicts(world.packed, spans, CAR, required), rounds)
    bend = milliseconds(lambda: curvature_bound(curve), rounds)
    print(f"{name:26s} {curve.length:6.0f} m {len(spans):4d} spans, clearance "
          f"{found.clearance:8.4f} m: certificate {whole:7.3f} ms, conflicts {quick:7.3f} ms, "
          f"disc {disc:7.3f} ms, curvature {bend:7.3f} ms")  # fmt: skip
    return whole, quick


def main(rounds: int) -> None:
    for count in (20, 300):
        figures = []
        for seed in range(5):
            curve, world = planned(seed, count)
            figures.append(report(f"{count} obstacles, seed {seed}", curve, world, rounds))
        middle, worst = np.median(figures, axis=0), np.max(figures, axis=0)
        print(f"{count} obstacles: certificate median {middle[0]:.3f} ms, worst {worst[0]:.3f} ms; "
              f"conflicts median {middle[1]:.3f} ms, worst {worst[1]:.3f} ms")  # fmt: skip
    curve, world = corridor()
    report("corridor on a grid", curve, world, rounds)
    curve, world = planned(0, 20)
    begin = time.perf_counter()
    least = sampled(curve, shapes(world), 0.01)
    spent = time.perf_counter() - begin
    found = vs.certify(curve, world, CLEARANCE, footprint=CAR)
    print(f"shapely, poses at 1 cm: {1e3 * spent:.0f} ms, {least:.4f} m; "
          f"certificate {found.clearance:.4f} m")  # fmt: skip
    random = np.random.default_rng(0)
    at, heading = random.uniform(0, SIZE, (100_000, 2)), random.uniform(-math.pi, math.pi, 100_000)
    apiece = milliseconds(lambda: world.body_distance(at, heading, CAR), 3) / len(at)
    print(f"distance of a standing body: {1e6 * apiece:.0f} ns")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
