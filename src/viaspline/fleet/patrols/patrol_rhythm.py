"""One period for all patrols of a fleet, in which each drives its laps clear of the others.

Patrols are timed one after the other, each among the laps of those before it, which come again
every period, before as well as after. Where one needs longer than the period, for its way or for
those that it lets pass, it is timed before the others and all anew; where that doesn't help either,
in some orders, the period gets longer. One that finds no time from
when it may set out tries to set out when one of the others is back home. Where no patrol passes the
start of another, this comes to an end: in a period as long as all laps together each can wait at
home until all others are back.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.errors import GaveUpError
from viaspline.fleet.courses import AnyPlan, FleetCourses, courses_along, fleet_path
from viaspline.fleet.crossings import FleetCrossings, crossings_of
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.patrols.driven_laps import driven_laps, seams_of, stay_between, write_law
from viaspline.fleet.patrols.repeated_laws import repeated_law, set_out
from viaspline.fleet.timing.rides import FleetRides, rides_of
from viaspline.fleet.timing.time_paths import standing_laws
from viaspline.fleet.timing.timed_trajectory import timed_trajectory
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.packed_passages import PackedPassages
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.yielding_ride import CLEAR, timed_in_order
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.planning.plan_drive import repeated
from viaspline.trajectory.trajectory import Trajectory

MOST_LAPS_A_PERIOD = 8
"""A patrol whose lap is short drives several in a period, up to so many."""
WINDOW = 5
"""Periods that a lap is timed among: one before it, and three after that in which it may begin."""
MOST_TIMED = 1000
"""Rounds that are timed in other orders before a period gets longer."""
LONGER_SHARE = 1.08
"""By so much a period grows that is too short."""
LONGEST_SHARE = 4.0
"""Of all laps together: a period gets no longer than that."""
MOST_DEPARTURES = 60
"""So many times at which others are back home are tried by one that finds no time before."""
SAME_S = 1e-9
"""Times that are no farther apart are one."""


@dataclass(frozen=True, eq=False)
class PatrolRhythm:
    """What patrols do in a period.

    Attributes:
        period: [s].
        rounds: What each drives in a period, by name: so many laps, with the law of one that is
            alone.
        laps: How many these are, by name.
        laws: When it drives them, by name: from when it sets out, which is in the first period
            after it may, until it is back.
    """

    period: float
    rounds: dict[str, AnyPlan]
    laps: dict[str, int]
    laws: dict[str, Trajectory]


def patrol_rhythm(
    members: Sequence[FleetMember], laps: Mapping[str, AnyPlan], separation: float
) -> PatrolRhythm:
    """Time patrols among each other, so that all of it comes again every period.

    Args:
        members: The patrols. None passes the start of another.
        laps: One lap of each, by name.
        separation: Free space between any two bodies [m].

    Raises:
        GaveUpError: They find no common period; ``obstacles`` names who finds no time for its lap,
            and who is in its way.

    Example:
        >>> from viaspline.mission.fleet.fleet import Fleet
        >>> from viaspline.planner import plan
        >>> fleet = Fleet.model_validate({"fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "via": [[20, 0]], "closed": True}},
        ...     {"name": "b", "route": {"start": [10, 9], "via": [[10, -60]], "closed": True}},
        ... ]})
        >>> one_lap = {one.name: plan(one.mission) for one in fleet.members}
        >>> rhythm = patrol_rhythm(fleet.members, one_lap, 0.5)
        >>> rhythm.laps, rhythm.period < 1.1 * one_lap["b"].trajectory.duration
        ({'a': 3, 'b': 1}, True)
    """
    timing = _RoundTiming.of(members, laps, separation)
    period = timing.shortest
    while True:
        found = timing.timed_in_some_order(period)
        if isinstance(found, dict):
            break
        longest, who, whom = found
        period = max(LONGER_SHARE * period, longest)
        if period > LONGEST_SHARE * timing.together:
            raise GaveUpError(
                f"'{who}' finds no time for its lap: '{whom}' is in its way",
                where=laps[who].path.stops[0][0].at,
                remedy=f"give '{whom}' or '{who}' a number of laps, or another route",
                tried=("a common period of all patrols",),
                obstacles=(who, whom),
            )
    return PatrolRhythm(period, timing.rounds, timing.laps, found)


@dataclass(frozen=True, eq=False)
class _RoundTiming:
    """What is timed: the round of each patrol, and behind these as much of all of them as matters.

    Attributes:
        members: The patrols.
        laps: How many laps are a round, by name.
        rounds: By name.
        courses: The rounds, and then several of them behind each other.
        crossings: Where a round comes near to something else.
        passages: Of these.
        rides: How rounds are driven alone.
        seams: Where the rounds behind each other begin and end [m], by name.
        stays: How long each robot has to stand between two laps, as for a turn on the spot [s],
            (n,).
    """

    members: Sequence[FleetMember]
    laps: dict[str, int]
    rounds: dict[str, AnyPlan]
    courses: FleetCourses
    crossings: FleetCrossings
    passages: PackedPassages
    rides: FleetRides
    seams: dict[str, Floats]
    stays: Floats

    @classmethod
    def of(
        cls, members: Sequence[FleetMember], laps: Mapping[str, AnyPlan], separation: float
    ) -> _RoundTiming:
        """Rounds of about the same length."""
        longest = max(laps[one.name].trajectory.duration for one in members)
        counts = {
            one.name: min(
                max(int(longest / max(laps[one.name].trajectory.duration, SAME_S)), 1),
                MOST_LAPS_A_PERIOD,
            )
            for one in members
        }
        rounds = {name: driven_laps(laps[name], count) for name, count in counts.items()}
        paths = [fleet_path(plan, separation) for plan in rounds.values()]
        alone = courses_along(tuple(rounds), paths)
        windows, seams = [], {}
        for robot, name in enumerate(rounds):
            path = repeated(laps[name].path, WINDOW * counts[name])
            ends = seams_of(path, WINDOW * counts[name])[:: counts[name]]
            first, last = alone.packed.first[robot : robot + 2]
            nodes = alone.packed.distance[first:last]
            knots = np.concatenate([nodes[:-1] + end for end in ends[:-1]])
            windows.append(replace(paths[robot], path=path, knots=knots))
            seams[name] = ends
        names = (*rounds, *(f"{name} again" for name in rounds))
        courses = courses_along(names, [*paths, *windows])
        crossings = crossings_of(courses, np.arange(len(rounds)))
        passages = passages_of(courses.packed, crossings.packed)
        rides = rides_of(members, list(rounds.values()), alone)
        stays = np.array([stay_between(laps[name]) for name in rounds])
        return cls(members, counts, rounds, courses, crossings, passages, rides, seams, stays)

    @property
    def shortest(self) -> float:
        """The least period [s]."""
        return max(float(self._takes.max()), SAME_S)

    @property
    def together(self) -> float:
        """All rounds behind each other [s]."""
        return max(float(self._takes.sum()), SAME_S)

    @property
    def _takes(self) -> Floats:
        """From when each sets out until it can do so again, if it is alone [s], (n,)."""
        rounds = self.rounds.values()
        return np.array([set_out(one.trajectory).duration for one in rounds]) + self.stays

    def timed_in_some_order(self, period: float) -> dict[str, Trajectory] | tuple[float, str, str]:
        """The laws of all rounds by name; or what one takes [s], which, and who is in its way.

        Who finds no time comes before the others of its priority in the next order.
        """
        order, tried = self._order(), set[tuple[int, ...]]()
        names = [one.name for one in self.members]
        first: tuple[float, str, str] | None = None
        while tuple(order) not in tried and len(tried) <= MOST_TIMED // len(order):
            tried.add(tuple(order))
            found = self._timed(period, order)
            if isinstance(found, dict):
                return found
            first = first or found
            late = names.index(found[1])
            rank = self.members[late].priority
            at = next(k for k, robot in enumerate(order) if self.members[robot].priority == rank)
            order.remove(late)
            order.insert(at, late)
        assert first is not None
        return first

    def _timed(
        self, period: float, order: Sequence[int]
    ) -> dict[str, Trajectory] | tuple[float, str, str]:
        """The laws, or what one takes, of rounds that are timed one after the other in an order."""
        laws = standing_laws(self.courses)
        departs = self.rides.packed.depart
        found: dict[str, Trajectory] = {}
        for robot in order:
            name = self.members[robot].name
            law = self._soonest(robot, period, laws, list(found.values()))
            if isinstance(law, tuple):
                takes, rival = law
                return takes, name, self.members[rival].name
            self._write(robot, law, period, laws)
            later = math.floor(float(departs[robot]) / period) * period
            found[name] = law.delayed(later)
        return {one.name: found[one.name] for one in self.members}

    def _soonest(
        self, robot: int, period: float, laws: FleetLaws, others: Sequence[Trajectory]
    ) -> Trajectory | tuple[float, int]:
        """A law that fits the period, of the first departure with which there is one.

        Or what the shortest that was found takes [s], 0 for none, and who is in the way.
        """
        shortest, rival = 0.0, -1
        for depart in self._departures(robot, period, others):
            law = self._law(robot, depart, period, laws)
            if isinstance(law, int):
                rival = law if rival < 0 else rival
                continue
            lasts = law.duration + float(self.stays[robot])
            if lasts <= period + SAME_S and law.end_time <= (WINDOW - 2) * period:
                return law
            lasts = min(lasts, LONGER_SHARE * period)
            shortest = min(shortest, lasts) if shortest > 0.0 else lasts
        return shortest, rival if rival >= 0 else self._rival(robot, laws)

    def _law(self, robot: int, depart: float, period: float, laws: FleetLaws) -> Trajectory | int:
        """The law of one round from a departure [s] on, or who lets it find none."""
        count, packed = len(self.members), self.courses.packed
        departs = self.rides.packed.depart % period
        departs[robot] = depart
        rides = replace(self.rides, packed=self.rides.packed._replace(depart=departs))
        (box,) = timed_in_order(
            packed, self.crossings.packed, self.passages, rides.packed, laws.packed,
            np.array([robot], np.int64),
        )  # fmt: skip
        if box != CLEAR:
            return int(self.crossings.packed.other[box]) % count
        laws.packed.is_timed[robot] = False
        static = self.rounds[self.members[robot].name].trajectory
        return set_out(timed_trajectory(static, self.courses, rides, laws, robot))

    def _departures(
        self, robot: int, period: float, others: Sequence[Trajectory]
    ) -> Iterator[float]:
        """When it may set out, and then when each of the others is back home [s]."""
        first = float(self.rides.packed.depart[robot]) % period
        yield first
        back = sorted({first + (law.end_time - first) % period for law in others})
        yield from back[:MOST_DEPARTURES]

    def _rival(self, robot: int, laws: FleetLaws) -> int:
        """Who of those that have their times is met most often by one that takes too long."""
        count, packed = len(self.members), self.crossings.packed
        of_robot = slice(int(packed.box_first[robot]), int(packed.box_first[robot + 1]))
        met = packed.other[of_robot]
        met = met[laws.packed.is_timed[met]] % count
        met = met[met != robot]
        return int(np.bincount(met).argmax()) if len(met) else robot

    def _order(self) -> list[int]:
        """Who is timed before whom: by priority, and then the longest round first."""
        ranks = [
            (-one.priority, -float(alone), robot)
            for robot, (one, alone) in enumerate(zip(self.members, self.rides.alone, strict=True))
        ]
        return [rank[-1] for rank in sorted(ranks)]

    def _write(self, robot: int, law: Trajectory, period: float, laws: FleetLaws) -> None:
        """Let the rounds of a patrol come again every period, for those that are timed after it."""
        begun = law.delayed((law.start_time % period) - law.start_time - period)
        again = repeated_law(begun, self.seams[self.members[robot].name], period)
        write_law(again, self.courses, len(self.members) + robot, laws)
