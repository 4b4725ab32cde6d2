"""How far the places of a strip may move across it, past what stands on either side."""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, kernel, uncounted
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld

SAMPLES = 6  # about a place, from half-way to the one before to half-way to the one after
REACH = 16.0  # in required distances: farther off, nothing is looked for
FINER_ROUNDS, FINER = 4, 0.3  # of looking for the least distance; of the step from one to the next
NEAR = 1.2  # in required distances: where it is looked for so
FAR = 4.0  # of that: farther off need not be told apart
LEAST_REACH = 0.5  # in required distances, that a place may move at once
PROBE_M = 1e-5
ACROSS = 0.5  # in required distances: so far on the other side it is looked for what is there
ALONE = 0.9  # of the distance that is won by going there, where nothing is
LEAST_SLOPE = 0.05  # of a distance, across the path, of what stands beside it


@inlined
def _on_strip(spans: Floats, at: float) -> tuple[float, float]:
    """A place on a curve [m]; before its start and after its end that."""
    k = min(max(math.floor(at), 0), spans.shape[0] - 1)
    w = min(max(at - k, 0.0), 1.0)
    v = 1.0 - w
    a, b, c, d = v * v * v, 3.0 * v * v * w, 3.0 * v * w * w, w * w * w
    x = a * spans[k, 0, 0] + b * spans[k, 1, 0] + c * spans[k, 2, 0] + d * spans[k, 3, 0]
    y = a * spans[k, 0, 1] + b * spans[k, 1, 1] + c * spans[k, 2, 1] + d * spans[k, 3, 1]
    return x, y


@inlined
def _gap(
    world: PackedWorld, spans: Floats, off: tuple[float, float], at: float, limit: float
) -> float:  # fmt: skip
    """Distance from so far off a place on a curve to what stands there, at most a limit [m]."""
    x, y = _on_strip(spans, at)
    gap, _ = nearest(world, x + off[0], y + off[1], limit)
    return gap


@inlined
def _least_about(
    world: PackedWorld, spans: Floats, off: tuple[float, float], j: int, gap: float,
    steps: tuple[float, float], near: float,
) -> tuple[float, float]:  # fmt: skip
    """The least distance about place j [m], and the parameter where it is: exact if it is near.

    Args:
        world: What stands there.
        spans: The curve through the places [m], (n - 1, 4, 2).
        off: From where that curve is to from where it is looked [m].
        j: The place.
        gap: Distance from there [m].
        steps: From the place before and to the one after [m].
        near: Less than that is near [m].
    """
    least, at, middle = gap, float(j), gap
    for i in range(SAMPLES + 1):
        share = i / SAMPLES - 0.5
        if middle - abs(share) * (steps[0] if share < 0.0 else steps[1]) > near:
            continue  # whatever is there, it isn't near
        here = j + share
        gap = _gap(world, spans, off, here, least)
        if gap < least:
            least, at = gap, here
    step = 1.0 / SAMPLES
    for _ in range(FINER_ROUNDS):
        if least > near:
            break
        before = _gap(world, spans, off, at - step, FAR * near)
        after = _gap(world, spans, off, at + step, FAR * near)
        bend = before - 2.0 * least + after
        far = 0.5 * (before - after) / bend if bend > 0.0 else math.copysign(1.0, before - after)
        here = at + step * min(max(far, -1.0), 1.0)
        gap = _gap(world, spans, off, here, least)
        if gap < least:
            least, at = gap, here
        step *= FINER
    return least, at


@inlined
def _least_sampled(
    world: PackedWorld, spans: Floats, off: tuple[float, float], j: int, gap: float
) -> float:
    """The least distance about place j, at samples, at most a gap [m]; see ``_least_about``."""
    for i in range(SAMPLES + 1):
        gap = _gap(world, spans, off, j + i / SAMPLES - 0.5, gap)
    return gap


