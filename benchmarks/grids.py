"""Maps of 500 x 500 cells, a fifth of them blocked in blobs, beside tcod's A*.

    pip install ".[bench]" && python benchmarks/grids.py [ROUNDS]

Both search a map that is ready: tcod its graph, viaspline its mesh. What making the mesh takes is
told apart, and so is all of a plan: world, mesh, route, spline, certificate, time law.
"""

from __future__ import annotations

import sys

import numpy as np
import shapely
import tcod
from scipy.ndimage import gaussian_filter, label
from timing import in_turn
from worlds import length

import viaspline as vs
from viaspline.maps.grid import Grid
from viaspline.planning.routing.route_problem import NO_BARRIERS
from viaspline.planning.routing.router import Router

SIDE, BLOCKED, BLUR, ENDS = 500, 0.2, 6.0, 20  # cells; the two corners are free
RADIUS = 0.1  # of the robot, in cells
START, GOAL = (5, 5), (494, 494)
THETA = 704.2  # median length of python-motion-planning's Theta* on these maps, corners and all


def blobs(seed: int, side: int = SIDE) -> np.ndarray:
    """True where blocked: the highest places of blurred noise, (side, side)."""
    noise = np.random.default_rng(seed).standard_normal((side, side))
    height = gaussian_filter(noise, BLUR)
    cells = height > np.quantile(height, 1.0 - BLOCKED)
    cells[:ENDS, :ENDS] = cells[-ENDS:, -ENDS:] = False
    return cells


def maps(count: int):
    """The first seeds where start and goal are joined."""
    seed = 0
    while count:
        cells = blobs(seed)
        areas, _ = label(~cells)
        if areas[START] == areas[GOAL]:
            count -= 1
            yield seed, cells
        seed += 1


def mission(cells: np.ndarray, start, goal, radius: float = RADIUS) -> vs.Mission:
    """From the middle of one cell (row, column) to that of another."""
    grid = Grid(cells, 1.0)
    return vs.Mission.model_validate(
        {
            "world": {"bounds": grid.extent, "known": [vs.Obstacle(grid=grid)]},
            "robot": {"radius_m": radius, "clearance_m": 0},
            "route": {"start": middle(start), "goal": middle(goal)},
        }
    )


def middle(cell) -> tuple[float, float]:
    row, column = cell
    return (column + 0.5, row + 0.5)


class Prepared:
    """A map on which routes are found one after the other."""

    def __init__(self, world: vs.World, radius: float, places) -> None:
        self.router = Router(world, radius, np.array(places, float))
        self.none = np.zeros(len(world), bool)
        _ = self.router.lattice.mesh

    def route(self, start, goal):
        return self.router.find(
            np.array(start, float), np.array(goal, float), NO_BARRIERS, self.none.copy()
        ).value


def tcod_graph(cells: np.ndarray):
    cost = np.where(cells, 0, 1).astype(np.int8)
    return tcod.path.SimpleGraph(cost=cost, cardinal=70, diagonal=99, greed=1)


def tcod_path(graph, start, goal):
    finder = tcod.path.Pathfinder(graph)
    finder.add_root(start)
    return finder.path_to(goal)


def corners_cut(path: np.ndarray, cells: np.ndarray) -> int:
    """Diagonal steps of a path (row, column) past the very corner of a blocked cell."""
    (r0, c0), (r1, c1) = path[:-1].T, path[1:].T
    return int((cells[r0, c1] | cells[r1, c0]).sum())


def squares(cells: np.ndarray) -> shapely.STRtree:
    y, x = np.nonzero(cells)
    return shapely.STRtree(shapely.box(x, y, x + 1, y + 1))


def entered(points: np.ndarray, tree: shapely.STRtree) -> int:
    """How many blocked cells a polyline gets into by more than 1e-6."""
    line = shapely.linestrings(points)
    met = tree.geometries[tree.query(line, predicate="intersects")]
    return int((shapely.length(shapely.intersection(line, met)) > 1e-6).sum())


def room(points: np.ndarray, tree: shapely.STRtree) -> float:
    """Least distance of points to blocked cells."""
    _, gaps = tree.query_nearest(
        shapely.points(points), max_distance=1.0, return_distance=True, all_matches=False
    )
    return float(gaps.min())


def main(rounds: int) -> None:
    names = ("tcod A*", "route, prepared", "preparing", "whole plan")
    spent: dict[str, list[float]] = {name: [] for name in names}
    lengths: dict[str, list[float]] = {"tcod": [], "viaspline": []}
    inside, certified, cut, rooms = {"tcod": 0, "viaspline": 0}, 0, 0, []
    for seed, cells in maps(5):
        task = mission(cells, START, GOAL)
        places = middle(START), middle(GOAL)
        world = vs.World.known(task)
        graph, ready = tcod_graph(cells), Prepared(world, RADIUS, places)
        times, found = in_turn(
            {
                "tcod A*": lambda graph=graph: tcod_path(graph, START, GOAL),
                "route, prepared": lambda ready=ready, places=places: ready.route(*places),
                "preparing": lambda world=world, places=places: Prepared(world, RADIUS, places),
                "whole plan": lambda task=task: vs.plan(task),
            },
            rounds,
        )
        for name in names:
            spent[name].append(1e3 * times[name])
        plan = found["whole plan"]
        certified += plan.certificate.holds
        steps = found["tcod A*"][:, ::-1] + 0.5
        points = plan.path.evaluate(np.linspace(0, len(plan.path.spans), 100_001))
        tree = squares(cells)
        cut += corners_cut(found["tcod A*"], cells)
        for name, path in (("tcod", steps), ("viaspline", points)):
            lengths[name].append(length(path))
            inside[name] += entered(path, tree)
        lengths["viaspline"][-1] = plan.path.length
        rooms.append(room(points, tree))
        each = ", ".join(f"{name} {spent[name][-1]:.2f} ms" for name in names)
        both = f"{lengths['viaspline'][-1]:.1f}, tcod's {lengths['tcod'][-1]:.1f}"
        print(f"seed {seed}: {each}; length {both}")
    base = np.array(spent["tcod A*"])
    for name in names:
        ratio = float(np.median(base / np.array(spent[name])))
        print(f"{name:16s} median {np.median(spent[name]):8.2f} ms   tcod / this {ratio:6.2f}")
    print(f"certified: {certified} of {len(rooms)}; least distance by shapely {min(rooms):.6f}")
    print(f"corners cut by tcod: {cut}")
    for name, values in lengths.items():
        print(f"{name:10s} length median {np.median(values):.1f} (Theta* {THETA}), "
              f"blocked cells entered: {inside[name]}")  # fmt: skip


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 7)
