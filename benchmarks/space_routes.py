"""Routes in space: among voxels, among buildings and among mixed shapes, beside OMPL.

    python benchmarks/space_routes.py voxels MAP.3dmap [EVERY]   each so-many-th of its problems
    python benchmarks/space_routes.py plans MAP.3dmap [EVERY]    whole missions: laid and proven
    python benchmarks/space_routes.py peers MAP.3dmap [EVERY]    A* of pathfinding3d on the cubes
    python benchmarks/space_routes.py memory                a map of 88 million voxels
    python benchmarks/space_routes.py shapes                50 buildings, and 1,000 mixed shapes
    python benchmarks/space_routes.py flights [50 [1000]]   whole missions in so many of these
    python benchmarks/space_routes.py fastest               the fastest route beside each side's
    python benchmarks/space_routes.py ompl [WORLDS [SECONDS]]   beside InformedRRT*

Times are the processor's, of one thread and one call, after one that compiles.
"""

import math
import resource
import sys
import time
from pathlib import Path

import numpy as np

from viaspline.kernels.space.routing.way_checks import way_cost
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism, RoundedSegment
from viaspline.planning.problem.method import Found, GaveUp, Refusal
from viaspline.space.routing.search_room import SearchRoom
from viaspline.space.routing.side_seeds import seeds
from viaspline.space.routing.space_router import SpaceRouter
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld

BALL = 0.45
CLEARANCE = 1.5
SPEEDS = (10.0, 2.5, 1.5)


def timed(router, *asked):
    begun = time.process_time()
    outcome = router.find(*asked)
    return outcome, 1e3 * (time.process_time() - begun)


def quartiles(times):
    return f"median {np.median(times):.2f} ms, mean {np.mean(times):.2f}, worst {max(times):.1f}"


def problems_of(path, every):
    """The cubes of a map, and each so-many-th of its problems: start, goal, length of 26 ways."""
    head, *rows = Path(path).read_text().splitlines()
    blocked = np.zeros(tuple(int(n) for n in head.split()[1:]), bool)
    blocked[tuple(np.array([r.split() for r in rows if r.strip()], int).T)] = True
    lines = Path(path + ".3dscen").read_text().splitlines()[2:]
    rows = np.array([line.split() for line in lines if line.strip()], float)[:: int(every)]
    return blocked, rows[:, :7]


def room_of(blocked):
    """What a mission's search sees of these cubes, and of nothing else."""
    cubes, (x, y, z) = Voxels(blocked, 1.0), blocked.shape
    world = SpatialWorld.of([cubes], bounds=(0, 0, x, y), band=HeightBand(BALL, z - BALL))
    return SearchRoom.of_world(world).knowing(world, [cubes])


def plans(path, every=10, optimise="length"):
    """Missions from cube to cube, planned as anybody's: laid, proven and timed."""
    import viaspline as vs

    blocked, problems = problems_of(path, every)
    cubes, (x, y, z) = Voxels(blocked, 1.0), blocked.shape
    world = {
        "bounds": [0, 0, x, y],
        "altitude": {"min_m": BALL, "max_m": z - BALL},
        "known": [{"voxels": cubes}],
    }
    robot = {"radius_m": BALL, "clearance_m": 0.0, "max_speed_mps": 2, "max_accel_mps2": 1}
    ratios, times, failed = [], [], []
    for problem in (problems[0], *problems):
        route = {"start": list(problem[:3] + 0.5), "goal": list(problem[3:6] + 0.5)}
        mission = vs.Mission.model_validate(
            {"world": world, "robot": robot, "route": {**route, "optimise": optimise}}
        )
        begun = time.process_time()
        try:
            plan = vs.plan(mission)
        except vs.PlanningError as error:
            failed.append(str(error))
            continue
        times.append(1e3 * (time.process_time() - begun))
        ratios.append(plan.path.length / problem[6] if plan.certificate.holds else math.inf)
    print(f"{Path(path).name}, by {optimise}: {len(ratios) - 1} of {len(problems)} planned")
    print(f"proven: {np.isfinite(ratios).sum() - 1}; longer than the optimum of 26 neighbours: "
          f"{sum(r > 1.0 + 1e-9 for r in ratios[1:])}")  # fmt: skip
    print(f"length / that optimum: mean {np.mean(ratios[1:]):.4f}, most {max(ratios[1:]):.4f}")
    print(f"{quartiles(times[1:])}, 99 % {np.percentile(times[1:], 99):.1f}", *failed, sep="\n")


