"""Detours that leave the line between two via points late and are back on it early.

Where the line is blocked, the path leaves it and meets it again along circles that touch the line,
beside what it goes round (``lane_turns`` says how near and how wide). Places on the line that are
too near to each other to go back to it between them are gone round as one, and one too near to a
via point from that point on.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.alternatives.leg_search import LegSearch
from viaspline.planning.problem.work_budget import LOCAL_LEG_S
from viaspline.planning.routing.route_on_sides import route_on_sides
from viaspline.planning.routing.route_problem import on_the_line
from viaspline.planning.routing.taut_path import TautPath
from viaspline.planning.turning.bend_row import KEPT, SIDE, LegBends, X, Y, bend, rows_along
from viaspline.planning.turning.lane import Lane
from viaspline.planning.turning.lane_stays import OFF_LANE, LegLane, Stay
from viaspline.planning.turning.lane_turns import LaneTurns, turn_aside
from viaspline.planning.turning.swing_share import swing_share

LANE_REACHES = (1.0, 1.6)  # how long turns off and onto a lane are made, over what they need
END_SWING = 0.35  # of a turn at an end of a lane, in required distances
NEXT_TO = 1.001  # from an end of a leg, at which there is room just so for a turn, in radii
CLEAR_OF_RUN = 0.25  # before a blocked place, at which the line is left at the latest; the same


@dataclass(frozen=True)
class Aside:
    """How a path goes round what stands on its lane.

    Attributes:
        leave: Where it leaves the lane, along it [m]; None where it does so at the leg's start.
        meet: Where it is back on the lane; None where that is at the leg's goal.
        rows: The bends between, as in ``Bends``, (k, 6).
        places: Where it is at each of them, and at those ends of the leg that it includes and that
            lie beside the lane: along it and to its left [m], (j, 2).
        radius: Of the turns off the lane and onto it [m].
    """

    leave: float | None
    meet: float | None
    rows: Floats
    places: Floats
    radius: float

    @property
    def off(self) -> Floats:
        """How far to the left of the lane those places are [m], (j,)."""
        left: Floats = self.places[:, 1]
        return left

    def bends(self, lane: Lane) -> tuple[Floats, Floats]:
        """With those at which it leaves the lane and meets it: rows (j, 6), swings (j,)."""
        if not len(self.places):
            return self.rows, np.empty(0)  # the lane itself
        rows = list(self.rows)
        kept = self.rows[:, KEPT]
        share = swing_share(2.0 * turn_aside(np.abs(self.off), self.radius))
        swings = (np.maximum(self.radius - kept, 0.0) * share.max()).tolist()
        if self.leave is not None:
            rows.insert(0, _touching(lane, self.leave, float(self.off[0]), self.radius))
            swings.insert(0, 0.0)
        if self.meet is not None:
            rows.append(_touching(lane, self.meet, float(self.off[-1]), self.radius))
            swings.append(0.0)
        return np.array(rows).reshape(-1, 6), np.array(swings)


def local_bends(leg_lane: LegLane, taut_path: TautPath, turns: LaneTurns) -> LegBends | None:
    """The bends of a leg that keeps to its line as long as it can.

    Args:
        leg_lane: The leg with its line.
        taut_path: The shortest path to the sides on which it is to pass what it meets.
        turns: The turns off its line and onto it.

    Returns:
        None where the leg takes the shortest way: that is asked for, its line is short beside what
        stands in it, too little of it is left between that, or it begins or ends right beside that.
    """
    leg, lane = leg_lane.leg, leg_lane.lane
    stays = leg_lane.stays(taut_path)
    needs = leg.requirements
    needs.spend(LOCAL_LEG_S)
    if needs.detours is None and not (stays and leg_lane.is_worth_keeping(stays, taut_path)):
        return None
    on_lane = [end[:2] for end in leg.ends if not leg_lane.is_off(end)]
    room = leg.world.distance(np.array(on_lane).reshape(-1, 2))
    if room.min(initial=math.inf) < (1.0 + CLEAR_OF_RUN) * needs.required and stays:
        return None  # it begins or ends beside what it has to go round: no lane is left there
    pieces: list[tuple[Stay, Aside | None]]
    pieces = [(leg_lane.closed(stay, taut_path), None) for stay in stays]
    while any(aside is None for _, aside in pieces):
        found: list[tuple[Stay, Aside]] = []
        for stay, known in pieces:
            aside = known or _aside(leg, lane, stay, turns)
            if aside is None:
                return None
            found.append((stay, aside))
        pieces = _joined(found)
    rows, swings = [np.empty((0, 6))], [np.empty(0)]
    for _, aside in pieces:
        assert aside is not None
        bends = aside.bends(lane)
        rows.append(bends[0])
        swings.append(bends[1])
    return LegBends(np.vstack(rows), np.concatenate(swings), END_SWING * needs.required)


def _aside(leg: LegSearch, lane: Lane, stay: Stay, turns: LaneTurns) -> Aside | None:
    """How the path goes round what stands on a piece of a lane.

    It is routed from where the lane may have to be left, and once more from where it has to be.

    Returns:
        None where no way was found, or nothing of the lane is left before and after it.
    """
    first, last = (float(lane.seen(end)[0]) for end in leg.ends)
    middle = 0.5 * (stay.begin + stay.end)
    radius, room = turns.widest, min(middle - first, last - middle)
    if stay.size > 0.0:
        radius = turns.radius(stay.aside, stay.size, 0.0, room)
    clear = CLEAR_OF_RUN * leg.requirements.required
    along = turns.length(stay.aside, radius)
    leave = max(stay.begin - along, min(stay.begin - clear, first + NEXT_TO * radius))
    meet = min(stay.end + along, max(stay.end + clear, last - NEXT_TO * radius))
    found: Aside | None = None
    for _ in range(2):
        span = (
            leave if leave > first + radius else None,
            meet if meet < last - radius else None,
        )
        found = None if span == (None, None) else _routed(leg, lane, span, stay.barriers, radius)
        if found is None or not len(found.places):
            break
        if stay.size > 0.0:
            at, most = found.places[:, 0], float(np.abs(found.off).max())
            room = float(min(at.min() - first, last - at.max()))
            radius = turns.radius(most, stay.size, float(np.ptp(at)), room)
        needed = np.array([turns.length(off, radius) for off in np.abs(found.off)])
        before, after = found.off * found.off[0] > 0.0, found.off * found.off[-1] > 0.0
        leave = min(float((found.places[:, 0] - needed)[before].min()), stay.begin - clear)
        meet = max(float((found.places[:, 0] + needed)[after].max()), stay.end + clear)
    if found is None:
        return None
    return replace(
        found,
        leave=None if found.leave is None else leave,
        meet=None if found.meet is None else meet,
        radius=radius,
    )


def _routed(
    leg: LegSearch, lane: Lane, span: tuple[float | None, float | None], barriers: Floats,
    radius: float,
) -> Aside | None:  # fmt: skip
    """The shortest way from one place on a lane to another, None the ends of the leg."""
    needs, (leave, meet) = leg.requirements, span
    ends = (
        leg.ends[0] if leave is None else lane.at(leave),
        leg.ends[1] if meet is None else lane.at(meet),
    )
    if leg.world.distance(np.array([end[:2] for end in ends])).min() < leg.router.floor:
        return None  # a lattice takes long to say that there is no way to where no room is
    active = on_the_line(leg.world, *ends, needs.required)

    find = partial(leg.route_between, *ends)
    outcome, _ = route_on_sides(find, leg.sides, active, barriers)
    if outcome.value is None:
        return None
    rows = rows_along(outcome.value)
    apexes = lane.seen(rows[:, [X, Y]])
    apexes[:, 1] -= rows[:, SIDE] * rows[:, KEPT]
    seen = [lane.seen(end)[None] for end in ends]
    start, goal = (end[np.abs(end[:, 1]) > OFF_LANE * needs.required] for end in seen)
    return Aside(leave, meet, rows, np.vstack((start, apexes, goal)), radius)


def _touching(lane: Lane, along: float, off: float, radius: float) -> Floats:
    """The bend at which a path leaves or meets a lane whose next turn is so far to its left [m].

    It is a circle that the lines of its turn touch, ramps included, where the lane is one of them.
    """
    turn = float(turn_aside(np.array([abs(off)]), radius)[0])
    shift = radius * min(turn, 1.0) ** 2 / 24.0
    side = math.copysign(1.0, off)
    x, y = lane.at(along, side * (radius + shift)).tolist()
    return bend(x, y, radius, side)


def _joined(pieces: Sequence[tuple[Stay, Aside]]) -> list[tuple[Stay, Aside | None]]:
    """Pieces of a lane, those as one, with None, between which the path isn't back on it."""
    found: list[tuple[Stay, Aside | None]] = []
    meets = -math.inf
    for stay, aside in pieces:
        leaves = -math.inf if aside.leave is None else aside.leave
        if found and leaves < meets:
            last = found[-1][0]
            both = Stay(
                last.begin,
                stay.end,
                max(last.aside, stay.aside),
                max(last.size, stay.size),
                np.vstack((last.barriers, stay.barriers)),
            )
            found[-1] = both, None
        else:
            found.append((stay, aside))
        meets = max(meets, math.inf if aside.meet is None else aside.meet)
    return found