@inlined
def is_open_strip(world: PackedWorld, places: Floats, beside: Floats, kept: Floats) -> bool:
    """Whether nothing stands so near to any place of a strip that it would be looked for.

    Nor is any curve through its places looked at then.

    Args:
        world: What stands there.
        places: See ``strip_room``,
        beside: the same,
        kept: and the same.
    """
    if world.fence_edges.size > 1:
        return False
    low_x, low_y = places[0]
    high_x, high_y = places[0]
    longest, widest, off = 0.0, 0.0, 0.0
    for j in range(places.shape[0]):
        x, y = places[j]
        low_x, high_x, low_y, high_y = min(low_x, x), max(high_x, x), min(low_y, y), max(high_y, y)
        widest, off = max(widest, kept[j]), max(off, abs(beside[j]))
        if j > 0:
            longest = max(longest, math.hypot(x - places[j - 1, 0], y - places[j - 1, 1]))
    far = 0.5 * longest + REACH * widest + off
    low_x, low_y, high_x, high_y = low_x - far, low_y - far, high_x + far, high_y + far
    if world.bounds.shape[0] > 0 and not (
        world.bounds[0, 0] <= low_x and world.bounds[0, 1] <= low_y
        and world.bounds[0, 2] >= high_x and world.bounds[0, 3] >= high_y
    ):  # fmt: skip
        return False
    node = 0
    while node < world.leaf.size:
        box = world.boxes[node]
        if box[0] > high_x or box[2] < low_x or box[1] > high_y or box[3] < low_y:
            node = world.skip[node]
        elif world.leaf[node] >= 0:
            return False
        else:
            node += 1
    return True


@uncounted
def open_room(places: Floats, kept: Floats, reach: Floats, rooms: Floats) -> None:
    """Tell how far the places of a strip may move in the open: as far as anything is looked for.

    Args:
        places: See ``strip_room``,
        kept: the same,
        reach: the same,
        rooms: and the same.
    """
    count, before = places.shape[0], 0.0
    for j in range(count):
        after = 0.0
        if j + 1 < count:
            after = math.hypot(
                places[j + 1, 0] - places[j, 0], places[j + 1, 1] - places[j, 1]
            )  # fmt: skip
        half = 0.5 * max(before, after)
        rooms[j] = half + REACH * kept[j] - kept[j]
        reach[j] = max(half + REACH * kept[j] - half, LEAST_REACH * kept[j])
        before = after


@kernel
def strip_room(
    world: PackedWorld, places: Floats, normals: Floats, spans: Floats, beside: Floats,
    kept: Floats, low: Floats, high: Floats, reach: Floats, rooms: Floats,
) -> None:  # fmt: skip
    """Look how far places may move: closely about those that have little room.

    What stands there is taken to end at the straight line square to its nearest point. So is what
    stands close by on the other side; farther off, what was known of that side stays.

    Args:
        world: What stands there.
        places: [m], (n, 2).
        normals: Unit vectors, left of the path, (n, 2).
        spans: The curve through the places [m], (n - 1, 4, 2).
        beside: How far to the left of each it is looked from, as ``swept_sides`` (n,) [m].
        kept: Distance from there to what stands there, (n,) [m].
        low: How far to the left each has to move at least [m], (n,); changed.
        high: How far at most [m], (n,); changed.
        reach: How far it may move at once, either way [m], (n,); filled.
        rooms: Distance beyond what is kept, about each [m], (n,); filled.
    """
    count = places.shape[0]
    if is_open_strip(world, places, beside, kept):
        open_room(places, kept, reach, rooms)
        return
    before = 0.0
    for j in range(count):
        after = 0.0
        if j + 1 < count:
            after = math.hypot(
                places[j + 1, 0] - places[j, 0], places[j + 1, 1] - places[j, 1]
            )  # fmt: skip
        half = 0.5 * max(before, after)
        nx, ny = normals[j]
        off = (beside[j] * nx, beside[j] * ny)
        gap, _ = nearest(
            world, places[j, 0] + off[0], places[j, 1] + off[1], half + REACH * kept[j]
        )  # fmt: skip
        rooms[j], reach[j] = gap - kept[j], max(gap - half, LEAST_REACH * kept[j])
        if rooms[j] > half:
            before = after
            continue
        gap, at = _least_about(world, spans, off, j, gap, (before, after), NEAR * kept[j])
        before = after
        x, y = _on_strip(spans, at)
        x, y = x + off[0], y + off[1]
        further, _ = nearest(world, x + PROBE_M * nx, y + PROBE_M * ny, gap + kept[j])
        slope = (further - gap) / PROBE_M
        rooms[j], reach[j] = gap - kept[j], max(gap, LEAST_REACH * kept[j])
        if abs(slope) <= LEAST_SLOPE:
            continue
        aside = math.copysign(ACROSS * kept[j], slope)
        further, _ = nearest(world, x + aside * nx, y + aside * ny, gap + kept[j])
        is_between = further < gap + ALONE * slope * aside
        if is_between:
            off = (off[0] + aside * nx, off[1] + aside * ny)
            further = _least_sampled(world, spans, off, j, further)
        if slope > 0.0:
            low[j] = -rooms[j] / slope
            if is_between:
                high[j] = min(high[j], aside + further - kept[j])
        else:
            high[j] = -rooms[j] / slope
            if is_between:
                low[j] = max(low[j], aside - further + kept[j])
