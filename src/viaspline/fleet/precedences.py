"""Who passes first wherever two paths of a fleet come near each other, and who waits for it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.passing_order import passing_gaps

TIGHT_S = 1e-3
"""Who comes so soon after another one has left waited for it [s]."""


@dataclass(frozen=True)
class Precedence:
    """Who passes first where two paths come near each other.

    Attributes:
        first: The name of the robot that passes first.
        second: The name of the one that passes after it.
        leaves_at: Where along its path the first one has passed [m].
        enters_at: From where along its path the second one would be too near [m].
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
    """Who passes first at every crossing, in the order of the crossings.

    Args:
        courses: The paths of the fleet.
        crossings: Where these come near each other.
        laws: When each robot is where.
        alone: When each would be where if it were alone.
    """
    packed, nodes = crossings.packed, courses.packed
    count = len(packed.robots)
    owner = np.repeat(np.arange(nodes.reach.size), np.diff(packed.box_first))
    gaps = passing_gaps(nodes, packed, laws.packed)
    is_first_later = np.zeros(count, np.bool_)  # of the two, the one with the lower number
    mine = (gaps >= 0.0) & (owner == packed.robots[packed.crossing, 0])
    is_first_later[packed.crossing[mine]] = True
    waits = _waits(crossings, laws, alone, gaps, owner)
    later = is_first_later[:, None]
    ranked = np.where(later, packed.robots[:, ::-1], packed.robots).tolist()
    places = np.where(later, packed.span[:, [3, 0]], packed.span[:, [1, 2]]).tolist()
    names = courses.names
    return tuple(
        Precedence(names[first], names[second], left, entered, waited)
        for (first, second), (left, entered), waited in zip(
            ranked, places, waits.tolist(), strict=True
        )
    )


def _waits(
    crossings: FleetCrossings, laws: FleetLaws, alone: FleetLaws, gaps: Floats, owners: Ints
) -> Floats:
    """How much later each crossing makes its second robot come [s], (c,).

    A robot comes to a crossing that it waited for just when the other one has left it. What it is
    late by there, beyond what it was late by at the one before, it is late for this one.
    """
    packed = crossings.packed
    late = laws.packed.arrive - alone.packed.arrive
    waits = np.zeros(len(packed.robots))
    tight = np.flatnonzero((gaps >= 0.0) & (gaps < TIGHT_S))
    now = late[packed.cell[tight]]
    robot, before = -1, 0.0
    for crossing, owner, lateness in zip(
        packed.crossing[tight].tolist(), owners[tight].tolist(), now.tolist(), strict=True
    ):
        if owner != robot:
            robot, before = owner, 0.0
        if lateness > before + TIGHT_S:
            waits[crossing] += lateness - before
            before = lateness
    return waits
