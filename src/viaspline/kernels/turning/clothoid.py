"""Turns with ramps: curvature rises evenly, stays, and falls evenly again.

A turn by the angle theta between two straight lines has the curvature 1/rho on an arc, and before
and after it ramps (clothoids) of the length l on which curvature changes from and to 0. Its lines
touch the circle of radius rho + shift about the middle of the arc, and the ramps begin ``lead``
before the feet of the perpendiculars on them, whatever theta is. A turn by less than l / rho has
no arc: its curvature rises to theta / l only.

Tested through ``kernels/turning/test_turn_sequence``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cardinal_tangents import three_cubics
from viaspline.kernels.jit import inner, uncounted

MIN_TURN_RAD = 1e-9  # less than this is no turn [rad]
FULL_RAMP_SHARE = 0.95  # of the length that a turn without an arc needs for its ramps
MAX_SPAN_TURN_RAD = 0.4  # most that the heading changes along one span of three cubics [rad]
_AT = np.array([0.1834346424956498, 0.525532409916329, 0.7966664774136267, 0.9602898564975363])
_WEIGHT = np.array(
    [0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763]
)  # Gauss-Legendre of 8 points


@inner
def along_ramp(sharpness: float, distance: float) -> tuple[float, float]:
    """Where a ramp from the origin along x is after a distance [m].

    Args:
        sharpness: Change of curvature per metre [1/m²].
        distance: [m], with a heading of at most about 1 rad.
    """
    x = 0.0
    y = 0.0
    half = 0.5 * distance
    for k in range(4):
        for side in (-1.0, 1.0):
            s = half * (1.0 + side * _AT[k])
            heading = 0.5 * sharpness * s * s
            x += _WEIGHT[k] * math.cos(heading)
            y += _WEIGHT[k] * math.sin(heading)
    return half * x, half * y


@inner
def ramp_end(heading: float) -> tuple[float, float]:
    """Where a ramp of length 1 ends that begins at the origin along x: Fresnel's series.

    Args:
        heading: In which it ends [rad], at most about 1.5.
    """
    square = heading * heading
    x, y = 0.0, 0.0
    for n in range(9, -1, -1):
        x = 1.0 / (4 * n + 1) - square / ((2 * n + 1) * (2 * n + 2)) * x
        y = 1.0 / (4 * n + 3) - square / ((2 * n + 2) * (2 * n + 3)) * y
    return x, heading * y


@inner
def arc_and_ramp(theta: float, rho: float, ramp: float) -> tuple[float, float]:
    """Radius of the arc of a turn and length of its ramps [m].

    An arc that would be a sliver is left out, and the ramps are as much longer.

    Args:
        theta: By how much it turns [rad], more than 0.
        rho: The least radius [m].
        ramp: Length of either ramp that is asked for [m].
    """
    longest = rho * theta
    if ramp >= longest:
        return ramp / theta, ramp
    return rho, longest if ramp > FULL_RAMP_SHARE * longest else ramp


@inner
def shape_of(theta: float, rho: float, ramp: float) -> tuple[float, float, float]:
    """What a turn looks like: (radius of its arc, shift, lead) [m].

    Args:
        theta: By how much it turns [rad], more than 0.
        rho: The least radius [m].
        ramp: Length of either ramp [m].
    """
    radius, ramp = arc_and_ramp(theta, rho, ramp)
    heading = 0.5 * ramp / radius
    x, y = ramp_end(heading)
    x, y = ramp * x, ramp * y
    return radius, y - radius * (1.0 - math.cos(heading)), x - radius * math.sin(heading)


@uncounted
def _node(x: float, y: float, heading: float, curvature: float, node: Floats) -> None:
    node[0], node[1], node[2], node[3] = x, y, heading, curvature


@uncounted
def turn_nodes(
    apex_x: float,
    apex_y: float,
    heading: float,
    turn: float,
    rho: float,
    ramp: float,
    nodes: Floats,
) -> int:
    """Places along a turn, between which spans are laid.

    Args:
        apex_x: Its middle [m].
        apex_y: The same.
        heading: There [rad].
        turn: Left is positive [rad], not 0.
        rho: The least radius [m].
        ramp: Length of either ramp [m].
        nodes: Room for rows x, y, heading, curvature; filled.

    Returns:
        The number of nodes, an odd one: the apex is the middle one.
    """
    side = 1.0 if turn > 0.0 else -1.0
    theta = abs(turn)
    radius, ramp = arc_and_ramp(theta, rho, ramp)
    on_ramp = 0.5 * ramp / radius
    on_arc = max(0.5 * theta - on_ramp, 0.0)
    arcs = math.ceil(on_arc / MAX_SPAN_TURN_RAD - 1e-9)
    ramps = max(1, math.ceil(on_ramp / MAX_SPAN_TURN_RAD))
    half = arcs + ramps
    center_x = apex_x - side * radius * math.sin(heading)
    center_y = apex_y + side * radius * math.cos(heading)
    _node(apex_x, apex_y, heading, side / radius, nodes[half])
    for way in (-1.0, 1.0):
        step = int(way)
        for k in range(1, arcs + 1):
            at = heading + way * side * on_arc * k / arcs
            _node(
                center_x + side * radius * math.sin(at), center_y - side * radius * math.cos(at),
                at, side / radius, nodes[half + step * k],
            )  # fmt: skip
        # the ramp, from its flat end: its frame looks back along the path after the apex
        end = heading + way * side * (on_arc + on_ramp)
        far_x, far_y = along_ramp(1.0 / (radius * ramp), ramp)
        joint = heading + way * side * on_arc
        joint_x = center_x + side * radius * math.sin(joint)
        joint_y = center_y - side * radius * math.cos(joint)
        ux, uy = -way * math.cos(end), -way * math.sin(end)  # from the flat end to the apex
        vx, vy = -side * math.sin(end), side * math.cos(end)  # to the inside of the turn
        flat_x = joint_x - far_x * ux - far_y * vx
        flat_y = joint_y - far_x * uy - far_y * vy
        for k in range(ramps):
            s = ramp * k / ramps
            x, y = along_ramp(1.0 / (radius * ramp), s)
            bent = 0.5 * s * s / (radius * ramp)
            _node(
                flat_x + x * ux + y * vx, flat_y + x * uy + y * vy, end - way * side * bent,
                side * s / (radius * ramp), nodes[half + step * (half - k)],
            )  # fmt: skip
    return 2 * half + 1


@inner
def turn_length(turn: float, rho: float, ramp: float) -> float:
    """Length of a turn [m]."""
    theta = abs(turn)
    if theta < MIN_TURN_RAD:
        return 0.0
    radius, ramp = arc_and_ramp(theta, rho, ramp)
    return ramp + radius * theta


@inner
def spans_between(nodes: Floats, count: int, lengths: Floats, polygons: Floats) -> None:
    """Spans of three cubics from node to node, which take over heading and curvature.

    Args:
        nodes: x, y, heading, curvature, (count, 4).
        count: Their number.
        lengths: From each node to the next [m], (count - 1,).
        polygons: (3 (count - 1), 4, 2), filled.
    """
    ends = np.empty((6, 2))
    for k in range(count - 1):
        length = lengths[k]
        for i in range(2):
            x, y, heading, curvature = nodes[k + i]
            c, s = math.cos(heading), math.sin(heading)
            ends[i, 0], ends[i, 1] = x, y
            ends[2 + i, 0], ends[2 + i, 1] = length * c, length * s
            bend = length * length * curvature
            ends[4 + i, 0], ends[4 + i, 1] = -bend * s, bend * c
        three_cubics(
            ends[0], ends[1], ends[2], ends[3], ends[4], ends[5], polygons[3 * k : 3 * k + 3]
        )
