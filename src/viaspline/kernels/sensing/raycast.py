"""Range measurements: where beams from one place first meet a surface of a packed world.

Every obstacle within reach is projected onto the beams that can hit it, so the cost is that of the
obstacles in sight and not of beams times obstacles. Bounds and fences are lines on a map: beams
don't see them.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.distance import box_signed
from viaspline.kernels.world.grid_rows import is_blocked, to_cells
from viaspline.kernels.world.packed import PackedWorld

SAME_PLACE_M = 1e-9  # beams are tried a little beyond the angle that an obstacle covers [rad]


@inner
def _turned(angle: float) -> float:
    """The same direction as an angle in [0, 2 pi)."""
    turn = 2.0 * math.pi
    angle = angle % turn
    return angle if angle < turn else 0.0


@inner
def _first_beam(low: float, step: float) -> int:
    """The first beam at an angle of ``low`` or more from beam 0."""
    return max(0, math.ceil((low - SAME_PLACE_M) / step))


@inner
def _last_beam(high: float, step: float, beams: int) -> int:
    """The last beam at an angle of ``high`` or less from beam 0."""
    return min(beams - 1, math.floor((high + SAME_PLACE_M) / step))


@inner
def _shorten(ranges: Floats, beam: int, distance: float) -> None:
    if 0.0 <= distance < ranges[beam]:
        ranges[beam] = distance


@inner
def _cast_circle(
    rays: Floats, first: float, step: float, dx: float, dy: float, radius: float, ranges: Floats
) -> None:
    """Shorten the beams that hit a circle whose centre is at (dx, dy) from the sensor."""
    far = math.hypot(dx, dy)
    half = math.asin(radius / far) if far > radius else math.pi
    low = _turned(math.atan2(dy, dx) - half - first)
    for turn in range(2):
        start = low - turn * 2.0 * math.pi
        for beam in range(
            _first_beam(start, step), _last_beam(start + 2.0 * half, step, ranges.size) + 1
        ):
            along = dx * rays[beam, 0] + dy * rays[beam, 1]
            across = dx * rays[beam, 1] - dy * rays[beam, 0]
            squared = radius * radius - across * across
            if squared < 0.0:
                continue
            depth = math.sqrt(squared)
            _shorten(ranges, beam, along - depth if along >= depth else along + depth)


@inner
def _cast_edge(
    rays: Floats, first: float, step: float, ax: float, ay: float, bx: float, by: float,
    ranges: Floats,
) -> None:  # fmt: skip
    """Shorten the beams that hit the edge from (ax, ay) to (bx, by), seen from the sensor."""
    width = math.atan2(ax * by - ay * bx, ax * bx + ay * by)
    low = _turned(math.atan2(ay, ax) + min(width, 0.0) - first)
    ex = bx - ax
    ey = by - ay
    offset = ax * ey - ay * ex
    for turn in range(2):
        start = low - turn * 2.0 * math.pi
        for beam in range(
            _first_beam(start, step), _last_beam(start + abs(width), step, ranges.size) + 1
        ):
            slope = rays[beam, 0] * ey - rays[beam, 1] * ex
            if slope != 0.0:
                _shorten(ranges, beam, offset / slope)


@inner
def _cast_grid(world: PackedWorld, g: int, x: float, y: float, ray: Floats, reach: float) -> float:
    """Distance at which a ray from (x, y) meets a blocked cell of grid g, or ``reach`` [m]."""
    width = world.grid_shapes[g, 0]
    height = world.grid_shapes[g, 1]
    u, v = to_cells(world, g, x, y)
    ahead_u, ahead_v = to_cells(world, g, x + ray[0], y + ray[1])
    du = ahead_u - u
    dv = ahead_v - v
    enter = 0.0
    leave = reach
    for place, slope, size in ((u, du, width), (v, dv, height)):
        if slope == 0.0:
            if place < 0.0 or place > size:
                return reach
            continue
        near = -place / slope
        far = (size - place) / slope
        enter = max(enter, min(near, far))
        leave = min(leave, max(near, far))
    if enter >= leave:
        return reach
    column = min(max(math.floor(u + du * enter), 0), width - 1)
    row = min(max(math.floor(v + dv * enter), 0), height - 1)
    right = 1 if du > 0.0 else -1
    up = 1 if dv > 0.0 else -1
    at = enter
    while at < leave:
        if is_blocked(world, g, row, column):
            return at
        next_u = (column + (1 if du > 0.0 else 0) - u) / du if du != 0.0 else np.inf
        next_v = (row + (1 if dv > 0.0 else 0) - v) / dv if dv != 0.0 else np.inf
        if next_u <= next_v:
            column += right
            at = next_u
        else:
            row += up
            at = next_v
        if column < 0 or column >= width or row < 0 or row >= height:
            return reach
    return reach


@inner
def _cast_polygon(
    world: PackedWorld, p: int, x: float, y: float, rays: Floats, first: float, step: float,
    reach: float, ranges: Floats,
) -> None:  # fmt: skip
    for block in range(world.polygon_blocks[p], world.polygon_blocks[p + 1]):
        if box_signed(world.block_boxes, block, x, y) > reach:
            continue
        for e in range(world.block_edges[block], world.block_edges[block + 1]):
            edge = world.edges[e]
            _cast_edge(
                rays, first, step, edge[0] - x, edge[1] - y, edge[2] - x, edge[3] - y, ranges
            )


@kernel
def cast(
    world: PackedWorld, x: float, y: float, first: float, step: float, beams: int, reach: float
) -> Floats:
    """Distance from (x, y) to the first surface along each of some beams.

    Args:
        world: PackedWorld.
        x: Of the sensor [m].
        y: Of the sensor [m].
        first: Direction of beam 0, anticlockwise from x [rad].
        step: From each beam to the next, above 0 [rad].
        beams: How many there are; they span a full turn at most.
        reach: The length of a beam [m].

    Returns:
        (beams,) [m]; infinite where nothing is within reach.
    """
    rays = np.empty((beams, 2))
    for beam in range(beams):
        rays[beam, 0] = math.cos(first + beam * step)
        rays[beam, 1] = math.sin(first + beam * step)
    ranges = np.full(beams, reach)
    node = 0
    while node < world.leaf.size:
        if box_signed(world.boxes, node, x, y) >= reach:
            node = world.skip[node]
            continue
        obstacle = world.leaf[node]
        node += 1
        if obstacle < 0:
            continue
        slot = world.slot[obstacle]
        if world.kind[obstacle] == 0:
            circle = world.circles[slot]
            _cast_circle(rays, first, step, circle[0] - x, circle[1] - y, circle[2], ranges)
        elif world.kind[obstacle] == 1:
            _cast_polygon(world, slot, x, y, rays, first, step, reach, ranges)
        else:
            for beam in range(beams):
                ranges[beam] = _cast_grid(world, slot, x, y, rays[beam], ranges[beam])
    for beam in range(beams):
        if ranges[beam] >= reach:
            ranges[beam] = np.inf
    return ranges
