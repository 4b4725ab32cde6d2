"""Who passes first wherever two paths of a fleet come near each other, and who waits for it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.crossing_leaders import crossing_leaders
from viaspline.kernels.fleet.passing_order import passing_gaps

TIGHT_S = 1e-3
"""Who comes so soon after another one has left waited for it [s]."""


@dataclass(frozen=True)
class Precedence:
    """Who passes first where two paths come near each other.

    The second may be in the crossing while the first still is, as far behind it as they have to
    be apart: on a stretch that both drive the same way it follows.

    Attributes:
        first: The name of the robot that passes first.
        second: The name of the one that passes after it.
        leaves_at: Where along the path of the first one all of the crossing is behind it [m].
        enters_at: Where along the path of the second one the crossing begins [m]: from there on
            it would be too near to some place of the first one's part.
        waits_s: How much later the second one comes for it [s]; 0 where it comes later anyway.
    """

    first: str
    second: str
    leaves_at: float
    enters_at: float
    waits_s: float = 0.0


def precedences_of(
    courses: FleetCourses, crossings: FleetCrossings, laws: FleetLaws, alone: FleetLaws
) -> tuple[Precedence, ...]:
    """Who passes first at every crossing of two robots that drive, in the order of the crossings.

    Args:
        courses: The paths of the fleet.
        crossings: Where these come near each other.
        laws: When each robot is where.
        alone: When each would be where if it were alone.
    """
    leaders, _ = crossing_leaders(courses.packed, crossings.packed, laws.packed)
    waits = waits_at(courses, crossings, laws, alone, np.arange(len(courses.names)))
    driven = np.flatnonzero(drive_both(courses, crossings, laws))
    return precedences_among(courses.names, crossings, leaders, waits, driven)


def precedences_among(
    names: tuple[str, ...], crossings: FleetCrossings, leaders: Ints, waits: Floats, chosen: Ints
) -> tuple[Precedence, ...]:
    """Who passes first at some crossings.

    Args:
        names: Of the robots.
        crossings: The crossings.
        leaders: Who passes each of them first, (c,).
        waits: How much later it makes its second robot come [s], (c,).
        chosen: Which crossings are asked for, (k,).
    """
    robots, span = crossings.robots[chosen], crossings.span[chosen]
    later = (leaders[chosen] == robots[:, 1])[:, None]
    ranked = np.where(later, robots[:, ::-1], robots).tolist()
    places = np.where(later, span[:, [3, 0]], span[:, [1, 2]]).tolist()
    return tuple(
        Precedence(names[first], names[second], left, entered, waited)
        for (first, second), (left, entered), waited in zip(
            ranked, places, waits[chosen].tolist(), strict=True
        )
    )


def drive_both(courses: FleetCourses, crossings: FleetCrossings, laws: FleetLaws) -> Flags:
    """Whether both robots of each crossing drive, (c,)."""
    drives = np.isfinite(laws.packed.arrive[courses.packed.first[1:] - 1])
    robots = crossings.robots
    both: Flags = drives[robots[:, 0]] & drives[robots[:, 1]]
    return both


def waits_at(
    courses: FleetCourses, crossings: FleetCrossings, laws: FleetLaws, alone: FleetLaws,
    robots: Ints,
) -> Floats:  # fmt: skip
    """How much later crossings make some robots come that pass them second [s], (c,).

    Args:
        courses: The paths of the fleet.
        crossings: Where these come near each other; boxes of other robots may be left out.
        laws: When each robot is where.
        alone: When each would be where if it were alone.
        robots: Which ones, (k,).
    """
    gaps = passing_gaps(courses.packed, crossings.packed, laws.packed)
    waits = np.zeros(len(crossings.packed.robots))
    for robot in robots.tolist():
        for box, lost in held_at(courses, crossings, laws, alone, gaps, robot):
            waits[crossings.packed.crossing[box]] += lost
    return waits


def held_at(
    courses: FleetCourses, crossings: FleetCrossings, laws: FleetLaws, alone: FleetLaws,
    gaps: Floats, robot: int,
) -> list[tuple[int, float]]:  # fmt: skip
    """The boxes that a robot waits for, in their order along its path, and how long for each [s].

    A robot comes to a crossing that it waited for just when the other one has left it. What it is
    late by there, beyond what it was late by at the one before, it is late for this one.

    Args:
        courses: The paths of the fleet.
        crossings: Where these come near each other.
        laws: When each robot is where.
        alone: When each would be where if it were alone.
        gaps: See ``passing_gaps``, (boxes,).
        robot: Which one.
    """
    packed = crossings.packed
    begin, end = packed.box_first[robot : robot + 2].tolist()
    own = gaps[begin:end]
    tight = begin + np.flatnonzero((own >= 0.0) & (own < TIGHT_S))
    cells = packed.cell[tight]
    late = laws.packed.arrive[cells] - alone.packed.arrive[cells]
    found, before = [], 0.0
    for box, now in zip(tight.tolist(), late.tolist(), strict=True):
        if now > before + TIGHT_S:
            found.append((box, now - before))
            before = now
    return found
