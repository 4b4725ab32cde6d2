"""Distances beside coal's, routes through free boxes of fastpathplanning and of GCS in drake.

    python benchmarks/space_peers.py coal [PLACES]      distances of both, kind by kind, and times
    python benchmarks/space_peers.py boxes [WORLDS]     fastpathplanning among 50 upright boxes
    python benchmarks/space_peers.py gcs [WORLDS [BUILDINGS]]   GCS, among as many of these

coal is installed with the tools; the others by hand (``pip install fastpathplanning drake``,
300 MB). Both need free boxes: between walls grown by clearance and body, overlapping and each as
large as can be, or side by side. Times are the processor's of one call, after one that compiles.
"""

import math
import sys
import time
from contextlib import redirect_stdout
from io import StringIO

import numpy as np
from space_routes import CLEARANCE, key_of, solid, timed

from viaspline.kernels.space.space_distance import space_distances
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism, RoundedSegment
from viaspline.space.routing.search_room import SearchRoom
from viaspline.space.routing.space_router import SpaceRouter
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld

RADIUS, HALF_HEIGHT = 0.5, 0.3
LOWEST, HIGHEST, SIDE = 2.0, 100.0, 500.0
DURATION = 60.0
KINDS = ("ball", "capsule", "box", "disc prism", "polygon prism")


def solid_of(kind, rng, middle, size=1.0):
    """A solid of a kind; most polygons of seven corners are more than their hull's boxes."""
    x, y, z = middle
    if kind == "ball":
        return RoundedSegment((x, y, z), (x, y, z), rng.uniform(0.5, 4) * size)
    if kind == "capsule":
        other = middle + rng.normal(0, 6, 3) * size
        return RoundedSegment((x, y, z), tuple(other), rng.uniform(0.1, 1) * size)
    low, high = z - rng.uniform(0.5, 6) * size, z + rng.uniform(0.5, 6) * size
    if kind == "disc prism":
        return Prism(RoundedRing([[(x, y)]], rng.uniform(0.5, 5) * size), low, high)
    turn, wide = rng.uniform(0, math.pi), rng.uniform(0.5, 5, 2) * size
    angles = np.sort(rng.uniform(0, 2 * math.pi, 7))
    around = np.column_stack((np.cos(angles), np.sin(angles))) * wide[0]
    if kind == "box":
        around = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * wide
    c, s = math.cos(turn), math.sin(turn)
    return Prism(RoundedRing([[tuple(p) for p in around @ ((c, s), (-s, c)) + (x, y)]]), low, high)


def coal_object(coal, made):
    """The same solid, as coal has it: a shape and where it is."""
    pose = coal.Transform3s.Identity()
    if isinstance(made, RoundedSegment):
        first, last = np.array(made.first), np.array(made.last)
        pose.setTranslation((first + last) / 2)
        length = np.linalg.norm(last - first)
        if not length:
            return coal.Sphere(made.radius), pose
        along = (last - first) / length
        across = np.linalg.svd(along[None])[2][1]
        pose.setRotation(np.column_stack((across, np.cross(along, across), along)))
        return coal.Capsule(made.radius, length), pose
    corners, middle = np.array(made.ring.loops[0]), (made.low + made.high) / 2
    if made.ring.is_disc:
        pose.setTranslation(np.array((*corners[0], middle)))
        return coal.Cylinder(made.ring.radius, made.high - made.low), pose
    ends = [np.column_stack((corners, np.full(len(corners), z))) for z in (made.low, made.high)]
    points = coal.StdVec_Vec3s()
    points.extend(list(np.vstack(ends)))
    return coal.Convex.convexHull(points, False, "Qt"), pose


def placed(coal, at):
    pose = coal.Transform3s.Identity()
    pose.setTranslation(np.asarray(at, float))
    return pose


