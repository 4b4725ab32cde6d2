"""Narrow places on the way between two places, and straight lines on which a body gets through.

A search among poses looks at few headings and many places: before a door that is hardly wider than
the body it sees everything there is before one of its poses happens to be straight before it. So
the way of the body's inner disc is looked along for such places first.

Tested through ``planning/turning/hybrid_astar/test_narrow_places``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.turning.hybrid_astar.pose_nodes import Ahead
from viaspline.planning.turning.hybrid_astar.search_outcome import Pose
from viaspline.planning.turning.hybrid_astar.search_window import SearchWindow
from viaspline.world.world import World

NARROW_REACH = 0.5  # what a narrow place is wider than the body at most, in the body's reach
MAX_MARCHES = 60  # on a line to the opposite wall,
MARCHED_TO = 1e-3  # that end so near to it, in distances that the body keeps
BEFORE = 3  # cells of the way, before and after a place, between which its direction is taken
SIDEWAYS = np.radians(np.linspace(30.0, 150.0, 13))[:, None]  # to it, of what is looked at beside
AS_NARROW = 1.02  # of the narrowest place near by, of those that are as narrow
LINE_ANGLES = np.radians(np.linspace(-20.0, 20.0, 17))  # to the walls, that are tried,
LINE_OFFSETS = np.linspace(-0.4, 0.4, 9)  # beside the middle, in the room that there is
LINE_SHARES = (1.0, 0.6, 0.3, 0.0)  # of a line on which the whole body gets through
LINE_PLACES = 9  # along it, at which the body is looked at to choose it


@dataclass(frozen=True)
class Passage:
    """A straight line on which a body gets through a narrow place.

    Attributes:
        enter: Where it begins.
        leave: Where it ends.
        width: The room between the walls of the place [m].
    """

    enter: Pose
    leave: Pose
    width: float


def passages(window: SearchWindow, ahead: Ahead, start: Floats) -> tuple[Passage, ...]:
    """The narrow places on the shortest way from a place, as they follow each other.

    Args:
        window: Where, and for which body.
        ahead: How far it is to where the way leads.
        start: Where it begins [m], (2,).

    Returns:
        None for a place that no straight line leads the body through.
    """
    way = _way(ahead, start)
    reach = window.body.reach
    if len(way) < 2:
        return ()
    limit = 2.0 * window.body.inner + NARROW_REACH * reach
    middles, axes, widths = _across(window.world, way, limit, window.body.inner)
    along = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))))
    inside = (along > reach) & (along < along[-1] - reach)
    found = []
    widths[~inside] = np.inf
    for k in _narrowest(widths, middles, along, reach):
        line = _line(window, middles[k], float(axes[k]), float(widths[k]))
        found += [] if line is None else [line]
    return tuple(found)


def _way(ahead: Ahead, start: Floats) -> Floats:
    """The middles of the cells on the shortest way (n, 2); none where there is none."""
    x0, y0, side, _ = ahead.frame.tolist()
    lengths = np.pad(ahead.lengths, 1, constant_values=np.inf)
    row, column = (int((start[1] - y0) // side) + 1, int((start[0] - x0) // side) + 1)
    cells = []
    while 0 < row < lengths.shape[0] - 1 and 0 < column < lengths.shape[1] - 1:
        cells.append((column - 0.5, row - 0.5))
        around = lengths[row - 1 : row + 2, column - 1 : column + 2]
        least = int(np.argmin(around))
        if not around.flat[least] < lengths[row, column]:
            break
        row, column = row + least // 3 - 1, column + least % 3 - 1
    way: Floats = np.array([x0, y0]) + side * np.array(cells).reshape(-1, 2)
    return way


def _across(world: World, way: Floats, limit: float, kept: float) -> tuple[Floats, Floats, Floats]:
    """What is nearest on either side of a way: the middle between, the axis, and the room.

    Args:
        world: Its walls.
        way: (n, 2) [m].
        limit: From which on it isn't narrow [m].
        kept: What the body keeps [m].

    Returns:
        Middles (n, 2), headings across the line from wall to wall (n,) [rad], and the room (n,),
        inf beyond the limit.
    """
    before, after = np.roll(way, BEFORE, axis=0), np.roll(way, -BEFORE, axis=0)
    before[:BEFORE], after[-BEFORE:] = way[0], way[-1]
    headings = np.arctan2(*(after - before)[:, ::-1].T)
    left, right = (
        _nearest_hit(world, way, headings + side * SIDEWAYS, limit, kept) for side in (1.0, -1.0)
    )
    across = left - right
    widths = np.linalg.norm(across, axis=1)
    widths[~(widths < limit)] = np.inf
    middles: Floats = 0.5 * (left + right)
    return middles, np.arctan2(-across[:, 0], across[:, 1]), widths


def _nearest_hit(world: World, way: Floats, headings: Floats, limit: float, kept: float) -> Floats:
    """The nearest of what rays from places (n, 2) hit; NaN where that is farther than a limit [m].

    One ray away from what is nearest, as ``kernels/routing/narrow_gaps`` has it, goes past the end
    of a wall that is thinner than a cell.

    Args:
        world: Its walls.
        way: The places [m].
        headings: Of the rays [rad], (rays, n).
        limit: [m].
        kept: What the body keeps [m].
    """
    rays = np.stack((np.cos(headings), np.sin(headings)), axis=-1)
    near = np.maximum(world.distance(way), 0.0)
    far = np.tile(near, (len(headings), 1))
    under_way = far < limit
    for _ in range(MAX_MARCHES):
        at = np.nonzero(under_way)
        gaps = world.distance(way[at[1]] + far[at][:, None] * rays[at])
        far[at] += np.maximum(gaps, 0.0)
        under_way[at] = (gaps > MARCHED_TO * kept) & (far[at] < limit)
        if not under_way.any():
            break
    least = far.argmin(axis=0)
    one = np.arange(len(way))
    hits: Floats = way + far[least, one][:, None] * rays[least, one]
    hits[far[least, one] >= limit] = np.nan
    return hits


def _narrowest(widths: Floats, middles: Floats, along: Floats, reach: float) -> list[int]:
    """Where a way is narrower than it is before and after, in long corridors at both ends.

    Args:
        widths: The room at places of the way [m], (n,); inf where it doesn't count.
        middles: Of the lines across [m], (n, 2).
        along: How far along the way the places are [m], (n,).
        reach: Of the body [m].
    """
    near = np.abs(along[:, None] - along) < reach
    least = np.where(near, widths, np.inf).min(axis=1)
    at = np.flatnonzero(np.isfinite(widths) & (widths <= AS_NARROW * least))
    steps = np.linalg.norm(np.diff(middles[at], axis=0), axis=1)
    is_other = (steps > reach) | (np.abs(np.diff(widths[at])) > (AS_NARROW - 1.0) * least[at[1:]])
    chosen: list[int] = []
    for run in np.split(at, np.flatnonzero(is_other) + 1) if len(at) else []:
        first, last = int(run[0]), int(run[-1])
        is_long = np.linalg.norm(middles[last] - middles[first]) > 2.0 * reach
        chosen += [first, last] if is_long else [int(run[len(run) // 2])]
    return chosen


def _line(window: SearchWindow, middle: Floats, heading: float, width: float) -> Passage | None:
    """The straight line through a narrow place on which a body keeps farthest from everything.

    Args:
        window: Where, and for which body.
        middle: Of the place [m], (2,).
        heading: About that of its walls [rad].
        width: The room between them [m].
    """
    discs = window.body.discs
    front = float((discs[:, 0] + discs[:, 2]).max())
    rear = float((discs[:, 0] - discs[:, 2]).min())
    headings = np.repeat(heading + LINE_ANGLES, len(LINE_OFFSETS))
    offsets = np.tile(width * LINE_OFFSETS, len(LINE_ANGLES))
    for share in LINE_SHARES:
        centre = -0.5 * (front + rear)
        half = 0.5 * share * (front - rear)
        rooms = _rooms(window, middle, headings, offsets, (centre - half, centre + half))
        best = int(np.argmax(rooms))
        if rooms[best] > 0.0:
            c, s, aside = math.cos(headings[best]), math.sin(headings[best]), offsets[best]
            x, y = middle[0] - s * aside, middle[1] + c * aside
            enter, leave = (
                Pose(float(x + c * t), float(y + s * t), float(headings[best]))
                for t in (centre - half, centre + half)
            )
            if all(window.has_room(pose.x, pose.y, pose.heading) for pose in (enter, leave)):
                return Passage(enter, leave, width)
    return None


def _rooms(
    window: SearchWindow, middle: Floats, headings: Floats, offsets: Floats,
    ends: tuple[float, float],
) -> Floats:  # fmt: skip
    """By how much a body keeps more than it has to on lines through a place [m], (n,).

    Args:
        window: Where, and for which body.
        middle: The place [m], (2,).
        headings: Of the lines [rad], (n,).
        offsets: By how much they pass to the left of the place [m], (n,).
        ends: Between which places of them the reference point moves [m].
    """
    x, y, kept = window.body.discs.T
    forward = (np.linspace(*ends, LINE_PLACES)[:, None] + x)[None]  # lines, places, discs
    aside = offsets[:, None, None] + y
    c, s = np.cos(headings)[:, None, None], np.sin(headings)[:, None, None]
    points = np.stack((c * forward - s * aside, s * forward + c * aside), axis=-1)
    rooms: Floats = (window.world.distance(middle + points) - kept).min(axis=(1, 2))
    return rooms