def peers(path, every=500):
    from pathfinding3d.core.diagonal_movement import DiagonalMovement
    from pathfinding3d.core.grid import Grid
    from pathfinding3d.finder.a_star import AStarFinder

    blocked, problems = problems_of(path, every)
    finder = AStarFinder(diagonal_movement=DiagonalMovement.only_when_no_obstacle)
    ratios, times = [], []
    for problem in problems:
        grid = Grid(matrix=(~blocked).astype(np.int8))
        begun = time.process_time()
        way, _ = finder.find_path(
            grid.node(*problem[:3].astype(int)), grid.node(*problem[3:6].astype(int)), grid
        )
        times.append(1e3 * (time.process_time() - begun))
        points = np.array([(node.x, node.y, node.z) for node in way], float)
        ratios.append(np.linalg.norm(np.diff(points, axis=0), axis=1).sum() / problem[6])
    print(f"pathfinding3d, A*: {np.mean(ratios):.4f} of the optimum; {quartiles(times)}")


def voxels(path, every=1):
    blocked, problems = problems_of(path, every)
    router = SpaceRouter(room_of(blocked))
    timed(router, problems[0, :3] + 0.5, problems[0, 3:6] + 0.5, BALL)
    ratios, times, corners, solved = [], [], [], 0
    for problem in problems:
        outcome, spent = timed(router, problem[:3] + 0.5, problem[3:6] + 0.5, BALL)
        times.append(spent)
        if isinstance(outcome, Found):
            solved += 1
            ratios.append(outcome.cost / problem[6])
            corners.append(len(outcome.value.points))
    print(f"{Path(path).name}: {solved} of {len(problems)} problems solved")
    print(f"length / optimum of 26 neighbours: mean {np.mean(ratios):.4f}, most {max(ratios):.4f}")
    print(f"longer than it: {sum(r > 1.0 + 1e-9 for r in ratios)}")
    print(f"vertices: mean {np.mean(corners):.1f}, most {max(corners)}; {quartiles(times)}")


def memory():
    shape = (640, 500, 275)
    rng = np.random.default_rng(1)
    blocked = np.zeros(shape, bool)
    for _ in range(400):
        low = rng.integers(0, np.array(shape) - 40)
        high = low + rng.integers(5, 40, 3)
        blocked[low[0] : high[0], low[1] : high[1], low[2] : high[2]] = True
    blocked[0:3, 0:3, 0:3] = blocked[-3:, -3:, -3:] = False
    blocked.flags.writeable = False
    small = SpaceRouter(room_of(np.zeros((8, 8, 8), bool)))
    small.find((1, 1, 1), (6, 6, 6), BALL)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    begun = time.perf_counter()
    room = room_of(blocked)
    packing = time.perf_counter() - begun
    outcome, spent = timed(SpaceRouter(room), (1.5,) * 3, np.array(shape) - 1.5, BALL)
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    of_cubes, of_world = room.cubes, room.packed
    kept = of_cubes.words.nbytes + of_cubes.skips.nbytes + of_world.voxel_words.nbytes
    print(f"{blocked.size / 1e6:.0f} million voxels: {kept / 1e6:.1f} MB kept of them; the process")
    print(f"grew by {(after - before) / 1e3:.0f} MB, beside {blocked.nbytes / 1e6:.0f} MB of input")
    print(f"packed in {packing:.2f} s, one route across in {spent:.1f} ms, cost {outcome.cost:.1f}")


def prism(rng, x, y, share):
    height = rng.uniform(15, 90)
    if rng.random() < 0.5:
        return Prism(RoundedRing([[(x, y)]], rng.uniform(4, 15) * share), 0.0, height)
    turn = rng.uniform(0, math.pi)
    a, b = rng.uniform(5, 25, 2) * share
    c, s = math.cos(turn), math.sin(turn)
    corners = ((-a, -b), (a, -b), (a, b), (-a, b))
    return Prism(RoundedRing([[(x + c * u - s * v, y + s * u + c * v) for u, v in corners]]), 0.0,
                 height)  # fmt: skip