def pairs(coal, places):
    """Solids one by one: how far both libraries say that the body is, at places outside of them."""
    body, rng = coal.Cylinder(RADIUS, 2 * HALF_HEIGHT), np.random.default_rng(1)
    for kind in KINDS:
        apart, ours_took, theirs_took, count = [], 0.0, 0.0, 0
        while count < places:
            made = solid_of(kind, rng, rng.uniform(-3, 3, 3))
            world = SpatialWorld.of([made], core_radius=RADIUS, core_half_height=HALF_HEIGHT)
            asked = rng.uniform(-20, 20, (100, 3))
            space_distances(world.packed, asked)
            begun = time.process_time()
            ours = space_distances(world.packed, asked)[0]
            ours_took += time.process_time() - begun
            shape, pose = coal_object(coal, made)
            rest = [
                (placed(coal, at), coal.DistanceRequest(), coal.DistanceResult()) for at in asked
            ]
            begun = time.process_time()
            theirs = np.array([coal.distance(shape, pose, body, *others) for others in rest])
            theirs_took += time.process_time() - begun
            clear = (ours > 1e-3) | (theirs > 1e-3)
            apart += [*np.abs(ours - theirs)[clear]]
            count += len(asked)
        print(f"{kind}: {len(apart)} places outside, apart by {np.median(apart):.1e} m in the "
              f"median, {max(apart):.1e} at most; {1e6 * ours_took / count:.2f} and "
              f"{1e6 * theirs_took / count:.2f} µs")  # fmt: skip


def worlds_of_many(coal, places):
    """The nearest of many solids, by an index of each library."""
    for count in (50, 1000):
        rng = np.random.default_rng(count)
        solids = [solid(rng, count > 100) for _ in range(count)]
        world = SpatialWorld.of(solids, core_radius=RADIUS, core_half_height=HALF_HEIGHT)
        manager, kept = coal.DynamicAABBTreeCollisionManager(), []
        for made in solids:
            kept.append(coal.CollisionObject(*coal_object(coal, made)))
            manager.registerObject(kept[-1])
        manager.setup()
        asked = rng.uniform((0, 0, 2), (500, 500, 100), (places, 3))
        space_distances(world.packed, asked)
        begun = time.process_time()
        ours = space_distances(world.packed, asked)[0]
        took = time.process_time() - begun
        body = coal.CollisionObject(coal.Cylinder(RADIUS, 2 * HALF_HEIGHT))
        theirs, spent = [], 0.0
        for at in asked:
            body.setTransform(placed(coal, at))
            body.computeAABB()
            called = coal.DistanceCallBackDefault()
            begun = time.process_time()
            manager.distance(body, called)
            spent += time.process_time() - begun
            theirs.append(called.data.result.min_distance)
        clear = (ours > 1e-3) | (np.array(theirs) > 1e-3)
        apart = (np.array(theirs) - ours)[clear]
        print(f"{count} solids: {len(apart)} places outside, coal's distance is greater by a "
              f"millimetre at {np.sum(apart > 1e-3)} and less at {np.sum(apart < -1e-3)}, "
              f"by {np.abs(apart).max():.1e} m at most; "
              f"{1e6 * took / places:.2f} and {1e6 * spent / places:.2f} µs")  # fmt: skip


def coal(places=2000):
    import coal as library

    pairs(library, int(places))
    worlds_of_many(library, int(places))


def buildings(seed, count=50):
    """Buildings along the axes, as solids, and two places clear of them, 300 m apart at least."""
    rng = np.random.default_rng(seed)
    low = np.column_stack((rng.uniform(20, 440, (count, 2)), np.zeros(count)))
    high = low + np.column_stack((rng.uniform(10, 50, (count, 2)), rng.uniform(15, 90, count)))
    solids = [
        Prism(RoundedRing([[(a, b), (c, b), (c, d), (a, d)]]), 0.0, top)
        for (a, b, _), (c, d, top) in zip(low.tolist(), high.tolist(), strict=True)
    ]
    made = SpatialWorld.of(
        solids, ground=0.0, bounds=(0, 0, SIDE, SIDE), core_radius=RADIUS,
        core_half_height=HALF_HEIGHT, band=HeightBand(lowest=LOWEST, highest=HIGHEST),
    )  # fmt: skip
    grown = np.array((CLEARANCE + RADIUS, CLEARANCE + RADIUS, CLEARANCE + HALF_HEIGHT))
    low, high = low - grown, high + grown
    while True:
        ends = rng.uniform((10, 10, 5), (490, 490, 60), (2, 3))
        inside = ((ends[:, None] > low) & (ends[:, None] < high)).all(axis=2).any()
        if math.dist(ends[0, :2], ends[1, :2]) > 300 and not inside:
            return made, solids, low, high, ends[0], ends[1]


