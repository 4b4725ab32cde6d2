"""What each robot of a fleet does when: it stands, drives, or waits for another one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.lost_times import LostTimes, lost_times
from viaspline.fleet.precedences import held_at
from viaspline.kernels.arrays import Floats, Ints, Steps
from viaspline.kernels.fleet.passing_order import passing_gaps

SLOW_SHARE = 0.1
"""A robot waits where it takes longer than alone by more than this share of the time."""
SAME_S = 1e-6
"""Stretches that are no longer are rounding [s]."""
JOINED_S = 0.5
"""Waits for one robot that are no farther apart are one [s]."""


class ActivitySpan(NamedTuple):
    """What a robot does from one time to another.

    Attributes:
        begin: From when [s].
        end: Until when [s].
        kind: ``stands``: at a station; ``drives``; ``waits``: it stands or goes slower for another
            robot.
        other: For whom it waits; empty where it doesn't.
        lost: How much later it is for that [s].
    """

    begin: float
    end: float
    kind: Literal["stands", "drives", "waits"]
    other: str = ""
    lost: float = 0.0


@dataclass(frozen=True)
class Timeline:
    """What a robot does from its departure to its arrival.

    Attributes:
        name: The robot.
        stretches: One after the other.
        late: How much later it arrives than if it were alone [s].
    """

    name: str
    stretches: tuple[ActivitySpan, ...]
    late: float

    @property
    def waits(self) -> tuple[ActivitySpan, ...]:
        """Those stretches in which it waits for another robot."""
        return tuple(one for one in self.stretches if one.kind == "waits")

    def waits_for(self, time: float) -> str:
        """For whom it waits at a time [s]; empty where it doesn't."""
        return next((one.other for one in self.waits if one.begin <= time < one.end), "")


def timelines_of(plan: FleetPlan) -> tuple[Timeline, ...]:
    """What every robot that is served does when, in the order of the plan.

    Args:
        plan: Of the fleet.

    Example:
        >>> from viaspline.fleet.plan_fleet import plan_fleet
        >>> from viaspline.mission.fleet.fleet import Fleet, FleetMember
        >>> from viaspline.mission.model import Mission
        >>> mission = lambda start, goal: Mission.model_validate(
        ...     {"route": {"start": start, "goal": goal}})
        >>> a, b = mission((0, 0), (40, 0)), mission((20, -20), (20, 20))
        >>> plan = plan_fleet(Fleet.of([FleetMember("a", a), FleetMember("b", b)], 1.0))
        >>> [(one.name, [wait.other for wait in one.waits]) for one in timelines_of(plan)]
        [('a', []), ('b', ['a'])]
    """
    lost = lost_times(plan)
    gaps = passing_gaps(plan.courses.packed, plan.crossings.packed, plan.laws.packed)
    numbers = {name: robot for robot, name in enumerate(plan.courses.names)}
    return tuple(_timeline(plan, lost, gaps, numbers[name]) for name in plan.plans)


def _timeline(plan: FleetPlan, lost: LostTimes, gaps: Floats, robot: int) -> Timeline:
    """What one robot does when."""
    courses, crossings = plan.courses.packed, plan.crossings.packed
    begin, end = int(courses.first[robot]), int(courses.first[robot + 1])
    held = held_at(plan.courses, plan.crossings, plan.laws, plan.alone_laws, gaps, robot)
    boxes = np.array([box for box, _ in held], np.int64)
    others = crossings.other[boxes]
    waited = _waited_for(crossings.cell[boxes] - begin, others, end - begin)
    laws = plan.laws.packed
    arrive, leave = laws.arrive[begin:end].copy(), laws.leave[begin:end]
    stand, drive = lost.standing[begin:end], lost.driving[begin:end]
    arrive[0] = leave[0] - stand[0]
    goes = leave - np.maximum(stand, 0.0)
    stays = goes[:-1] - arrive[:-1]
    after = np.append(arrive[1:], arrive[-1])
    halts = (waited >= 0) & (stand > SAME_S)
    slow = (waited >= 0) & (drive > SLOW_SHARE * (after - leave))
    pieces: list[ActivitySpan] = []
    names = plan.courses.names
    for k in np.flatnonzero((stays > SAME_S) | halts[:-1] | slow[:-1]).tolist():
        _append(pieces, ActivitySpan(arrive[k], goes[k], "stands"))
        for is_wait, since, until, more in (
            (halts[k], goes[k], leave[k], stand[k]),
            (slow[k], leave[k], after[k], drive[k]),
        ):
            if is_wait:
                _append(pieces, ActivitySpan(since, until, "waits", names[waited[k]], more))
    driven = _with_drives(float(arrive[0]), pieces, float(arrive[-1]))
    late = float(laws.arrive[end - 1] - plan.alone_laws.packed.arrive[end - 1])
    return Timeline(names[robot], driven, late)


def _append(pieces: list[ActivitySpan], new: ActivitySpan) -> None:
    """Put a stretch behind others, as one with the last of them where it goes on with that."""
    if new.end - new.begin <= SAME_S:
        return
    new = new._replace(begin=float(new.begin), end=float(new.end), lost=float(new.lost))
    last = pieces[-1] if pieces else ActivitySpan(-np.inf, -np.inf, "stands")
    if last[2:4] == new[2:4] and new.begin - last.end <= JOINED_S:
        pieces[-1] = last._replace(end=new.end, lost=last.lost + new.lost)
    else:
        pieces.append(new)


def _with_drives(begin: float, pieces: list[ActivitySpan], end: float) -> tuple[ActivitySpan, ...]:
    """Stretches, and what is driven between them."""
    found, now = [], begin
    for piece in [*pieces, ActivitySpan(end, end, "stands")]:
        if piece.begin - now > SAME_S:
            found.append(ActivitySpan(now, piece.begin, "drives"))
        if piece.end > piece.begin:
            found.append(piece)
        now = piece.end
    return tuple(found)


def _waited_for(at: Steps, others: Steps, count: int) -> Ints:
    """For whom a robot is held up at each node and in the cell after it; -1: for nobody, (count,).

    Args:
        at: The nodes to which it comes later for others, in their order, (w,).
        others: Whom it lets pass there, (w,).
        count: Of nodes.
    """
    waited: Ints = np.append(others, -1)[np.searchsorted(at, np.arange(1, count + 1))]
    return waited
