"""Fleets on straight lines that are timed, to be driven."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from straight_fleets import (
    REACH,
    Line,
    courses_on,
    crossings_on,
    lines_without_rests_in_the_way,
    no_laws,
    rides_on,
)

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.passages import passages_of
from viaspline.kernels.fleet.yielding_ride import timed_in_order

CROSS: list[Line] = [((0.0, 0.0), (40.0, 0.0)), ((20.0, -20.0), (20.0, 20.0))]


def timed_lines(seed: int, count: int) -> list[Line]:
    """Those of some random lines whose robots can be timed one after the other."""
    lines = lines_without_rests_in_the_way(seed, count)
    courses = courses_on(lines, REACH)
    crossings = crossings_on(courses)
    passages = passages_of(courses, crossings)
    found = timed_in_order(
        courses, crossings, passages, rides_on(courses), no_laws(courses), np.arange(len(lines))
    )
    return [line for line, box in zip(lines, found, strict=True) if box == -1]


def driven_on(
    lines: Sequence[Line], order: Sequence[int] | None = None, vanish: bool = False
) -> DrivenFleet:
    """Robots timed one after the other, all of which can be."""
    courses = courses_on(lines, REACH)
    rides, laws = rides_on(courses), no_laws(courses)
    rides = rides._replace(vanishes=np.full(len(lines), vanish))
    crossings = crossings_on(courses)
    numbers = np.arange(len(lines)) if order is None else np.array(order)
    passages = passages_of(courses, crossings)
    assert (timed_in_order(courses, crossings, passages, rides, laws, numbers) == -1).all()
    return fleet_with(courses_names(len(lines)), courses, crossings, laws, rides)


def courses_names(count: int) -> tuple[str, ...]:
    return tuple(f"r{i}" for i in range(count))


def fleet_with(names, courses, crossings, laws, rides) -> DrivenFleet:  # type: ignore[no-untyped-def]
    return DrivenFleet(
        FleetCourses(names, courses), FleetCrossings(crossings), FleetLaws(laws), rides, 0.0
    )


def places_of(run: FleetRun, lines: Sequence[Line], times: Floats) -> Floats:
    """Where the robots of a run were, on the lines themselves, (robots, times, 2)."""
    found = []
    for name, (a, b) in zip(run.names, lines, strict=True):
        begin, end = np.array(a), np.array(b)
        share = run.distance_at(name, times) / np.hypot(*(end - begin))
        found.append(begin + share[:, None] * (end - begin))
    return np.array(found)


def nearest_two(run: FleetRun, lines: Sequence[Line]) -> float:
    """The least distance between any two robots, every 10 ms; after an arrival they stay."""
    places = places_of(run, lines, np.arange(-1.0, run.end_s + 1.0, 0.01))
    return min(
        (
            float(np.hypot(*(places[i] - places[j]).T).min())
            for i in range(len(places))
            for j in range(i)
        ),
        default=np.inf,
    )
