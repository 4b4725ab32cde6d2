"""Why a via point can't be served where it is, and the least change that would serve it.

Tested through ``test_planner``.
"""

from __future__ import annotations

import numpy as np

from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.errors import Change, NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import RouteVia, ViaSequence
from viaspline.planning.routing.free_rooms import SPARE_M, are_joined, places_reached
from viaspline.world.world import World

RING_PLACES = 180  # on a ring round a via point
MAX_RINGS = 60  # on which a free place is sought
FIRST_RING, RING_GROWTH = 0.05, 1.25  # the first one's radius in required distances; each next one
BISECTIONS = 30  # of the way back from a free place


def refuse_blocked_vias(sequence: ViaSequence, world: World, requirements: Requirements) -> None:
    """Raise NoPathError for the first via point that has not the room that is required."""
    at = np.array([via.at[:2] for via in sequence.vias])
    distance, index = world.nearest(at)
    has_room = distance >= requirements.required - PROOF_SLACK_M
    for k in np.flatnonzero(~has_room).tolist():
        beside = [i for i in _neighbours(sequence, k) if has_room[i]]
        raise _no_room(
            sequence.vias[k], float(distance[k]), int(index[k]), at[beside], world, requirements
        )


def _neighbours(sequence: ViaSequence, k: int) -> list[int]:
    """The via points before and after one."""
    count = len(sequence.vias)
    around = {(k - 1) % count, (k + 1) % count} if sequence.closed else {k - 1, k + 1}
    return sorted(i for i in around if 0 <= i < count and i != k)


def _place_instead(at: Floats, beside: Floats, world: World, required: float) -> Floats | None:
    """Where a via point could be, with the room and with ways from its neighbours.

    Args:
        at: The via point [m], (2,).
        beside: Its neighbours that have the room themselves [m], (n, 2).
        world: What is to be kept clear of.
        required: Distance to keep [m].
    """
    nearest = _nearest_free(at, world, required)
    if nearest is None or not len(beside) or are_joined([nearest, *beside], world, required):
        return nearest
    return places_reached([(at, list(beside))], world, required)[0]


def _no_room(
    via: RouteVia, room: float, index: int, beside: Floats, world: World,
    requirements: Requirements,
) -> NoPathError:  # fmt: skip
    name = world.name(index)
    moves, changes = _what_helps(via, room, beside, world, requirements)
    missing = requirements.required - room
    what = "outside" if index < -1 and room < 0 else f"{missing:.3f} m inside the clearance of"
    under_way = via.index is None  # a place of the path itself: not one that a user could move
    lies = f"{via.name} is" if under_way else f"via point {via.name!r} lies"
    return NoPathError(
        f"{lies} {what} {name!r}",
        where=via.at,
        remedy=" or ".join(moves) or ("make room there" if under_way else "move it"),
        via=via.name,
        obstacles=(name,),
        changes=changes,
    )


def _what_helps(
    via: RouteVia, room: float, beside: Floats, world: World, requirements: Requirements
) -> tuple[list[str], tuple[Change, ...]]:
    """What would serve a via point, in words and as changes of the mission.

    A robot under way is where it is: nothing is looked for then, which would take longer than all
    that is laid in its step.
    """
    if via.index is None:
        return [], ()
    place = _place_instead(via.at[:2], beside, world, requirements.required)
    free = room - requirements.radius - requirements.tracking_error
    moves = [] if place is None else [f"move it to ({place[0]:.3f}, {place[1]:.3f})"]
    changes = change_moving(via, place)
    most = float(np.floor(free * 1000) / 1000)
    kept = requirements.radius + requirements.tracking_error + most
    if 0 <= free < requirements.clearance and are_joined([via.at, *beside], world, kept - SPARE_M):
        moves.append(f"set robot.clearance_m to at most {most:.3f}")
        changes += (Change("robot.clearance_m", most),)
    return moves, changes


def change_moving(via: RouteVia, place: Floats | None) -> tuple[Change, ...]:
    """The change that moves a via point to a place [m], shape (2,), if there is one."""
    if place is None or not via.key:
        return ()
    at = [round(x, 3) for x in place.tolist()]
    return (Change(f"{via.key}.at", (*at, *via.at[2:].tolist())),)


def _nearest_free(at: Floats, world: World, required: float) -> Floats | None:
    """A place near ``at`` with the room that is required: rings of growing radius, then closer."""
    angles = np.linspace(0, 2 * np.pi, RING_PLACES, endpoint=False)
    ring = np.column_stack((np.cos(angles), np.sin(angles)))
    radius = FIRST_RING * max(required, 1e-3)
    for _ in range(MAX_RINGS):
        places = at[:2] + radius * ring
        free = np.flatnonzero(world.distance(places) >= required)
        if free.size:
            return _pulled_back(at[:2], places[free[0]], world, required)
        radius *= RING_GROWTH
    return None


def _pulled_back(at: Floats, place: Floats, world: World, required: float) -> Floats:
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        if world.distance(at + middle * (place - at)) >= required + 1e-3:
            high = middle
        else:
            low = middle
    found: Floats = at + high * (place - at)
    return found
