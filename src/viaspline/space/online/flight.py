"""A flight so far: what was flown, what is to be, and what is known by now.

Tested through ``space/online/test_fly``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from viaspline.mission.model import Mission
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.online.retimed_ahead import SAME_PLACE_M, going_on, standing
from viaspline.space.online.sightings import UnseenSolid
from viaspline.space.online.solid_tracks import SolidTracks
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.spatial_run import SpatialReplan
from viaspline.trajectory.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
class Flight:
    """A flight so far.

    Attributes:
        legs: What was flown, and at last what is, or is to be as soon as its law begins.
        problems: What each of them solves; the last one in the world as it is known.
        known: The mission with all that was seen on its map.
        unseen: What nobody has seen yet.
        replans: Where the path was changed.
        reason: Why it ended before the goal.
        tracks: What is in sight of what moves and isn't on the map.
        timed_at: When the last law past that was looked for [s].
        gives_way: Whether it comes later for it.
        stands_since: When it began to stand without a way on [s]; infinite: it doesn't.
        held_by: What it last found no way past.
        broken: What was seen to do what nothing does by the mission, in words.
    """

    legs: tuple[FlownLeg, ...]
    problems: tuple[SpatialProblem, ...]
    known: Mission
    unseen: tuple[UnseenSolid, ...]
    replans: tuple[SpatialReplan, ...] = ()
    reason: str = ""
    tracks: SolidTracks = field(default_factory=lambda: SolidTracks(0.0))
    timed_at: float = -math.inf
    gives_way: bool = False
    stands_since: float = math.inf
    held_by: str = ""
    broken: tuple[str, ...] = ()

    @property
    def problem(self) -> SpatialProblem:
        """What the last leg solves."""
        return self.problems[-1]

    @property
    def climb(self) -> float:
        """How far the last leg climbs straight up from the ground [m]; 0: it doesn't."""
        takes_off = self.problem.takeoff is not None
        return float(self.legs[-1].path.distance(1.0)) if takes_off else 0.0

    @property
    def end_time(self) -> float:
        """When it is over [s]."""
        return min(self.legs[-1].until, self.legs[-1].law.end_time)

    def ahead_of(self, now: float) -> tuple[FlownLeg, ...]:
        """What is flown from a time on [s], the leg that is under way first."""
        return self.legs[-1:] if self.legs[-1].law.start_time <= now else self.legs[-2:]

    def without_pending(self, now: float) -> Flight:
        """It without a leg that was to begin after a time [s]."""
        if len(self.ahead_of(now)) == 1:
            return self
        under_way = replace(self.legs[-2], until=np.inf)
        before = replace(self.problems[-2], world=self.problem.world)  # what is known stays known
        return replace(
            self, legs=(*self.legs[:-2], under_way), problems=(*self.problems[:-2], before),
            replans=self.replans[:-1],
        )  # fmt: skip

    def with_law(self, law: Trajectory) -> Flight:
        """It with another law of the last leg, from where that begins."""
        leg = self.legs[-1]
        changed = replace(leg, law=going_on(leg.law, law))
        return replace(self, legs=(*self.legs[:-1], changed))

    def is_held(self) -> bool:
        """Whether its law ends before its path does."""
        leg = self.legs[-1]
        return float(leg.law.distances[-1]) < leg.path.length - SAME_PLACE_M

    def standing_until(self, time: float) -> Flight:
        """It with a robot that stays until a time [s] at least, if it is held."""
        law = self.legs[-1].law
        if not self.is_held() or law.end_time >= time:
            return self
        return self.with_law(standing(float(law.distances[-1]), law.end_time, time))
