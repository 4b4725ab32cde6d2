"""Proofs in space: clearance among mixed shapes and along cables, height above ground.

    python benchmarks/space_certificate.py [PATHS]       times
    python benchmarks/space_certificate.py --check 1000  none nearer than proven, every millimetre

Each time is the least of nine: the machine is shared.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.certificate import PROOF_TOLERANCE_M, certify
from viaspline.curve.height_certificate import certify_heights
from viaspline.kernels.space.ground_clearance import least_height
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism, RoundedSegment, Solid
from viaspline.world.space.spatial_world import SpatialWorld

LENGTH_M = 2000.0
LEG_M = 100.0


def timed(job: Callable[..., Any], *arguments: Any) -> float:
    """The least time of nine calls [µs]."""
    job(*arguments)
    best = math.inf
    for _ in range(9):
        start = time.perf_counter()
        job(*arguments)
        best = min(best, time.perf_counter() - start)
    return 1e6 * best


def mixed(rng: np.random.Generator, count: int, side: float) -> list[Solid]:
    """Towers, turned boxes, cables, balls and masts, a fifth each, up to 60 m high."""
    found: list[Solid] = []
    for k in range(count):
        x, y = rng.uniform(0, side, 2)
        z = float(rng.uniform(5, 60))
        if k % 5 == 0:
            found.append(Prism(RoundedRing([[(x, y)]], rng.uniform(1, 8)), 0.0, z))
        elif k % 5 == 1:
            corners = rng.uniform(3, 15, 2) * [(-1, -1), (1, -1), (1, 1), (-1, 1)]
            turn = rng.uniform(0, np.pi)
            c, s = np.cos(turn), np.sin(turn)
            ring = [(x + c * u - s * v, y + s * u + c * v) for u, v in corners]
            found.append(Prism(RoundedRing([ring]), 0.0, z))
        elif k % 5 == 2:
            step = rng.normal(0, 1, 3) * (1, 1, 0.1)
            step *= rng.uniform(10, 80) / np.linalg.norm(step)
            found.append(RoundedSegment((x, y, z), (x + step[0], y + step[1], z + step[2]), 0.1))
        elif k % 5 == 3:
            found.append(RoundedSegment((x, y, z), (x, y, z), rng.uniform(1, 8)))
        else:
            found.append(RoundedSegment((x, y, 0.0), (x, y, z), 0.3))
    return found


def clear_path(rng: np.random.Generator, world: SpatialWorld, side: float) -> CardinalSpline:
    """A path of 2 km that keeps a metre: legs of 100 m, now and then one that is turned away."""
    while True:
        points = [np.array([*rng.uniform(0.1 * side, 0.9 * side, 2), 60.0])]
        heading = rng.uniform(0, 2 * np.pi)
        for _ in range(3000):
            turned = heading + rng.normal(0, 0.5)
            step = (LEG_M * np.cos(turned), LEG_M * np.sin(turned), rng.normal(0, 8))
            new = points[-1] + step
            if (new[:2] < 0).any() or (new[:2] > side).any() or not 20 < new[2] < 90:
                heading = rng.uniform(0, 2 * np.pi)
                continue
            leg = CardinalSpline(np.array([*points[-2:], new]))
            if certify(leg, world, 1.0).clearance > 1.2:
                points.append(new)
                heading = turned
            if len(points) > LENGTH_M / LEG_M:
                curve = CardinalSpline(np.array(points))
                if certify(curve, world, 1.0).holds:
                    return curve
                break


def report(what: str, times: list[float], most: str = "") -> None:
    print(f"| {what} | {np.median(times):.0f} µs | {max(times):.0f} µs | {most} |", flush=True)


def clearances(paths: int) -> None:
    for count, side, most in ((100, 500.0, "60"), (1000, 1000.0, ""), (10_000, 3000.0, "250")):
        rng = np.random.default_rng(1)
        shapes = mixed(rng, count, side)
        for core in ((0.0, 0.0), (0.4, 0.2)):
            world = SpatialWorld.of(
                shapes, ground=0.0, bounds=(-50, -50, side + 50, side + 50),
                core_radius=core[0], core_half_height=core[1],
            )  # fmt: skip
            curves = [clear_path(rng, world, side) for _ in range(paths)]
            body = "ball" if core[0] == 0.0 else "cylinder"
            times = [timed(certify, curve, world, 1.0) for curve in curves]
            report(f"certificate, {count:,} shapes, {body}", times, most)


def through_shapes(paths: int) -> None:
    """Paths that nobody has kept clear: how deep they get is found as well."""
    rng = np.random.default_rng(6)
    world = SpatialWorld.of(mixed(rng, 100, 500.0), ground=0.0)
    times = []
    while len(times) < paths:
        points = rng.uniform((50, 50, 10), (450, 450, 40), (9, 3))
        curve = CardinalSpline(points)
        if certify(curve, world, 1.0).clearance < 0.0:
            times.append(timed(certify, curve, world, 1.0))
    report("certificate, 100 shapes, paths that cross some of them", times)


def along_cables() -> None:
    lines = [RoundedSegment((0.0, 5.0 * k, 20.0), (2000.0, 5.0 * k, 20.0), 0.05) for k in range(4)]
    x = np.linspace(0, 2000, 21)
    wobble = np.random.default_rng(0).normal(0, 0.02, 21)
    curve = CardinalSpline(np.column_stack((x, wobble - 3.0, np.full(21, 20.5))))
    for core in ((0.0, 0.0), (0.4, 0.2)):
        world = SpatialWorld.of(lines, core_radius=core[0], core_half_height=core[1])
        body = "ball" if core[0] == 0.0 else "cylinder"
        times = [timed(certify, curve, world, 1.0)]
        report(f"certificate, 2 km along four cables, {body}", times)


def hills(rng: np.random.Generator, rough: float) -> Terrain:
    """A square kilometre at 1 m, up to 200 m high."""
    y, x = np.indices((1001, 1001)).astype(float)
    heights = rng.normal(0, rough, x.shape)
    for _ in range(12):
        wide, turn = rng.uniform(100, 600), rng.uniform(0, 2 * np.pi)
        wave = (x * np.cos(turn) + y * np.sin(turn)) * 2 * np.pi / wide
        heights += wide / 40 * np.sin(wave + rng.uniform(0, 6))
    return Terrain(heights, 1.0)


def ground_path(rng: np.random.Generator, world: SpatialWorld, level: float) -> CardinalSpline:
    """2 km over a square kilometre, level or by via points 30 m above ground every 20 m."""
    leg = 20.0 if math.isnan(level) else LEG_M
    points = [rng.uniform(200, 800, 2)]
    heading = rng.uniform(0, 2 * np.pi)
    while len(points) <= LENGTH_M / leg:
        turned = heading + rng.normal(0, 0.4)
        new = points[-1] + leg * np.array([np.cos(turned), np.sin(turned)])
        if (new < 10).any() or (new > 990).any():
            heading = rng.uniform(0, 2 * np.pi)
            continue
        heading = turned
        points.append(new)
    ground = world.ground_at(np.array(points)) + 30.0
    heights = ground if math.isnan(level) else level + rng.normal(0, 8, len(points))
    return CardinalSpline(np.column_stack((points, heights)))


def heights_above_ground(paths: int) -> None:
    for rough in (0.0, 0.1):
        rng = np.random.default_rng(2)
        terrain = hills(rng, rough)
        world = SpatialWorld.of(ground=terrain)
        for kind, level in (("level", terrain.highest + 20.0), ("along the ground", math.nan)):
            curves = [ground_path(rng, world, level) for _ in range(paths)]
            spans = [np.array(curve.spans) for curve in curves]
            times = [timed(least_height, world.packed, one, 1.0, 0.05) for one in spans]
            report(f"least height above ground, roughness {rough} m, {kind}", times, "50")
    times = [timed(certify_heights, curve, world) for curve in curves]
    report("all of `certify_heights`, the last of these", times)


def voxels() -> None:
    rng = np.random.default_rng(3)
    cubes = np.zeros((447, 444, 444), bool)
    cubes.flat[rng.integers(0, cubes.size, cubes.size // 200)] = True
    cubes.flags.writeable = False
    block = Voxels(cubes, 1.0)
    start = time.perf_counter()
    world = SpatialWorld.of([block])
    taken = time.perf_counter() - start
    words = world.packed.voxel_words.nbytes
    places = rng.uniform(0, 440, (20_000, 3))
    each = timed(world.distance, places) / len(places)
    print(
        f"\n{cubes.size / 1e6:.0f} million voxels: {words / 1e6:.1f} MB packed in {taken:.2f} s, "
        f"a distance in {each:.2f} µs"
    )


def check(cases: int) -> None:
    """Certificates of random curves among random shapes beside a place every millimetre."""
    rng = np.random.default_rng(5)
    nearer, clear, loosest = 0, 0, 0.0
    for _ in range(cases):
        core = (0.0, 0.0) if rng.random() < 0.5 else (0.5, 0.3)
        world = SpatialWorld.of(
            mixed(rng, int(rng.integers(1, 12)), 60.0), ground=0.0,
            core_radius=core[0], core_half_height=core[1],
        )  # fmt: skip
        points = rng.uniform((0, 0, 2), (60, 60, 70), (rng.integers(2, 5), 3))
        curve = CardinalSpline(points)
        _, _, places = curve.sample(1e-3)
        least = float(world.distance(places).min())
        found = certify(curve, world, 1.0).clearance
        nearer += found > least + 1e-9
        if least > 0:
            clear += 1
            loosest = max(loosest, least - found)
    print(
        f"{cases} curves, {clear} of them clear: {nearer} nearer than proven, at most "
        f"{1e3 * loosest:.2f} mm proven too little ({1e3 * PROOF_TOLERANCE_M:.0f} mm allowed)"
    )


def main() -> None:
    if sys.argv[1:2] == ["--check"]:
        check(int(sys.argv[2]))
        return
    paths = int(sys.argv[1]) if sys.argv[1:] else 30
    print("| what | median | worst | at most |\n|---|---|---|---|")
    clearances(paths)
    through_shapes(paths)
    along_cables()
    heights_above_ground(paths)
    voxels()


if __name__ == "__main__":
    main()
