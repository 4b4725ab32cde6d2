"""Where beams from one place first meet the surface of a rounded ring.

A ring is projected onto the beams that can hit it, so the cost is that of the beams it covers. Its
surface is that of the discs about its vertices and of its edges moved outwards by its radius; what
of these lies inside of it is hit by no beam first.

Tested through ``kernels/world/test_shape``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.plane import box_signed
from viaspline.kernels.world.ring_distance import is_disc, radius_of

SLIP_RAD = 1e-9  # beams are tried a little beyond the angle that a ring covers


@inner
def _turned(angle: float) -> float:
    """A direction as an angle in [0, 2 pi)."""
    turn = 2.0 * math.pi
    angle = angle % turn
    return angle if angle < turn else 0.0


@inner
def _first_beam(low: float, step: float) -> int:
    """The first beam at an angle of ``low`` or more from beam 0."""
    return max(0, math.ceil((low - SLIP_RAD) / step))


@inner
def _last_beam(high: float, step: float, beams: int) -> int:
    """The last beam at an angle of ``high`` or less from beam 0."""
    return min(beams - 1, math.floor((high + SLIP_RAD) / step))


@inner
def _shorten(ranges: Floats, beam: int, distance: float) -> None:
    if 0.0 <= distance < ranges[beam]:
        ranges[beam] = distance


@inner
def _cast_disc(
    rays: Floats, first: float, step: float, dx: float, dy: float, radius: float, ranges: Floats
) -> None:
    """Shorten the beams that hit a disc whose centre is at (dx, dy) from the sensor."""
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
def _cast_offset_edge(
    rays: Floats, first: float, step: float, edge: Floats, radius: float, x: float, y: float,
    ranges: Floats,
) -> None:  # fmt: skip
    """Shorten the beams that hit a vertex's disc, or the edge from it moved to its right."""
    dx = edge[2] - edge[0]
    dy = edge[3] - edge[1]
    length = math.sqrt(dx * dx + dy * dy)
    right_x = radius * dy / length
    right_y = -radius * dx / length
    ax = edge[0] - x
    ay = edge[1] - y
    _cast_disc(rays, first, step, ax, ay, radius, ranges)
    _cast_edge(
        rays, first, step, ax + right_x, ay + right_y, ax + dx + right_x, ay + dy + right_y, ranges
    )


@inner
def cast_ring(
    world: PackedWorld, r: int, x: float, y: float, rays: Floats, first: float, step: float,
    reach: float, ranges: Floats,
) -> None:  # fmt: skip
    """Shorten the beams from (x, y) that hit ring r; see ``shape.cast_obstacle``."""
    radius = radius_of(world, r)
    if is_disc(world, r):
        center = world.heads[r]
        _cast_disc(rays, first, step, center[0] - x, center[1] - y, radius, ranges)
        return
    for block in range(world.ring_blocks[r], world.ring_blocks[r + 1]):
        if box_signed(world.block_boxes, block, x, y) > reach + radius:
            continue
        for e in range(world.block_edges[block], world.block_edges[block + 1]):
            edge = world.edges[e]
            if radius > 0.0:
                _cast_offset_edge(rays, first, step, edge, radius, x, y, ranges)
            else:
                _cast_edge(
                    rays, first, step, edge[0] - x, edge[1] - y, edge[2] - x, edge[3] - y, ranges
                )