def free_cells(low, high):
    """Faces of grown walls along each axis, and which of the cells between these are blocked."""
    edge = CLEARANCE + RADIUS
    limits = [(edge, SIDE - edge), (edge, SIDE - edge), (LOWEST, HIGHEST)]
    faces = []
    for axis, ends in enumerate(limits):
        met = np.concatenate((low[:, axis], high[:, axis])).clip(*ends)
        faces.append(np.unique(np.concatenate((met, ends))))
    middles = [(f[1:] + f[:-1]) / 2 for f in faces]
    blocked = np.zeros([len(m) for m in middles], bool)
    for a, b in zip(low, high, strict=True):
        blocked[np.ix_(*[(m > a[i]) & (m < b[i]) for i, m in enumerate(middles)])] = True
    return faces, blocked


def grown(blocked, cell):
    """The cells of a box about one, grown face by face, in turn, as far as nothing is there."""
    ends = np.array((cell, np.add(cell, 1)))
    turns = [(axis, end, step) for axis in (2, 0, 1) for end, step in ((0, -1), (1, 1))]
    while turns:
        for turn in list(turns):
            axis, end, step = turn
            ends[end, axis] += step
            inside = 0 <= ends[end, axis] <= blocked.shape[axis]
            if not inside or blocked[tuple(map(slice, *ends))].any():
                ends[end, axis] -= step
                turns.remove(turn)
    return ends


def free_boxes(low, high, *, overlap):
    """Boxes that cover all that is free, from (n, 3) to (n, 3); may they overlap each other?"""
    faces, blocked = free_cells(low, high)
    held, found = blocked.copy(), []
    while not held.all():
        cell = np.unravel_index(np.argmin(held), held.shape)
        ends = grown(blocked if overlap else held, cell)
        held[tuple(map(slice, *ends))] = True
        found.append([[f[i] for f, i in zip(faces, at, strict=True)] for at in ends])
    made = np.array(found)
    return made[:, 0], made[:, 1]


def our_plan(solids, start, goal):
    import viaspline as vs

    mission = vs.Mission.model_validate({
        "world": {"bounds": [0, 0, SIDE, SIDE], "ground": {"flat_m": 0},
                  "altitude": {"min_m": LOWEST, "max_m": HIGHEST},
                  "known": [key_of(solid) for solid in solids]},
        "robot": {"radius_m": RADIUS, "half_height_m": HALF_HEIGHT, "clearance_m": CLEARANCE,
                  "max_speed_mps": 10, "max_accel_mps2": 2},
        "route": {"start": start.tolist(), "goal": goal.tolist(), "optimise": "length"},
    })  # fmt: skip
    begun = time.process_time()
    plan = vs.plan(mission)
    spent = 1e3 * (time.process_time() - begun)
    assert plan.certificate.holds
    return plan.path.length, spent


def by_fastpathplanning(low, high, start, goal):
    """Lengths [m] of its polyline and its curve, times [ms] of its boxes' graph and of both."""
    import fastpathplanning
    from fastpathplanning.polygonal import iterative_planner

    moments = [time.process_time()]
    with redirect_stdout(StringIO()):
        safe = fastpathplanning.SafeSet(low, high, verbose=False)
        moments.append(time.process_time())
        row, _, _ = safe.G.shortest_path(goal)[0](start)
        _, _, taut, _ = iterative_planner(safe.B, start, goal, row, verbose=False)
        moments.append(time.process_time())
        still = {1: np.zeros(3), 2: np.zeros(3)}
        curve = fastpathplanning.plan(
            safe, start, goal, DURATION, [0, 1], still, still, verbose=False
        )
    moments.append(time.process_time())
    points = np.array([curve(t) for t in np.linspace(0, DURATION, 6001)])
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    return taut, length, *(1e3 * np.diff(moments))


