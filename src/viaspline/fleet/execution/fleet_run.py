"""What a fleet drove: the result of a simulation.

Tested through ``fleet/execution/test_simulate_fleet``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.execution.fleet_orders import index_of
from viaspline.fleet.fleet_certificate import FleetCertificate, certify_fleet
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.handed_in import numbers_from, time_from
from viaspline.kernels.arrays import Floats, Ints
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.moving_value import MovingValue
from viaspline.presentable.named_columns import Table, named_columns, stacked_tables
from viaspline.presentable.saved_value import SavedValue
from viaspline.presentable.shown_value import ShownValue
from viaspline.trajectory.trajectory import Trajectory

USUAL_STEP_S = 0.1

FleetEventKind = Literal[
    "waits", "goes on", "swapped", "arrived", "refused", "ignored", "dead", "taken out", "silent",
    "added", "stops", "re-planned", "has no way", "strayed", "too near",
]  # fmt: skip


@dataclass(frozen=True)
class FleetEvent:
    """Something that happened to a fleet under way.

    Attributes:
        kind: What.
        time: When [s].
        name: To which robot.
        message: A sentence about it.
        other: The other robot that has to do with it.
        at_m: Where along the path of ``name`` [m].
    """

    kind: FleetEventKind
    time: float
    name: str
    message: str
    other: str | None = None
    at_m: float | None = None


def swapped_event(first: str, second: str, time: float) -> FleetEvent:
    """The order of two robots in a crossing was swapped."""
    return FleetEvent("swapped", time, first, f"{first} passes before {second}", second)


def swapped_events(
    names: tuple[str, ...], before: Ints, after: Ints, time: float
) -> list[FleetEvent]:
    """The orders of crossings that were swapped.

    Args:
        names: Of the robots.
        before: Who was to pass each crossing first, (c,).
        after: Who is now, (c,).
        time: When that is [s].
    """
    pairs = np.column_stack((after, before))[before != after].tolist()
    return [swapped_event(names[one], names[two], time) for one, two in pairs]


@dataclass(frozen=True, eq=False)
class FleetRun(ShownValue, MovingValue, SavedValue, ComparedByValue):
    """A drive of a fleet that was simulated.

    Attributes:
        arrivals: When each robot arrived [s], by name; those that never did are left out. A patrol
            that never ends has arrived when it is back from the last lap of its plan.
        delays: How much later than planned that was [s], by name, but of patrols that never end.
        events: What happened, in the order of time.
        deadlock: The robots that wait for each other for ever; none if the orders are acyclic.
        courses: As far as they were driven, with a node wherever a robot's acceleration changed.
        laws: When each robot was where on these: exactly what was driven.
        required: The separation that the plan keeps [m].
        end_s: When the simulation ended [s].
        by_clock: The laws of those that drove by the clock of their plan, by name; their
            acceleration may change between nodes as well.
    """

    arrivals: dict[str, float]
    delays: dict[str, float]
    events: tuple[FleetEvent, ...]
    deadlock: tuple[str, ...]
    courses: FleetCourses
    laws: FleetLaws
    required: float
    end_s: float
    by_clock: Mapping[str, Trajectory] = field(default_factory=dict)

    def __repr__(self) -> str:
        return (
            f"FleetRun({len(self.arrivals)} of {len(self.names)} robots arrived in "
            f"{self.end_s:.1f} s, {self.mean_delay:.1f} s later than planned in the mean, "
            f"{len(self.events)} events)"
        )

    @property
    def names(self) -> tuple[str, ...]:
        """The robots, in the order of the courses."""
        return self.courses.names

    @property
    def reached(self) -> bool:
        """Whether all robots arrived that have a law; who isn't served stands at its start."""
        laws, first = self.laws.packed, self.courses.packed.first
        drives = laws.is_timed & np.isfinite(laws.arrive[first[1:] - 1])
        return all(
            name in self.arrivals for name, is_driven in zip(self.names, drives, strict=True)
            if is_driven
        )  # fmt: skip

    @cached_property
    def certificate(self) -> FleetCertificate:
        """The least separation of any two robots as they drove, proven over continuous time."""
        return certify_fleet(self.courses, self.laws, self.required)

    @property
    def mean_delay(self) -> float:
        """Of those that arrived [s]; 0 if none did."""
        return float(np.mean(list(self.delays.values()))) if self.delays else 0.0

    def samples(self, step: float = USUAL_STEP_S) -> Table:
        """How far each robot had come, as a table, which pandas and polars take as it is.

        Args:
            step: From one moment to the next, at most [s]; the beginning and the end are among
                them.

        Returns:
            A structured array, (n,), of ``robot``, ``time_s`` and ``distance_m`` along its path.

        Raises:
            GeometryError: When the step is no time above 0.
        """
        count = math.ceil(self.end_s / time_from("step", step)) + 1
        times = np.linspace(0.0, self.end_s, max(count, 2))
        return stacked_tables(
            "robot",
            {
                name: named_columns({"time_s": times, "distance_m": self.distance_at(name, times)})
                for name in self.names
            },
        )

    def distance_at(self, name: str, times: Floats) -> Floats:
        """How far a robot had come at some times [m], exactly, (t,).

        Raises:
            GeometryError: There is no such robot, or these are no times.
        """
        courses, laws = self.courses.packed, self.laws.packed
        robot, times = index_of(self.names, name), numbers_from("times", times)
        if name in self.by_clock:
            return np.asarray(self.by_clock[name].distance_at(times))
        nodes = slice(int(courses.first[robot]), int(courses.first[robot + 1]))
        along, arrive, leave = courses.distance[nodes], laws.arrive[nodes], laws.leave[nodes]
        k = np.clip(np.searchsorted(arrive, times, side="right") - 1, 0, along.size - 2)
        late, lasts = np.maximum(times - leave[k], 0.0), arrive[k + 1] - leave[k]
        part = np.divide(late, lasts, out=np.ones_like(late), where=late < lasts)
        begin, end = laws.speed[nodes][k], laws.speed[nodes][k + 1]
        both = begin + end
        speeding = (2.0 * begin + (end - begin) * part) * part
        gone = np.divide(speeding, both, out=part.copy(), where=both > 0.0)
        distance: Floats = along[k] + gone * (along[k + 1] - along[k])
        return np.minimum(distance, along[k + 1])  # the end of a path is no place beyond it
