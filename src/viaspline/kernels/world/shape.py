"""What is asked of an obstacle, whichever kind it is: the only file that tells the kinds apart.

Six questions: how far a point is from it, and a segment; where beams meet it; what a path can bend
round (corners, as features of a taut string and as fans of a tangent graph); which cells of a
lattice it covers; and whether a part of it lies inside a body. A further kind of obstacle answers
them in a file of its own and stands in each of these functions.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Bytes, Floats
from viaspline.kernels.jit import inlined, uncounted
from viaspline.kernels.world.corner_fans import ring_fans
from viaspline.kernels.world.grid_cover import grid_enclosed, grid_features
from viaspline.kernels.world.grid_rays import grid_range
from viaspline.kernels.world.grid_rows import grid_signed
from viaspline.kernels.world.grid_segment import grid_segment
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.plane import covers
from viaspline.kernels.world.ring_distance import is_disc, mark_disc, ring_segment, ring_signed
from viaspline.kernels.world.ring_features import ring_features
from viaspline.kernels.world.ring_rays import cast_ring


@inlined
def is_ring(world: PackedWorld, i: int) -> bool:
    """Whether obstacle i is a rounded ring; else it is a grid."""
    return world.slot[i] >= 0


@inlined
def grid_of(world: PackedWorld, i: int) -> int:
    """The number of the grid that obstacle i is."""
    return -1 - world.slot[i]


@inlined
def obstacle_signed(world: PackedWorld, i: int, x: float, y: float, limit: float) -> float:
    """Signed distance from (x, y) to obstacle i [m]."""
    slot = world.slot[i]
    if slot >= 0:
        return ring_signed(world, slot, x, y, limit)
    return grid_signed(world, -1 - slot, x, y, limit)


@inlined
def obstacle_segment(
    world: PackedWorld, i: int, ax: float, ay: float, bx: float, by: float, limit: float
) -> float:
    """Distance between obstacle i and the segment a-b [m].

    Not above 0 where the segment touches it or lies inside of it.
    """
    slot = world.slot[i]
    if slot >= 0:
        return ring_segment(world, slot, ax, ay, bx, by, limit)
    return grid_segment(world, -1 - slot, ax, ay, bx, by, limit)


@uncounted
def cast_obstacle(
    world: PackedWorld, i: int, x: float, y: float, rays: Floats, first: float, step: float,
    reach: float, ranges: Floats,
) -> None:  # fmt: skip
    """Shorten the beams from (x, y) that obstacle i stops.

    Args:
        world: PackedWorld.
        i: The obstacle.
        x: Of the sensor [m].
        y: Of the sensor [m].
        rays: Unit vectors of the beams, (b, 2).
        first: Direction of beam 0 [rad].
        step: From each beam to the next [rad].
        reach: The length of a beam [m].
        ranges: Where each beam ends, so far [m], (b,); shortened in place.
    """
    slot = world.slot[i]
    if slot >= 0:
        cast_ring(world, slot, x, y, rays, first, step, reach, ranges)
        return
    for beam in range(ranges.size):
        ranges[beam] = grid_range(world, -1 - slot, x, y, rays[beam], ranges[beam])


@uncounted
def obstacle_features(
    world: PackedWorld, i: int, x: float, y: float, reach: float, out: Floats, count: int
) -> int:
    """Append what a taut string can lie against within ``reach`` of (x, y) [m].

    Columns are those of ``ring_features``; rows beyond the room are counted and not written.
    """
    slot = world.slot[i]
    if slot >= 0:
        return ring_features(world, slot, x, y, reach, out, count)
    return grid_features(world, -1 - slot, x, y, reach, out, count)


@uncounted
def obstacle_corners(
    world: PackedWorld, i: int, rho: float, step: float, corners: Floats, count: int
) -> int:
    """Append the corners of obstacle i to ``corners`` from row ``count`` on; a grid has none here.

    Args:
        world: PackedWorld.
        i: The obstacle.
        rho: Distance that the route keeps from it [m].
        step: Largest turn at one corner [rad].
        corners: Room for them, (size, 8).
        count: Rows that are taken.

    Returns:
        The new count; where it is more than the room there is, call again with more.
    """
    slot = world.slot[i]
    return ring_fans(world, slot, rho, step, corners, count) if slot >= 0 else count


@uncounted
def mark_obstacle(
    world: PackedWorld, i: int, x: float, y: float, side: float, reach: float, cells: Bytes
) -> bool:
    """Block the cells whose middle is nearer than ``reach`` to obstacle i, if it knows a short way.

    Returns:
        Whether it did; if not, ask ``obstacle_signed`` cell by cell.
    """
    slot = world.slot[i]
    if slot >= 0 and is_disc(world, slot):
        mark_disc(world, slot, x, y, side, reach, cells)
        return True
    return False


@uncounted
def obstacle_enclosed(
    world: PackedWorld, i: int, body: Floats, outer: float, x: float, y: float, c: float, s: float
) -> tuple[bool, float, float]:
    """Whether a part of obstacle i lies inside a body, and a point of it [m]; see ``enclosed``."""
    slot = world.slot[i]
    if slot < 0:
        return grid_enclosed(world, -1 - slot, body, outer, x, y, c, s)
    vertex = world.heads[slot]
    return covers(body, x, y, c, s, vertex[0], vertex[1]), vertex[0], vertex[1]