def by_gcs(low, high, start, goal):
    """Length [m], processor time [s] and edges of GCS: lines through boxes, relaxed, rounded."""
    from pydrake.geometry.optimization import GraphOfConvexSetsOptions, HPolyhedron, Point
    from pydrake.planning import GcsTrajectoryOptimization
    from pydrake.solvers import ClarabelSolver

    begun = time.process_time()
    meets = ((low[:, None] <= high) & (low <= high[:, None])).all(axis=2)
    edges = [(int(i), int(j)) for i, j in np.argwhere(meets) if i != j]
    gcs = GcsTrajectoryOptimization(3)
    regions = [HPolyhedron.MakeBox(a, b) for a, b in zip(low, high, strict=True)]
    free = gcs.AddRegions(regions, edges, 1, 0.0)
    source, target = (gcs.AddRegions([Point(place)], 0, 0.0) for place in (start, goal))
    gcs.AddEdges(source, free)
    gcs.AddEdges(free, target)
    gcs.AddPathLengthCost()
    options = GraphOfConvexSetsOptions()
    options.convex_relaxation, options.preprocessing = True, False
    options.max_rounded_paths, options.max_rounding_trials = 100, 1000
    options.solver = ClarabelSolver()
    path, result = gcs.SolvePath(source, target, options)
    spent = time.process_time() - begun
    if not result.is_success():
        return math.inf, spent, len(edges)
    points = path.vector_values(np.linspace(path.start_time(), path.end_time(), 20001)).T
    return np.linalg.norm(np.diff(points, axis=0), axis=1).sum(), spent, len(edges)


def boxes(worlds=10):
    """Ours beside fastpathplanning's, world by world."""
    rows = []
    for seed in (0, *range(int(worlds))):
        made, solids, low, high, start, goal = buildings(seed)
        outcome, routed = timed(SpaceRouter(SearchRoom.of_world(made)), start, goal, CLEARANCE)
        length, planned = our_plan(solids, start, goal)
        begun = time.process_time()
        free = free_boxes(low, high, overlap=True)
        divided = 1e3 * (time.process_time() - begun)
        taut, curve, *spent = by_fastpathplanning(*free, start, goal)
        rows.append((taut / outcome.cost, curve / length, routed, planned, divided, *spent))
        print(f"world {seed}: {len(free[0])} free boxes; {outcome.cost:.2f} and {length:.2f} m, "
              f"fastpathplanning {taut:.2f} and {curve:.2f}", flush=True)  # fmt: skip
    found = np.array(rows[1:]).T
    names = ("its polyline / our route", "its curve / our plan")
    for name, row in zip(names, found[:2], strict=True):
        print(f"{name}: mean {row.mean():.4f}, from {row.min():.4f} to {row.max():.4f}")
    names = ("route", "plan", "free boxes", "graph", "polyline", "polyline and curve")
    for name, row in zip(names, found[2:], strict=True):
        print(f"{name}: median {np.median(row):.1f} ms, worst {row.max():.1f}")


def gcs(worlds=3, count=50):
    """Our route beside that of GCS."""
    for seed in range(int(worlds)):
        made, _, low, high, start, goal = buildings(seed, int(count))
        router = SpaceRouter(SearchRoom.of_world(made))
        timed(router, start, goal, CLEARANCE)
        outcome, routed = timed(router, start, goal, CLEARANCE)
        free = free_boxes(low, high, overlap=False)
        length, spent, edges = by_gcs(*free, start, goal)
        print(f"world {seed}: {len(free[0])} free boxes, {edges} edges; {outcome.cost:.2f} m in "
              f"{routed:.1f} ms, GCS {length:.2f} in {spent:.1f} s, {length / outcome.cost:.4f}",
              flush=True)  # fmt: skip


if __name__ == "__main__":
    tables = {f.__name__: f for f in (coal, boxes, gcs)}
    tables[sys.argv[1]](*sys.argv[2:])
