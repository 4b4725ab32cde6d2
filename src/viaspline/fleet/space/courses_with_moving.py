"""The courses of robots in space and, behind them, of what moves, which has its law by the clock.

Tested through ``fleet/space/test_ways_past_moving``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.fleet.courses import AnyPlan, FleetCourses
from viaspline.fleet.crossings import MAX_BOXES, FleetCrossings, box_owners
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.timing.rides import FleetRides
from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_crossings import PackedCrossings
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.meeting.gap_of_bodies import SpatialCourses
from viaspline.space.meeting.spatial_crossings import spatial_crossings

BEYOND_S: Final = 1.0
"""So long after its last node what moves has one more, to which it never comes [s]."""


@dataclass(frozen=True, eq=False)
class CoursesWithMoving:
    """Robots in space and what moves beside them, as timing sees them.

    What moves is on a course of its own for each clearance that robots keep from it.

    Attributes:
        courses: Of the robots, and then of what moves.
        crossings: Where a robot comes near another one, or near what moves.
        rides: How the robots fly alone, and that what moves keeps to the clock.
        moving: The laws of what moves, at the nodes of its courses.
        robots: How many robots there are.
        begin: When what moves begins its courses [s].
        left_out: Boxes that don't count: of what moves for another clearance than the robot keeps,
            and of a start that it passes before the robot may depart, (boxes,).
        at_goal: Boxes of the goal of a robot that stays there, and of what moves, (boxes,).
    """

    courses: FleetCourses
    crossings: PackedCrossings
    rides: FleetRides
    moving: PackedLaws
    robots: int
    begin: float
    left_out: Flags
    at_goal: Flags

    @classmethod
    def of(
        cls, courses: FleetCourses, rides: FleetRides, plans: Sequence[AnyPlan],
        moving: Sequence[MovingSolid],
    ) -> CoursesWithMoving:  # fmt: skip
        """The courses of robots and of what moves.

        Args:
            courses: Of the robots.
            rides: Of the robots.
            plans: Of the robots.
            moving: What moves; all of it from the same time on.
        """
        assert courses.bodies is not None, "courses in space have bodies"
        robots, first = len(plans), courses.packed.first
        kept = np.array([plan.mission.robot.clearance_m for plan in plans])
        half = float(courses.bodies[0, 2]) - FlyingBody.of(plans[0].mission.robot).margin
        others = [(one, apart - half) for apart in np.unique(kept).tolist() for one in moving]
        every = _joined(courses, others)
        found = spatial_crossings(every, np.arange(robots), MAX_BOXES)
        owner, begin = box_owners(found), float(moving[0].times[0])
        with_moving = (owner < robots) & (found.other >= robots)
        apart = np.concatenate([kept, np.repeat(np.unique(kept), len(moving))])
        departs, vanishes = rides.packed.depart, rides.packed.vanishes
        robot = np.minimum(owner, robots - 1)
        is_over = (found.cell == first[robot]) & (found.high + begin <= departs[robot])
        at_goal = (found.cell == first[robot + 1] - 2) & ~vanishes[robot]
        clocks = [one.times for one, _ in others]
        return cls(
            FleetCourses(every.names, every.packed, every.bodies),
            found,
            _with_clocks(rides, clocks),
            _laws_of(clocks),
            robots,
            begin,
            with_moving & ((apart[owner] != apart[found.other]) | is_over),
            with_moving & at_goal,
        )

    def crossings_until(self, until: Floats) -> FleetCrossings:
        """The crossings without what comes to a robot's goal at a time or later.

        Args:
            until: Of each robot [s], (n,).
        """
        goals = np.append(until, np.zeros(len(self.courses.names) - self.robots))
        later = self.at_goal & (self._begins >= goals[box_owners(self.crossings)])
        return FleetCrossings(without_boxes(self.crossings, self.left_out | later))

    def comes_to_goals(self, after: Floats, before: Floats) -> Flags:
        """Whether something comes to the goal of each robot between two times [s], (n,) each."""
        goals = self.at_goal & ~self.left_out
        owner, begins = box_owners(self.crossings)[goals], self._begins[goals]
        comes = (begins >= after[owner]) & (begins < before[owner])
        return np.asarray(np.bincount(owner[comes], minlength=self.robots) > 0)

    def laws_with(self, robots: PackedLaws) -> FleetLaws:
        """Laws of robots, with those of what moves behind them.

        Args:
            robots: As far as they have theirs.
        """
        pairs = zip(robots, self.moving, strict=True)
        return FleetLaws(PackedLaws(*(np.concatenate(pair) for pair in pairs)))

    @property
    def _begins(self) -> Floats:
        """When what moves begins each box, if the other one is what moves [s], (boxes,)."""
        return self.crossings.low + self.begin


def without_boxes(crossings: PackedCrossings, out: Flags) -> PackedCrossings:
    """Crossings of which some boxes aren't looked at.

    Args:
        crossings: They.
        out: Which boxes of either robot, (boxes,). Where none is left of one of the two robots of a
            crossing, those of the other one are left out as well.
    """
    owner, count = box_owners(crossings), len(crossings.robots)
    side = (crossings.robots[crossings.crossing, 0] != owner).astype(np.int64)
    has = np.zeros((count, 2), np.bool_)
    has[crossings.crossing[~out], side[~out]] = True
    keep = ~out & has[crossings.crossing, 1 - side]
    counts = np.bincount(owner[keep], minlength=len(crossings.box_first) - 1)
    return crossings._replace(
        box_first=np.concatenate(([0], np.cumsum(counts))).astype(np.int64),
        cell=crossings.cell[keep], crossing=crossings.crossing[keep], other=crossings.other[keep],
        low=crossings.low[keep], high=crossings.high[keep],
    )  # fmt: skip


def _joined(courses: FleetCourses, others: Sequence[tuple[MovingSolid, float]]) -> SpatialCourses:
    """The courses of robots and of what moves, each with what is kept about it more [m]."""
    packed, solids = courses.packed, [one for one, _ in others]
    assert courses.bodies is not None, "courses in space have bodies"
    bodies = np.array([(*one.body[:2], one.body[2] + more) for one, more in others])
    sizes = [len(one.times) + 1 for one in solids]
    clocks = [np.append(one.times, one.times[-1] + BEYOND_S) - one.times[0] for one in solids]
    robots_there = np.ones(len(packed.distance), np.bool_)
    return SpatialCourses(
        (*courses.names, *(one.name for one in solids)),
        PackedCourses(
            first=np.concatenate([packed.first, packed.first[-1] + np.cumsum(sizes)]),
            distance=np.concatenate([packed.distance, *clocks]),
            place=np.concatenate(
                [packed.place, *(one.places[[*range(len(one.places)), -1]] for one in solids)]
            ),
            bow=np.concatenate([packed.bow, *(np.append(one.off, one.off[-1]) for one in solids)]),
            reach=np.concatenate([packed.reach, np.maximum(bodies[:, 0] + bodies[:, 2], 0.0)]),
        ),
        np.concatenate([courses.bodies, bodies]),
        np.concatenate(
            [robots_there, *(np.append(one.there[:-1], (False, False)) for one in solids)]
        ),
    )


def _laws_of(clocks: Sequence[Floats]) -> PackedLaws:
    """The laws of what moves by its clock: it never comes to its last node."""
    times = np.concatenate([np.append(times, np.inf) for times in clocks])
    speeds = np.concatenate([np.append(np.ones(len(times)), 0.0) for times in clocks])
    return PackedLaws(times, times.copy(), speeds, np.ones(len(clocks), np.bool_))


def _with_clocks(rides: FleetRides, clocks: Sequence[Floats]) -> FleetRides:
    """How robots fly alone, and that what comes behind them keeps to its clock."""
    robots, laws, count = rides.packed, _laws_of(clocks), len(clocks)
    lasts = np.concatenate([np.append(np.diff(times), (BEYOND_S, 0.0)) for times in clocks])
    rates, keeps = np.ones(count), np.ones(count, np.bool_)
    begins = np.array([times[0] for times in clocks])
    more = PackedRides(
        laws.speed**2, lasts, np.zeros(len(lasts)), rates, rates, begins, keeps, keeps
    )
    pairs = zip(robots, more, strict=True)
    every = zip(rides.laws.packed, laws, strict=True)
    return FleetRides(
        PackedRides(*(np.concatenate(pair) for pair in pairs)),
        np.concatenate([rides.alone, [times[-1] - times[0] for times in clocks]]),
        FleetLaws(PackedLaws(*(np.concatenate(pair) for pair in every))),
    )
