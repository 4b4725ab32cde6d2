"""What moves in space as it is known to: an upright cylinder or a ball on its way in time.

A shape that isn't a ball counts as the upright cylinder that holds it: about its own middle where
it doesn't turn, else about the frame's origin.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.mission.model import Mission
from viaspline.mission.motion_spec import Motion
from viaspline.mission.shapes.obstacle import Obstacle

HIGH_M: Final = 1e5
"""Half of the height of what has none of its own: it is at every height [m]."""
JUMP_S: Final = 1e-6
"""How long it isn't there while it jumps to where its loop begins [s]."""
LONGEST_CELL_S: Final = 1.0
"""Of a motion of which it gets ever less certain where it is [s]."""
LEAST_S: Final = 1e-9
"""Of a cell [s]."""
MAX_ROUNDS: Final = 5_000
"""How often a motion that goes on and on is repeated, at most; its way ends earlier then."""


@dataclass(frozen=True, eq=False)
class MovingSolid:
    """Something that moves, from one time to another.

    Attributes:
        name: What it is called.
        body: Radius and half height of its cylinder, and the margin about it [m].
        times: Of the nodes of its way, increasing [s], (k,).
        places: Of the middle of its body there [m], (k, 3); it goes evenly from one to the next.
        there: Whether it is there on its way from each node, (k,).
        off: How far from its place it may be until the next node, at most [m], (k,).
    """

    name: str
    body: tuple[float, float, float]
    times: Floats
    places: Floats
    there: Flags
    off: Floats

    @classmethod
    def of(cls, obstacle: Obstacle, name: str, begin: float, end: float) -> MovingSolid:
        """An obstacle with a motion, from one time to another [s], or until ``MAX_ROUNDS``.

        >>> lift = Obstacle(ball={"center": (0, 0, 0), "radius": 1},
        ...                 motion={"from": (5, 0, 2), "velocity_mps": (0, 0, 1)})
        >>> solid = MovingSolid.of(lift, "lift", 0.0, 10.0)
        >>> solid.body, solid.places.tolist()
        ((0.0, 0.0, 1.0), [[5.0, 0.0, 2.0], [5.0, 0.0, 12.0]])
        """
        motion = obstacle.motion
        assert motion is not None, "it moves"
        body, middle = _body(obstacle, turns=_turns(motion))
        times, places, there = _way(motion, begin, end)
        if motion.error.growth_mps > 0.0:
            times, places, there = _finer(times, places, there)
        after = np.append(times[1:], times[-1])
        growth = motion.error.growth_mps * np.maximum(after, 0.0)
        off: Floats = motion.error.position_m + growth
        return cls(name, body, times, places + middle, there, off)

    @classmethod
    def all_of(cls, mission: Mission, begin: float, end: float) -> tuple[MovingSolid, ...]:
        """All that moves on the map of a mission, from one time to another [s]."""
        return tuple(
            cls.of(one, one.name or f"moving obstacle {k + 1}", begin, end)
            for k, one in enumerate(mission.world.moving)
        )

    @classmethod
    def unseen_of(cls, mission: Mission, begin: float, end: float) -> tuple[MovingSolid, ...]:
        """All that moves and isn't on the map, from one time to another [s]."""
        return tuple(
            cls.of(one, one.name or f"unseen moving obstacle {k + 1}", begin, end)
            for k, one in enumerate(mission.world.unseen_moving)
        )

    @property
    def top_speed(self) -> float:
        """How fast it goes where it is there at most [m/s]."""
        lasts, ways = np.diff(self.times), np.linalg.norm(np.diff(self.places, axis=0), axis=1)
        goes = self.there[:-1] & (lasts > 0.0)
        return float((ways[goes] / lasts[goes]).max(initial=0.0))

    def since(self, begin: float) -> MovingSolid:
        """It from a later time on [s]; before its last node at the latest."""
        later = self.times > begin
        later[-1] = True
        first = max(len(later) - int(later.sum()) - 1, 0)
        if not self.times[first] < begin < self.times[-1]:
            return self
        times, places = self.times[first:].copy(), self.places[first:].copy()
        places[0] = self.at_any_time(begin)
        times[0] = begin
        return replace(
            self, times=times, places=places, there=self.there[first:], off=self.off[first:]
        )

    def between(self, begin: float, end: float) -> MovingSolid:
        """It from one time to another [s], as far as it is known for these."""
        begin = min(max(begin, float(self.times[0])), float(self.times[-1]))
        times, places, there = _cut(
            self.times, self.places, self.there, begin, max(begin, min(end, float(self.times[-1])))
        )
        return replace(self, times=times, places=places, there=there, off=self.off_at(times))

    def at_any_time(self, time: float) -> Floats:
        """Where its middle is, or would be if it were there, at a time [s]: [m], (3,)."""
        return np.array([np.interp(time, self.times, self.places[:, k]) for k in range(3)])

    def at(self, times: Floats) -> Floats:
        """Where its middle is at times [s], (t,): [m], (t, 3); nan where it isn't there."""
        at = np.column_stack([np.interp(times, self.times, self.places[:, k]) for k in range(3)])
        return np.where(self.there[self._cell(times)][:, None], at, np.nan)

    def off_at(self, times: Floats) -> Floats:
        """How far from there it may be at times [s], (t,), at most: [m], (t,)."""
        return np.asarray(self.off[self._cell(times)])

    def velocity(self, time: float) -> Floats:
        """How it goes on from a time [s]: [m/s], (3,)."""
        k = min(int(self._cell(np.array([time]))[0]), len(self.times) - 2)
        lasts = max(float(self.times[k + 1] - self.times[k]), LEAST_S)
        return np.asarray((self.places[k + 1] - self.places[k]) / lasts)

    def _cell(self, times: Floats) -> Ints:
        row = np.searchsorted(self.times, times, side="right") - 1
        return np.asarray(np.clip(row, 0, len(self.times) - 1))


