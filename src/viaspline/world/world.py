"""What the robot keeps clear of: an immutable set of obstacles inside bounds."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.errors import GeometryError
from viaspline.handed_in import all_of, numbers_from
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.world import distance as kernels
from viaspline.kernels.world.clusters import group_labels
from viaspline.kernels.world.packed import PackedWorld
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle, Side
from viaspline.mission.strip import corridor_rings
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.shown_value import ShownValue
from viaspline.world.handed_places import Bounds, Ring, checked_bounds, checked_rings, flat_places
from viaspline.world.outline import outline
from viaspline.world.pack import Rings, discs_at_end, join, pack, pack_discs
from viaspline.world.tree_growth import leaf_boxes

NOTHING = -1  # the index of what is nearest in an empty world
BOUNDS = -2  # what stands for the bounds where an index names what is nearest; fences follow


class World(ShownValue, ComparedByValue):
    """Circles, polygons, grids, and the bounds and fences that the robot stays inside of.

    The distance to the world is the smallest of the signed distances to all of them:
    exact outside of all of them, and inside the depth in the obstacle that is entered deepest.
    A grid is the union of its blocked squares, and nothing beyond its rectangle; worlds of the
    same map share what is reckoned once of it, 4 bytes a square.

    Args:
        obstacles: What is known.
        bounds: ``x_min, y_min, x_max, y_max`` [m], or None.
        fences: Rings that the robot stays inside of [m].
        corridor: One more, with the islands in it: its outer ring, then its holes [m].

    Example:
        >>> world = World([Obstacle(circle={"center": (0, 0), "radius": 2})], bounds=(-9, -9, 9, 9))
        >>> world.distance([(5, 0), (1, 0), (8, 8)])
        array([ 3., -1.,  1.])
    """

    def __init__(
        self,
        obstacles: Iterable[Obstacle] = (),
        *,
        bounds: Sequence[float] | None = None,
        fences: Iterable[Sequence[tuple[float, float]]] = (),
        corridor: Iterable[Sequence[tuple[float, float]]] = (),
    ) -> None:
        self.obstacles: tuple[Obstacle, ...] = all_of(
            "obstacles", obstacles, Obstacle, "give Obstacle(circle={...}), or World.known(mission)"
        )
        for i, obstacle in enumerate(self.obstacles):
            if obstacle.motion is not None:
                problem = f"obstacle {i} moves, and a World stands still"
                raise GeometryError(f"{problem}; give it to MovingObstacles")
        self.bounds: Bounds | None = None
        self.fences = checked_rings("fences", fences)
        self.corridor = checked_rings("corridor", corridor)
        if bounds is not None:
            self.bounds = checked_bounds(bounds)
        areas: list[Rings] = [(ring,) for ring in self.fences]
        if self.corridor:
            areas.append(self.corridor)
        self.packed: PackedWorld = pack(self.obstacles, self.bounds, areas)
        self._settled = len(self.obstacles)
        self._listed: tuple[int, ...] = ()
        self._sided = _sided(self.obstacles)

    @classmethod
    def known(cls, mission: Mission) -> World:
        """What the mission has on its map and doesn't move.

        Raises:
            GeometryError: The mission is one in space.
        """
        if mission.is_spatial:
            problem = "the mission has heights, and a World is flat"
            raise GeometryError(f"{problem}; hand the mission as a whole to plan(mission)")
        spec = mission.world
        corridor = corridor_rings(mission.route)
        world = cls(spec.standing, bounds=spec.bounds, fences=spec.fences, corridor=corridor)
        world._listed = tuple(i for i, one in enumerate(spec.known) if one.motion is None)
        return world

    @classmethod
    def everything(cls, mission: Mission) -> World:
        """What is there and doesn't move, on the map or not."""
        return cls.known(mission).with_obstacles(mission.world.unseen_standing)

    def with_obstacles(self, obstacles: Iterable[Obstacle]) -> World:
        """A world that has these obstacles too; they come after those that it has."""
        new = tuple(obstacles)
        more = tuple(len(self.obstacles) + i for i in _sided(new))
        return self._with(new, pack(new, None, ()), self._sided + more)

    def with_discs(self, discs: tuple[Obstacle, ...], rows: Floats) -> World:
        """As ``with_obstacles``, for discs without a side of their own that are arrays as well.

        Args:
            discs: They come after the obstacles that it has.
            rows: x, y and radius of each [m], shape (n, 3).
        """
        return self._with(discs, pack_discs(rows), self._sided)

    def _with(
        self, new: tuple[Obstacle, ...], packed: PackedWorld, sided: tuple[int, ...]
    ) -> World:
        world = self._copied()
        world.obstacles, world._sided = self.obstacles + new, sided
        world.packed, world._settled = join(self.packed, packed, self._settled)
        return world

    def with_side(self, index: int, side: Side) -> World:
        """A world with one obstacle that may be passed on this side only."""
        asked = self.obstacles[index].model_copy(update={"pass_on": side, "never_pass_on": None})
        world = self._copied()
        world.obstacles = (*self.obstacles[:index], asked, *self.obstacles[index + 1 :])
        world._sided = tuple(sorted({*self._sided, index}))
        return world

    def _copied(self) -> World:
        """One to be changed before anybody else sees it."""
        world = object.__new__(World)
        vars(world).update(vars(self))
        return world

    def listed_at(self, index: int) -> int:
        """Where an obstacle stands in the mission's list of what is known, moving ones counted.

        What came in afterwards, such as what was seen, goes on from the last of these.
        """
        if index < len(self._listed):
            return self._listed[index]
        past = self._listed[-1] + 1 - len(self._listed) if self._listed else 0
        return index + past

    def near(self, box: Bounds) -> World:
        """What of it reaches into a box [m], each obstacle by the name that it has in here.

        The bounds are left out if the box is inside of them.

        Example:
            >>> discs = [Obstacle(circle={"center": (x, 0), "radius": 1}) for x in (0, 5, 99)]
            >>> World(discs, bounds=(-9, -9, 200, 9)).near((4, -2, 120, 2)).names
            ('obstacle 2', 'obstacle 3')
        """
        x0, y0, x1, y1 = box
        boxes = leaf_boxes(self.packed)
        meets = (boxes[:, 0] <= x1) & (boxes[:, 2] >= x0) & (boxes[:, 1] <= y1)
        found = np.flatnonzero(meets & (boxes[:, 3] >= y0))
        bounds = self.bounds
        if bounds is not None and (bounds[0] < x0 and bounds[1] < y0):
            bounds = None if bounds[2] > x1 and bounds[3] > y1 else bounds
        named = tuple(
            obstacle
            if obstacle.name is not None or obstacle.grid is not None
            else obstacle.model_copy(update={"name": self.name(i)})
            for i, obstacle in ((i, self.obstacles[i]) for i in found.tolist())
        )
        rows, first = discs_at_end(self.packed, found, self._sided)
        world = World(named[:first], bounds=bounds, fences=self.fences, corridor=self.corridor)
        return world.with_discs(named[first:], rows)

    @property
    def sided(self) -> Ints:
        """Indices of the obstacles that ask for a side, (k,)."""
        return np.array(self._sided, np.int64)

    @property
    def discs(self) -> Floats:
        """The obstacles that are round about one place: x, y and radius [m], shape (k, 3)."""
        heads = self.packed.heads
        return np.ascontiguousarray(heads[heads[:, 3] == 1.0, :3])

    @property
    def are_maps(self) -> NDArray[np.bool_]:
        """Which obstacles are occupancy grids, (n,)."""
        return self.packed.slot < 0

    def places(self) -> tuple[Floats, Ints]:
        """A place of each obstacle that is no grid [m], (k, 2), and whose it is, (k,)."""
        return np.ascontiguousarray(self.packed.heads[:, :2]), np.flatnonzero(~self.are_maps)

    @property
    def enclosures(self) -> tuple[Ring, ...]:
        """The outer rings of the fences and of the corridor [m]."""
        return (*self.fences, *self.corridor[:1])

    def _said(self) -> tuple[object, ...]:
        return self.obstacles, self.bounds, self.fences, self.corridor, self._listed

    def __hash__(self) -> int:
        """Of little: searches keep what they have found by their world, and make many worlds."""
        return hash((len(self.obstacles), self.bounds))

    def __len__(self) -> int:
        return len(self.obstacles)

    def __repr__(self) -> str:
        return f"World({len(self)} obstacles, bounds={self.bounds}, {len(self.fences)} fences)"

    def name(self, index: int) -> str:
        """What an index of ``nearest`` is called."""
        if index == NOTHING:
            return "nothing"
        if index <= BOUNDS:
            if BOUNDS - index > len(self.fences):
                return "corridor"
            return "bounds" if index == BOUNDS else f"fence {BOUNDS - index}"
        return self.obstacles[index].called(self.listed_at(index))

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all obstacles."""
        return tuple(self.name(i) for i in range(len(self)))

    def distance(self, points: ArrayLike) -> NDArray[np.float64]:
        """Signed distance to the world [m], negative inside an obstacle or outside the bounds.

        Args:
            points: Shape (n, 2) or (2,); a third coordinate is allowed and plays no part.

        Returns:
            Shape (n,), or a scalar array for one point; infinite in an empty world.

        Raises:
            GeometryError: For other shapes, and for points that are not finite.
        """
        return self.nearest(points)[0]

    def nearest(self, points: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Signed distance [m] and what is nearest.

        Returns:
            (distance, index): the obstacle's index; -2 for the bounds, -3 - f for fence f, the
            corridor being the last (see ``name``); -1 in an empty world.
        """
        flat, shape = flat_places(points)
        distance, index = kernels.distances(self.packed, flat)
        return distance.reshape(shape), index.reshape(shape)

    def distances_to(self, index: int, points: ArrayLike) -> NDArray[np.float64]:
        """Signed distance of points to one obstacle [m], shape (n,).

        Raises:
            GeometryError: When there is no such obstacle; for points see ``distance``.
        """
        if not 0 <= index < len(self):
            raise GeometryError(f"there is no obstacle {index}; there are {len(self)}, from 0")
        flat, shape = flat_places(points)
        distance: NDArray[np.float64] = kernels.obstacle_distances(self.packed, index, flat)
        return distance.reshape(shape)

    def body_distance(
        self, positions: ArrayLike, headings: ArrayLike, footprint: ArrayLike
    ) -> NDArray[np.float64]:
        """Distance between a body and the world [m], exact but for rounding, in every pose.

        Args:
            positions: Where the reference point is [m], shape (n, 2) or (2,); a third coordinate
                plays no part.
            headings: Where x of the footprint points [rad], anticlockwise from x; shape (n,) or a
                number.
            footprint: The body in its own frame, (k, 2) [m]; see ``outline``.

        Returns:
            Shape (n,), or a scalar array for one position; 0 where the body touches or overlaps
            something, has something inside of it, or leaves the bounds or a fence; infinite in an
            empty world.

        Raises:
            GeometryError: For other shapes, numbers that are not finite, and a footprint that is
                no body.

        Example:
            >>> world = World([Obstacle(circle={"center": (5, 0), "radius": 1})])
            >>> body = [(-1, -0.5), (3, -0.5), (3, 0.5), (-1, 0.5)]
            >>> world.body_distance([(0, 0), (0, 0), (2, 0)], [0, np.pi, 0], body).round(9)
            array([1., 3., 0.])
        """
        return self.body_nearest(positions, headings, footprint)[0]

    def body_nearest(
        self, positions: ArrayLike, headings: ArrayLike, footprint: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Distance of a body from the world [m], and what is nearest to it, as in ``nearest``."""
        from viaspline.kernels.clearance.footprint_pose import body_distances

        flat, shape = flat_places(positions)
        angles = numbers_from("headings", headings)
        if angles.shape not in ((), shape) or not np.isfinite(angles).all():
            raise GeometryError(
                f"headings of shape {angles.shape} don't go with {shape} positions, or are not "
                "finite; give one for each"
            )
        poses = np.empty((len(flat), 3))
        poses[:, :2] = flat
        poses[:, 2] = angles.ravel()
        distance, index = body_distances(self.packed, poses, outline(footprint))
        return distance.reshape(shape), index.reshape(shape)

    def groups(self, width: float) -> tuple[tuple[int, ...], ...]:
        """Obstacles too close together for a body of this width [m] to pass between.

        Example:
            >>> discs = [Obstacle(circle={"center": (x, 0), "radius": 1}) for x in (0, 3, 9)]
            >>> World(discs).groups(2.0)
            ((0, 1), (2,))
        """
        members: dict[int, list[int]] = {}
        for i, label in enumerate(group_labels(self.packed, float(width)).tolist()):
            members.setdefault(label, []).append(i)
        return tuple(tuple(group) for group in members.values())


def _sided(obstacles: Iterable[Obstacle]) -> tuple[int, ...]:
    """Indices of those that ask for a side."""
    return tuple(i for i, one in enumerate(obstacles) if one.forced_side is not None)
