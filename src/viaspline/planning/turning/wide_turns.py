"""Turns as wide as a good driver makes them: each for itself, where there is room for it.

Every bend is given the radius with which it is passed soonest. What swings out too far for what
stands beside the path, or for the turns before and after it, is narrowed until it fits.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.turning.gentle_lengths import gentle_lengths
from viaspline.planning.checking.conflicts import CLEAR, body_conflicts
from viaspline.planning.problem.path_pace import Pace
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.work_budget import TURN_WISHES_S, turn_path_s
from viaspline.planning.turning.affordable_room import affordable_radii
from viaspline.planning.turning.bend_row import DETOUR, HEADING, KEPT, RADIUS, Bends
from viaspline.planning.turning.joined_bends import (
    TurnWishes,
    joins_worth_it,
    loosened,
    rest_of,
    with_joins,
)
from viaspline.planning.turning.repair import clear_turn_path
from viaspline.planning.turning.swing_share import swing_share
from viaspline.planning.turning.turn_path import (
    NoTurnPath,
    SettledTurns,
    TurnPath,
    laid_turns,
    settled_turns,
)
from viaspline.world.world import World

NARROWER = 0.7  # a radius that doesn't fit, over the next one that is tried
MOST_NARROWED = 0.5  # of the widest swing of those between which it is too tight: narrowed as well
MAX_NARROWINGS = 40
GENTLE_SHARE = 2e-3  # of the length, that may be spent on gentle bends
GENTLE_ROOM = 0.97  # of a line, that its turns may take
MOST_SHARED = 2.5  # of a line, for the turns at its ends as they are wished; laying them tells more
ARC_LONGER = 24.0  # an arc of radius R by t is longer than its corner by R t³ over this
LEAST_ROOM_M = 1e-6  # of a line between two bends at the same place
LEAST_SHARE = 1e-12  # of its radius that a turn swings out


@dataclass(frozen=True)
class WideTurns:
    """What turns should be like.

    Attributes:
        pace: How fast the robot may go.
        least: The least radius of turns that may swing out [m].
        sharpest: The least radius of those that may not [m].
        roomy: What turns have where there is room, even if sharper ones were as fast [m].
        own: The radius of turns that are as sharp as the robot itself [m].
    """

    pace: Pace
    least: float
    sharpest: float
    roomy: float
    own: float

    def pushed(self, bends: Bends, world: World, requirements: Requirements) -> TurnPath | None:
        """The least turns pushed clear, then as wide as fits round what they were pushed from.

        None where not even the least are clear.
        """
        pushed = clear_turn_path(bends.turning(self.least), world, requirements)
        if pushed is None:
            return None
        return self.narrowed(pushed.bends, world, requirements) or pushed

    def narrowed(self, bends: Bends, world: World, requirements: Requirements) -> TurnPath | None:
        """The widest turns that fit, to the sides that are set; None where the least aren't clear.

        What came of it is kept.
        """
        lay = partial(self._narrowed, bends, world, requirements)
        return requirements.recalled(("wide", self, bends.key, world), lay)

    def _narrowed(self, bends: Bends, world: World, requirements: Requirements) -> TurnPath | None:
        """The widest turns to the sides that are set, narrowed until they are clear.

        Bends are joined first where that is gentler, as far as there is room for it.
        """
        requirements.spend(TURN_WISHES_S)
        narrowest = self._least_turns(bends, requirements)
        if isinstance(narrowest, NoTurnPath):
            return None
        wishes = self._wishes(narrowest)
        joins = joins_worth_it(narrowest.bends, wishes, GENTLE_ROOM)
        while joins:
            found = self._joined(with_joins(narrowest.bends, joins), world, requirements)
            rows = np.delete(np.arange(len(narrowest.bends.rows)), rest_of(joins))
            tight = rows[_wound_round(found) if isinstance(found, TurnPath) else found].tolist()
            if isinstance(found, TurnPath) and not {join.first for join in joins} & set(tight):
                return found
            looser = tuple(loosened(joins, set(tight)))
            joins = looser if looser != joins else ()
        radii = self._wished(bends, narrowest, wishes)
        found = self._fitted(bends, radii, narrowest, world, requirements)
        return found if isinstance(found, TurnPath) else None

    def _joined(self, bends: Bends, world: World, requirements: Requirements) -> TurnPath | Ints:
        """The widest turns round a row of bends some of which are joined; see ``_fitted``."""
        requirements.spend(TURN_WISHES_S)
        narrowest = self._least_turns(bends, requirements)
        if isinstance(narrowest, NoTurnPath):
            return np.arange(len(bends.rows))
        radii = self._wished(bends, narrowest, self._wishes(narrowest))
        return self._fitted(bends, radii, narrowest, world, requirements)

    def _fitted(
        self, bends: Bends, radii: Floats, narrowest: SettledTurns, world: World,
        requirements: Requirements,
    ) -> TurnPath | Ints:  # fmt: skip
        """Turns round a row, narrowed from radii (n,) [m] until they are clear.

        Where the least have no room, these are the bends before, after and between them, (k,).
        That is tried first: where they don't fit, wider ones needn't be narrowed to them.
        """
        if (radii < self.least).any():
            _, tight, _ = _tried(bends, np.minimum(radii, self.least), world, requirements)
        else:
            requirements.spend(turn_path_s(len(bends.rows)))
            _, tight, _ = _judged(narrowest, len(radii), world, requirements)
        for _ in range(MAX_NARROWINGS if not tight else 0):
            turn_path, tight, swings = _tried(bends, radii, world, requirements)
            if turn_path is not None:
                return turn_path
            narrowed = _narrowed(radii, tight, swings, self.least)
            if np.array_equal(narrowed, radii):
                break
            radii = narrowed
        return np.concatenate([np.arange(pair.min(), pair.max() + 1) for pair in tight])

    def ideal(
        self, bends: Bends, requirements: Requirements, narrowings: int = 0
    ) -> TurnPath | None:
        """The turn path with the widest turns, clear or not; None where they overlap.

        Args:
            bends: The row.
            requirements: With what may be spent.
            narrowings: How often those that overlap are narrowed.
        """
        requirements.spend(TURN_WISHES_S + turn_path_s(len(bends.rows)))
        narrowest = self._least_turns(bends, requirements)
        if isinstance(narrowest, NoTurnPath):
            return None
        radii = self._wished(bends, narrowest, self._wishes(narrowest))
        for _ in range(narrowings + 1):
            found = settled_turns(bends.turning(radii))
            if isinstance(found, SettledTurns):
                return laid_turns(found)
            radii = _narrowed(radii, _pairs(found.left, found.lines), radii, self.least)
        return None

    def _least_turns(self, bends: Bends, requirements: Requirements) -> SettledTurns | NoTurnPath:
        """Where the least turns lie; a row is told the time of and then laid, mostly."""
        least = bends.turning(self.least)
        if requirements.parts is None:
            return settled_turns(least)
        return requirements.parts.once(("least", least.key), partial(settled_turns, least))

    def _wishes(self, narrowest: SettledTurns) -> TurnWishes:
        """What turns should be like that bend as little as they can for a part of the length.

        The part is over that of the fastest turns, so that it is as much of the time.
        """
        angles, gaps = np.abs(narrowest.turns), _gaps(narrowest)
        speeds = self.pace.speeds_at(narrowest.lines_and_turns[2])
        fast = self.pace.corner_radii(angles, narrowest.bends.rows[:, KEPT], speeds)
        arcs = float((fast * np.minimum(angles, 1.0) ** 3).sum()) / ARC_LONGER
        spent = GENTLE_SHARE * float(gaps.sum()) + arcs
        rooms = 2.0 * GENTLE_ROOM * gaps
        lengths = gentle_lengths(angles, rooms, narrowest.bends.closed, spent)
        return TurnWishes(angles, gaps, lengths, fast, spent, self.pace.widest_radii(speeds))

    def _wished(self, bends: Bends, narrowest: SettledTurns, wishes: TurnWishes) -> Floats:
        """The radius that each turn should have [m], (n,).

        A turn into a heading that is given swings out by all of its angle: its line leads there.
        """
        rows, angles, lengths = narrowest.left, wishes.turns, wishes.lengths
        kept = bends.rows[rows, KEPT]
        radii = np.full(len(bends.rows), max(self.roomy, self.least))
        per = np.maximum(2.0, 1.0 + angles)  # length of a turn, over its radius
        gentle = lengths / per
        wide = np.maximum(wishes.fast * np.minimum(angles, 1.0), gentle)
        shares = _shares(wide * per, MOST_SHARED * wishes.gaps)
        wide = np.minimum(wide, shares / per)
        ramps = np.maximum(lengths - kept * angles, 0.0)  # beside an arc round what is kept
        wide = np.where(gentle < kept * angles, ramps, wide)
        spent = GENTLE_SHARE * float(wishes.gaps.sum())
        usual = np.maximum(np.minimum(wishes.widest, self.roomy), self.own)
        soonest = np.maximum(wishes.fast, usual)
        radii[rows] = np.minimum(radii[rows], affordable_radii(angles, radii[rows], soonest, spent))
        radii[rows] = np.maximum(radii[rows], wide)
        at_ends = (rows == 0) | (rows == len(bends.rows) - 1)
        given = np.isfinite(bends.rows[rows, HEADING]) & at_ends & (not bends.closed)
        swing = np.where(given, np.minimum(angles, 1.0), swing_share(angles))
        swung = bends.swings[rows] / np.maximum(swing, LEAST_SHARE)
        rests = (bends.swings[rows] == 0.0) & (bends.vias[rows] != DETOUR)
        swung[rests] = self._radii_at_rests(angles[rests])
        radii[rows] = np.minimum(radii[rows], kept + swung)
        radii[rows] = np.maximum(radii[rows], self.sharpest)
        return radii

    def _radii_at_rests(self, angles: Floats) -> Floats:
        r"""The radii of turns in whose middle the robot stands [m], (n,): as sharp as may be.

        One that turns no faster than :math:`\omega` has come to
        :math:`a \theta^2 / 8 \omega^2` when half of the turn is done. A sharper turn takes as long.

        Args:
            angles: By how much they turn [rad], (n,).
        """
        found: Floats = 0.25 * self.pace.accel / self.pace.yaw_rate**2 * angles
        return found


def _tried(
    bends: Bends, radii: Floats, world: World, requirements: Requirements
) -> tuple[TurnPath | None, list[Ints], Floats]:
    """Turns of given radii round a row, if they are clear.

    Args:
        bends: The row.
        radii: [m], (n,).
        world: What to keep clear of.
        requirements: What to keep.

    Returns:
        The path; the bends before and after each tight place, if it isn't clear or there is none;
        how far each turn swings out, (n,).
    """
    requirements.spend(turn_path_s(len(bends.rows)))
    settled = settled_turns(bends.turning(radii))
    if isinstance(settled, NoTurnPath):
        return None, _pairs(settled.left, settled.lines), radii
    return _judged(settled, len(radii), world, requirements)


def _judged(
    settled: SettledTurns, count: int, world: World, requirements: Requirements
) -> tuple[TurnPath | None, list[Ints], Floats]:
    """What ``_tried`` tells, of turns whose lines are known round a row of so many bends."""
    turn_path = laid_turns(settled)
    swings = np.zeros(count)
    swings[turn_path.left] = _swings(turn_path)
    close = body_conflicts(world, turn_path.spans, requirements)
    if (close == CLEAR).all():
        return turn_path, [], swings
    return None, _pairs_between(turn_path, turn_path.left, np.flatnonzero(close != CLEAR)), swings


def _wound_round(turn_path: TurnPath) -> Ints:
    """The bends that a path turns round by more than half a circle, as rows of those asked for.

    So it does round a circle that its ends lie too near to: its lines touch it in the wrong order.
    """
    found: Ints = turn_path.left[np.abs(turn_path.turns) > np.pi]
    return found


def _gaps(settled: SettledTurns) -> Floats:
    """From the apex of each turn to that of the next [m], (n - 1,), or (n,) when closed."""
    apexes = settled.lines_and_turns[2]
    ends = np.concatenate((apexes, apexes[:1])) if settled.bends.closed else apexes
    ways = ends[1:] - ends[:-1]  # ``np.diff`` takes as long as all else here
    found: Floats = np.maximum(np.hypot(ways[:, 0], ways[:, 1]), LEAST_ROOM_M)
    return found


def _shares(lengths: Floats, gaps: Floats) -> Floats:
    """How long turns may be that share the lines between them [m], (n,).

    Of each line a turn has half, or what the other one leaves.
    """
    rooms = 2.0 * gaps
    before, after = lengths[: len(gaps)], np.append(lengths[1:], lengths[0])[: len(gaps)]
    shares = np.full(len(lengths), np.inf)
    shares[: len(gaps)] = np.maximum(gaps, rooms - after)
    ends = np.arange(1, len(gaps) + 1) % len(lengths)
    shares[ends] = np.minimum(shares[ends], np.maximum(gaps, rooms - before))
    return shares


def _swings(turn_path: TurnPath) -> Floats:
    """How far each turn moves the lines before and after it out, beyond what is kept [m], (n,)."""
    rows = turn_path.bends.rows
    wider = np.maximum(rows[:, RADIUS] - rows[:, KEPT], 0.0)
    return np.asarray(wider * (1.0 - np.cos(0.5 * np.abs(turn_path.turns))))


def _pairs_between(turn_path: TurnPath, left: Ints, spans: NDArray[np.intp]) -> list[Ints]:
    """The bends before and after each of some spans, as rows of the bends asked for."""
    before = np.searchsorted(turn_path.begins[: len(left)], spans, side="right") - 1
    return _pairs(left, np.unique(before))


def _pairs(left: Ints, lines: Ints) -> list[Ints]:
    """The bends before and after each of some lines, as rows of the bends asked for."""
    return [left[[k % len(left), (k + 1) % len(left)]] for k in lines]


def _narrowed(radii: Floats, tight: list[Ints], swings: Floats, least: float) -> Floats:
    """Radii with narrower ones at those bends of tight places that swing out most."""
    result = radii.copy()
    for pair in tight:
        free = pair[radii[pair] > least]
        if free.size:
            widest = swings[free].max()
            free = free[swings[free] >= MOST_NARROWED * widest]
        result[free] = np.maximum(NARROWER * radii[free], least)
    return result
