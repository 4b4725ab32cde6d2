"""The paths of a fleet looked at here and there, for what is reckoned before it is laid.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.laying.resting_places import RestingPlaces
from viaspline.fleet.timing.rides import FleetRides
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.linked_grid import LinkedGrid, new_linked_grid
from viaspline.kernels.fleet.packed_samples import PackedSamples
from viaspline.kernels.fleet.waits_with import RestGrid

APART_SHARE = 0.45
"""Samples are so far apart, as a share of what two robots keep from each other."""
NOBODY = -1


def samples_of(courses: FleetCourses, rides: FleetRides, among: FleetLaws) -> PackedSamples:
    """Nodes of courses about evenly apart, and when robots are there.

    Nobody rests at its start or its goal by them: other paths keep off those places anyway.

    Args:
        courses: Of the fleet.
        rides: How its robots drive alone.
        among: How they drive among each other.
    """
    packed = courses.packed
    apart = max(2.0 * APART_SHARE * float(packed.reach.min(initial=np.inf)), 1e-3)
    nodes, sizes = [], [0]
    for begin, end in zip(packed.first[:-1].tolist(), packed.first[1:].tolist(), strict=True):
        along = packed.distance[begin:end]
        count = max(int(np.ceil(along[-1] / apart)), 1)
        near = np.searchsorted(along, np.linspace(0.0, along[-1], count + 1))
        nodes.append(begin + np.unique(np.minimum(near, end - begin - 1)))
        sizes.append(len(nodes[-1]))
    chosen = np.concatenate(nodes)
    first = np.cumsum(sizes, dtype=np.int64)
    comes, goes = _when(among, chosen, first)
    alone = np.stack(_when(rides.laws, chosen, first), axis=1)
    return PackedSamples(
        first, np.repeat(np.arange(len(courses.names)), sizes[1:]), packed.distance[chosen],
        packed.place[chosen], comes, goes, alone, packed.reach,
    )  # fmt: skip


def _when(laws: FleetLaws, nodes: Ints, first: Ints) -> tuple[Floats, Floats]:
    """When robots come to nodes, and when they go on [s], each (m,)."""
    comes, goes = laws.packed.arrive[nodes], laws.packed.leave[nodes]
    comes[first[:-1]], goes[first[1:] - 1] = goes[first[:-1]], comes[first[1:] - 1]
    return comes, goes


def grid_of_samples(samples: PackedSamples, spare: float) -> LinkedGrid:
    """A grid in whose neighbouring cells all samples are that may be too near to one.

    Args:
        samples: Of the fleet.
        spare: By how much farther apart samples are than what is too near, at most [m].
    """
    width = 2.0 * float(samples.reach.max(initial=0.0)) + spare
    return new_linked_grid(samples.place, width)


def grid_of_rests(rests: RestingPlaces, courses: FleetCourses, spare: float) -> RestGrid:
    """The resting places of a fleet, found by where they are.

    Args:
        rests: Of all robots.
        courses: Of those that have a path.
        spare: By how much more than they have to others keep off them, at most [m].
    """
    numbers = {name: k for k, name in enumerate(courses.names)}
    owner = np.array([numbers.get(one.robot, NOBODY) for one in rests.places], np.int64)
    reach = float(courses.packed.reach.max(initial=0.0))
    width = reach + float(rests.rows[:, 2].max(initial=0.0)) + spare
    return RestGrid(rests.rows, owner, new_linked_grid(rests.rows[:, :2].copy(), width))
