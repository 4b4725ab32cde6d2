"""The ways of a fleet in space among things that move as it is known, and when it flies them.

What moves is one more course for each: it is where it is by the clock, so its distances are times,
and it has its law before all robots, which let it pass. Of the places where a robot stands for long
only as much counts as is asked for: of its start what passes once it may depart, of its goal what
passes until it has stayed there for ``hold_s``. When that is isn't known before it is timed; so who
would be met at its goal is timed anew, to arrive there after what meets it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.space.courses_with_moving import CoursesWithMoving
from viaspline.fleet.timing.improve_laws import improve_laws
from viaspline.fleet.timing.time_paths import Timing, time_paths
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.space.among.moving_solid import MovingSolid


@dataclass(frozen=True, eq=False)
class WaysPastMoving(FleetWays):
    """The ways of robots in space, past what moves.

    Attributes:
        moving: What moves, all of it from when the first robot may depart.
    """

    moving: tuple[MovingSolid, ...] = ()

    @classmethod
    def past(cls, ways: FleetWays, moving: Sequence[MovingSolid]) -> WaysPastMoving:
        """The ways of robots, past what moves.

        Args:
            ways: As if nothing moved.
            moving: What moves, all of it from when the first robot may depart.
        """
        return cls(
            ways.members, ways.plans, ways.courses, ways.crossings, ways.rides,
            moving=tuple(moving),
        )  # fmt: skip

    def along(self, plans: Mapping[str, AnyPlan], separation: float) -> WaysPastMoving:
        """See ``FleetWays``."""
        return WaysPastMoving.past(FleetWays.laid(self.members, plans, separation), self.moving)

    def timed(self, left_out: Sequence[int] = ()) -> Timing:
        """See ``FleetWays``; all let pass what moves.

        Who can't let something pass is blocked by a number that no robot has; see ``name_of``.
        """
        scene, standing = self._scene, self.settled_laws().packed
        until = self.rides.packed.depart + self.rides.alone + self._holds
        while True:
            found = self._of_robots(
                time_paths(
                    scene.courses,
                    scene.crossings_until(until),
                    scene.rides,
                    self._priorities,
                    left_out,
                    scene.laws_with(standing),
                )
            )
            leaves = self._leaves(found)
            met = scene.comes_to_goals(until, leaves)
            if not met.any():
                return found
            until = np.where(met, leaves, until)

    def improved(
        self, timing: Timing, seconds: float, progress: Callable[[float], None] | None = None
    ) -> Timing:
        """See ``FleetWays``; as it was if somebody would be met at its goal then."""
        scene = self._scene
        until = self._leaves(timing)
        laws = scene.laws_with(timing.laws.packed)
        found = improve_laws(
            scene.courses, scene.crossings_until(until), scene.rides, replace(timing, laws=laws),
            self._priorities, seconds, progress,
            range(len(self.members), len(scene.courses.names)),
        )  # fmt: skip
        sooner = self._of_robots(found)
        is_met = scene.comes_to_goals(until, self._leaves(sooner)).any()
        return timing if is_met else sooner

    def name_of(self, number: int) -> str:
        """What a robot or something that moves is called, by its number in a timing."""
        return self._scene.courses.names[number]

    @cached_property
    def _scene(self) -> CoursesWithMoving:
        return CoursesWithMoving.of(self.courses, self.rides, self.plans, self.moving)

    @property
    def _priorities(self) -> list[float]:
        """Of robots, and of what moves, which is let pass anyway."""
        asked = [one.priority for one in self.members]
        return [*asked, *([float(np.mean(asked))] * (len(self._scene.courses.names) - len(asked)))]

    @property
    def _holds(self) -> Floats:
        """How long each goal has to stay free once its robot is there [s], (n,)."""
        return np.array([hold_of(one) for one in self.members])

    def _leaves(self, timing: Timing) -> Floats:
        """Until when each has to be left alone at its goal [s], (n,); who has no law, never."""
        laws, ends = timing.laws.packed, self.courses.packed.first[1:] - 1
        served = laws.is_timed & np.isfinite(laws.arrive[ends])
        served[list(timing.blocked)] = False
        there = laws.arrive[ends] + self.rides.packed.stays[ends]
        return np.where(served, there, -np.inf) + self._holds

    def _of_robots(self, timing: Timing) -> Timing:
        """A timing without what moves."""
        nodes, count = int(self.courses.packed.first[-1]), len(self.members)
        laws = timing.laws.packed
        kept = PackedLaws(
            laws.arrive[:nodes].copy(), laws.leave[:nodes].copy(), laws.speed[:nodes].copy(),
            laws.is_timed[:count].copy(),
        )  # fmt: skip
        return replace(timing, laws=FleetLaws(kept))


def hold_of(member: FleetMember) -> float:
    """How long a robot has to be left alone at its goal by what moves [s]; 0 if it leaves there."""
    return member.mission.route.hold_s if member.rest == "stay" else 0.0