def _turns(motion: Motion) -> bool:
    return any(len(frame) > 3 and frame[3] != 0.0 for frame in motion.keyframes or ())


def _body(obstacle: Obstacle, *, turns: bool) -> tuple[tuple[float, float, float], Floats]:
    """The cylinder that holds a shape, and its middle in the shape's frame [m]."""
    solid = obstacle.solid()
    ring = obstacle.outline_in_plan
    assert ring is not None, "maps don't move"
    _, _, z0, _, _, z1 = solid.extent if hasattr(solid, "extent") else solid.box
    x0, y0, x1, y1 = ring.box
    if obstacle.ball is not None and not turns:
        center = np.array(obstacle.ball.center)
        return (0.0, 0.0, obstacle.ball.radius), center
    middle = np.zeros(2) if turns else np.array([0.5 * (x0 + x1), 0.5 * (y0 + y1)])
    core = np.concatenate([np.array(loop, np.float64).reshape(-1, 2) for loop in ring.loops])
    apart: Floats = np.linalg.norm(core - middle, axis=1)
    radius = float(apart.max()) + ring.radius
    if not (math.isfinite(z0) and math.isfinite(z1)):
        low = z0 if math.isfinite(z0) else (z1 if math.isfinite(z1) else 0.0) - 2.0 * HIGH_M
        high = z1 if math.isfinite(z1) else low + 4.0 * HIGH_M
        z0, z1 = low, high
    return (radius, 0.5 * (z1 - z0), 0.0), np.append(middle, 0.5 * (z0 + z1))


def _frames(motion: Motion) -> Floats:
    """Time, x, y, z of keyframes, (k, 4); one without z has that of the one before."""
    rows, height = [], 0.0
    for frame in motion.keyframes or ():
        height = frame[4] if len(frame) > 4 else height
        rows.append((*frame[:3], height))
    return np.array(rows, np.float64)