def solid(rng, mixed):
    x, y = rng.uniform(20, 480, 2)
    kind = rng.integers(0, 4) if mixed else 0
    if kind < 2:
        return prism(rng, x, y, 0.3 if mixed else 1.0)
    z = rng.uniform(5, 90)
    if kind == 2:
        return RoundedSegment((x, y, z), (x, y, z), rng.uniform(2, 8))
    along = rng.normal(size=3) * (30, 30, 10)
    other = (x + along[0], y + along[1], max(5.0, z + along[2]))
    return RoundedSegment((x, y, z), other, rng.uniform(0.2, 1.0))


def world(count, seed):
    """500 x 500 x 100 m, and two places in it that are 300 m apart at least."""
    rng = np.random.default_rng(seed)
    solids = [solid(rng, count > 100) for _ in range(count)]
    made = SpatialWorld.of(
        solids, ground=0.0, bounds=(0, 0, 500, 500), core_radius=0.5, core_half_height=0.3,
        band=HeightBand(lowest=2.0, highest=100.0),
    )  # fmt: skip
    while True:
        ends = rng.uniform((10, 10, 5), (490, 490, 60), (2, 3))
        apart = np.hypot(*(ends[1] - ends[0])[:2])
        if apart > 300 and made.distance(ends).min() > CLEARANCE + 0.1:
            return made, solids, ends[0], ends[1]


def shapes():
    for count, worlds in ((50, 40), (1000, 20)):
        times, ratios, kinds = [], [], []
        for seed in range(worlds):
            made, _, start, goal = world(count, seed)
            router = SpaceRouter(SearchRoom.of_world(made))
            if not seed:
                timed(router, start, goal, CLEARANCE)
            outcome, spent = timed(router, start, goal, CLEARANCE)
            times.append(spent)
            kinds.append(type(outcome))
            if isinstance(outcome, Found):
                ratios.append(outcome.cost / math.dist(start, goal))
        refused = sum(issubclass(kind, Refusal) for kind in kinds)
        gave_up = sum(issubclass(kind, GaveUp) for kind in kinds)
        print(f"{count} solids, {worlds} worlds: {len(ratios)} found, {refused} refused, "
              f"{gave_up} gave up; {np.mean(ratios):.4f} of the straight line; "
              f"{quartiles(times)}")  # fmt: skip


def key_of(solid):
    """A solid as a mission has it."""
    if isinstance(solid, Prism):
        corners = [[float(x), float(y)] for x, y in solid.ring.loops[0]]
        outline = {"polygon": corners}
        if solid.ring.is_disc:
            outline = {"circle": {"center": corners[0], "radius": float(solid.ring.radius)}}
        return {**outline, "height_m": [float(solid.low), float(solid.high)]}
    ends = [float(x) for x in solid.first], [float(x) for x in solid.last]
    if ends[0] == ends[1]:
        return {"ball": {"center": ends[0], "radius": float(solid.radius)}}
    return {"capsule": {"from": ends[0], "to": ends[1], "radius": float(solid.radius)}}


def flights(fifty=20, thousand=10):
    """Whole missions in the worlds of ``shapes``."""
    import viaspline as vs

    robot = {
        "radius_m": 0.5, "half_height_m": 0.3, "clearance_m": CLEARANCE, "max_speed_mps": 10,
        "max_accel_mps2": 2, "max_climb_mps": 2.5, "max_descent_mps": 1.5,
    }  # fmt: skip
    for count, worlds in ((50, int(fifty)), (1000, int(thousand))):
        for optimise in ("length", "time"):
            times, ratios, taken, outcomes = [], [], 0.0, []
            for seed in (0, *range(worlds)):
                _, solids, start, goal = world(count, seed)
                mission = vs.Mission.model_validate({
                    "world": {"bounds": [0, 0, 500, 500], "ground": {"flat_m": 0},
                              "altitude": {"min_m": 2, "max_m": 100},
                              "known": [key_of(solid) for solid in solids]},
                    "robot": robot,
                    "route": {"start": start.tolist(), "goal": goal.tolist(),
                              "optimise": optimise},
                })  # fmt: skip
                begun = time.process_time()
                try:
                    plan = vs.plan(mission)
                except vs.PlanningError as error:
                    outcomes.append(type(error).__name__)
                    continue
                times.append(1e3 * (time.process_time() - begun))
                outcomes.append("proven" if plan.certificate.holds else "NOT PROVEN")
                ratios.append(plan.path.length / math.dist(start, goal))
                taken += plan.trajectory.duration
            counted = {kind: outcomes[1:].count(kind) for kind in sorted(set(outcomes))}
            print(f"{count} solids, by {optimise}: {counted}; {np.mean(ratios[1:]):.4f} of the "
                  f"straight line, {taken:.1f} s flown; {quartiles(times[1:])}")  # fmt: skip


