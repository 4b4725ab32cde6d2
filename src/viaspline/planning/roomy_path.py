"""Paths that keep more than is required, as much as costs little time.

Obstacles are grown, each as far as the gaps beside it and the via points near to it allow, and the
path is laid anew. So a narrow gap takes nothing away from the room elsewhere. Maps aren't grown:
in a world with maps the path keeps more from everything, or from nothing.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.errors import PlanningError
from viaspline.planning.alternatives.record import Account
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.checking.driving_time import driving_time
from viaspline.planning.methods.ordered import roomy_methods_for
from viaspline.planning.past_zones import find_path_past_zones
from viaspline.planning.plan_path import lay_path
from viaspline.planning.problem.preferred_clearance import PreferredClearance, TriedClearance
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.routing.spare_room import spare_room
from viaspline.world.grown_obstacle import grown_world
from viaspline.world.world import World

SHARES = (1.0, 0.5, 0.25)  # of what is preferred, the most first
MOST_LATER = 0.01  # that a path may take that keeps more, of the time of one that doesn't
MOST_LATER_S = 5.0


def find_roomy_path(sequence: ViaSequence, world: World, requirements: Requirements) -> Solution:
    """A proven path that keeps more than is required, where that costs little time.

    Its certificate promises what is required.

    Raises:
        NoPathError: When there is none that keeps what is required.
        GaveUpError: When a budget ran out before that was known.
    """
    found = find_path_past_zones(sequence, world, requirements)
    if requirements.preferred <= 0.0 or not len(world) or not isinstance(found.account, Account):
        return found
    duration = _duration(found.account.spline_path, sequence, requirements)
    most = duration + min(MOST_LATER * duration, MOST_LATER_S)
    tried: list[TriedClearance] = []
    for more in _roomier(sequence, found.account.world, requirements):
        roomy = _laid(sequence, more, world, requirements)
        if roomy is None:
            tried.append(TriedClearance(more.clearance, None, taken=False))
            continue
        takes = _duration(roomy[0], sequence, requirements)
        tried.append(TriedClearance(more.clearance, takes, taken=takes <= most))
        if takes <= most:
            found = _solution(*roomy, world, requirements)
            break
    assert isinstance(found.account, Account)
    weighed = PreferredClearance(requirements.preferred, duration, most, tuple(tried))
    return replace(found, account=replace(found.account, preferred=weighed))


@dataclass(frozen=True)
class _Roomier:
    """What a path is laid in and has to keep, so that it keeps more than it must.

    Attributes:
        clearance: How much more, where there is room for it [m].
        world: With grown obstacles.
        requirements: Of paths in that world.
    """

    clearance: float
    world: World
    requirements: Requirements


def _roomier(sequence: ViaSequence, world: World, requirements: Requirements) -> Iterator[_Roomier]:
    """What is tried, the most clearance first."""
    if world.are_maps.any():
        for share in SHARES:
            more = share * requirements.preferred
            kept = replace(requirements, clearance=requirements.clearance + more)
            yield _Roomier(more, world, kept)
        return
    places = np.array([via.at[:2] for via in sequence.vias])
    room = spare_room(world, places, requirements.required, requirements.preferred)
    for share in SHARES:
        more = share * requirements.preferred
        yield _Roomier(more, grown_world(world, np.minimum(room, more)), requirements)


def _laid(
    sequence: ViaSequence, more: _Roomier, world: World, requirements: Requirements
) -> tuple[SplinePath, Account] | None:
    """A path that keeps more, if one is found that keeps what is required in the world as it is."""
    methods = roomy_methods_for(requirements, sequence.places)
    try:
        spline_path, account = lay_path(sequence, more.world, more.requirements, methods)
    except PlanningError:
        return None
    path = Path(spline_path.spans, spline_path.vias)
    return (spline_path, account) if proven(path, world, requirements).holds else None


def _solution(
    spline_path: SplinePath, account: Account, world: World, requirements: Requirements
) -> Solution:
    """A path that was laid among grown obstacles, in the world as it is."""
    path = Path(spline_path.spans, spline_path.vias)
    return Solution(path, proven(path, world, requirements), replace(account, measured_in=world))


def _duration(spline_path: SplinePath, sequence: ViaSequence, requirements: Requirements) -> float:
    rests = spline_path.rests(sequence)
    return driving_time(spline_path.spans, requirements.objective.pace, rests)