def _way(motion: Motion, begin: float, end: float) -> tuple[Floats, Floats, Flags]:
    """Times, places of the frame and whether it is there, from one time to another."""
    if motion.keyframes is None:
        assert motion.from_ is not None
        assert motion.velocity_mps is not None
        first = np.array((*motion.from_, 0.0)[:3])
        speed = np.array((*motion.velocity_mps, 0.0)[:3])
        times = np.array([begin, end])
        return times, first + times[:, None] * speed, np.ones(2, np.bool_)
    frames = _frames(motion)
    if motion.after in ("loop", "bounce"):
        return _cut(*_repeated(frames, begin, end, bounces=motion.after == "bounce"), begin, end)
    vanishes = motion.after == "vanish"
    absent = vanishes if motion.before is None else motion.before == "absent"
    times, places = frames[:, 0], frames[:, 1:]
    there = np.ones(len(times), np.bool_)
    there[-1] = not vanishes
    before, after = min(begin, float(times[0])) - 1.0, max(end, float(times[-1])) + 1.0
    return _cut(
        np.concatenate(([before], times, [after])),
        np.concatenate((places[:1], places, places[-1:])),
        np.concatenate(([not absent], there, [not vanishes])),
        begin, end,
    )  # fmt: skip


def _repeated(
    frames: Floats, begin: float, end: float, *, bounces: bool
) -> tuple[Floats, Floats, Flags]:
    """A motion that goes on and on, from before one time until after another."""
    if bounces:
        back = frames[-2::-1].copy()
        back[:, 0] = 2.0 * frames[-1, 0] - back[:, 0]
        frames = np.concatenate((frames, back))
    period = float(frames[-1, 0] - frames[0, 0])
    first = math.floor((begin - frames[0, 0]) / period)
    rounds = min(math.ceil((end - begin) / period) + 2, MAX_ROUNDS)
    jumps = bool(np.linalg.norm(frames[-1, 1:] - frames[0, 1:]) > 0.0)
    times, places, there = [], [], []
    for k in range(first, first + rounds):
        one = frames[:, 0] + k * period
        here = np.ones(len(one), np.bool_)
        if jumps:
            one = one.copy()
            one[-1] -= JUMP_S
            here[-1] = False
            times.append(one)
            places.append(frames[:, 1:])
            there.append(here)
        else:
            times.append(one[:-1])
            places.append(frames[:-1, 1:])
            there.append(here[:-1])
    times.append(np.array([frames[0, 0] + (first + rounds) * period]))
    places.append(frames[:1, 1:])
    there.append(np.ones(1, np.bool_))
    return np.concatenate(times), np.concatenate(places), np.concatenate(there)


def _cut(
    times: Floats, places: Floats, there: Flags, begin: float, end: float
) -> tuple[Floats, Floats, Flags]:
    """The part of a way from one time to another, or to where it ends."""
    end = min(end, float(times[-1]))
    inside = (times > begin) & (times < end)
    cuts = np.concatenate(([begin], times[inside], [end]))
    at = np.column_stack([np.interp(cuts, times, places[:, k]) for k in range(3)])
    row = np.clip(np.searchsorted(times, cuts, side="right") - 1, 0, len(times) - 1)
    return cuts, at, there[row]


def _finer(times: Floats, places: Floats, there: Flags) -> tuple[Floats, Floats, Flags]:
    """A way with more nodes, no farther apart than ``LONGEST_CELL_S``."""
    counts = np.maximum(np.ceil(np.diff(times) / LONGEST_CELL_S), 1.0).astype(np.int64)
    parts = [
        np.linspace(a, b, n + 1)[:-1]
        for a, b, n in zip(times[:-1], times[1:], counts.tolist(), strict=True)
    ]
    finer = np.append(np.concatenate(parts), times[-1])
    at = np.column_stack([np.interp(finer, times, places[:, k]) for k in range(3)])
    row = np.clip(np.searchsorted(times, finer, side="right") - 1, 0, len(times) - 1)
    return finer, at, there[row]