def fastest():
    """The route found under the norm of time, beside those on each side of what it bends at."""
    worse = []
    for seed in range(20):
        made, solids, start, goal = world(50, seed)
        router = SpaceRouter(SearchRoom.of_world(made))
        fast = router.find(start, goal, CLEARANCE, SPEEDS)
        short = router.find(start, goal, CLEARANCE)
        straight = np.linspace(start, goal, 400)
        met = {int(i) for d, i in zip(*made.nearest(straight), strict=True) if d < CLEARANCE}
        best = math.inf
        for i in sorted(met):
            if i < len(solids):
                found = seeds(router, solids[i], start, goal, CLEARANCE, SPEEDS)
                best = min([best, *(seed.route.cost for seed in found)])
        of_short = float(way_cost(np.array(SPEEDS), np.array(short.value.points)))
        worse.append((fast.cost / best if math.isfinite(best) else 1.0, of_short / fast.cost))
    found = np.array(worse)
    print(
        f"fastest route / fastest side: most {found[:, 0].max():.5f}, mean {found[:, 0].mean():.5f}"
    )
    print(f"time of the shortest route / fastest: mean {found[:, 1].mean():.4f}, "
          f"most {found[:, 1].max():.4f}")  # fmt: skip


def ompl_length(made, start, goal, seconds):
    from ompl import base, geometric, util

    util.setLogLevel(util.LOG_ERROR)
    space = base.RealVectorStateSpace(3)
    bounds = base.RealVectorBounds(3)
    for axis, (low, high) in enumerate(((2, 498), (2, 498), (2, 100))):
        bounds.setLow(axis, low)
        bounds.setHigh(axis, high)
    space.setBounds(bounds)
    information = base.SpaceInformation(space)
    probe = np.empty((1, 3))

    from viaspline.kernels.space.space_distance import space_distances

    def is_valid(state):
        probe[0] = state[0], state[1], state[2]
        return bool(space_distances(made.packed, probe)[0][0] >= CLEARANCE)

    information.setStateValidityChecker(is_valid)
    information.setStateValidityCheckingResolution(0.002)
    information.setup()
    problem = base.ProblemDefinition(information)
    first, last = space.allocState(), space.allocState()
    for axis in range(3):
        first[axis], last[axis] = float(start[axis]), float(goal[axis])
    problem.setStartAndGoalStates(first, last)
    problem.setOptimizationObjective(base.PathLengthOptimizationObjective(information))
    planner = geometric.InformedRRTstar(information)
    planner.setProblemDefinition(problem)
    planner.setup()
    planner.solve(float(seconds))
    path = problem.getSolutionPath()
    return path.length() if path else math.inf


def ompl(worlds=4, seconds=10):
    from ompl import util

    util.RNG.setSeed(1)
    for seed in range(int(worlds)):
        made, _, start, goal = world(50, seed)
        router = SpaceRouter(SearchRoom.of_world(made))
        outcome, spent = timed(router, start, goal, CLEARANCE)
        other = ompl_length(made, start, goal, seconds)
        print(f"world {seed}: {outcome.cost:.2f} m in {spent:.1f} ms; InformedRRT* {other:.2f} m "
              f"in {seconds} s; ratio {outcome.cost / other:.4f}", flush=True)  # fmt: skip


if __name__ == "__main__":
    tables = {f.__name__: f for f in (voxels, plans, peers, memory, shapes, flights, fastest, ompl)}
    tables[sys.argv[1]](*sys.argv[2:])
