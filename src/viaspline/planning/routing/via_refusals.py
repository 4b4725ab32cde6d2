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
from viaspline.world.world import World

RING_PLACES = 180  # on a ring round a via point
MAX_RINGS = 60  # on which a free place is sought
FIRST_RING, RING_GROWTH = 0.05, 1.25  # the first one's radius in required distances; each next one
BISECTIONS = 30  # of the way back from a free place


def refuse_blocked_vias(sequence: ViaSequence, world: World, requirements: Requirements) -> None:
    """Raise NoPathError for the first via point that has not the room that is required."""
    at = np.array([via.at[:2] for via in sequence.vias])
    distance, index = world.nearest(at)
    for via, room, nearest in zip(sequence.vias, distance, index, strict=True):
        if room < requirements.required - PROOF_SLACK_M:
            raise _no_room(via, float(room), int(nearest), world, requirements)


def _no_room(
    via: RouteVia, room: float, index: int, world: World, requirements: Requirements
) -> NoPathError:
    name = world.name(index)
    free = room - requirements.radius - requirements.tracking_error
    place = _nearest_free(via.at, world, requirements.required)
    moves = [] if place is None else [f"move it to ({place[0]:.3f}, {place[1]:.3f})"]
    changes = change_moving(via, place)
    if 0 <= free < requirements.clearance:
        most = float(np.floor(free * 1000) / 1000)
        moves.append(f"set robot.clearance_m to at most {most:.3f}")
        changes += (Change("robot.clearance_m", most),)
    missing = requirements.required - room
    what = "outside" if index < -1 and room < 0 else f"{missing:.3f} m inside the clearance of"
    return NoPathError(
        f"via point {via.name!r} lies {what} {name!r}",
        where=via.at,
        remedy=" or ".join(moves) or "move it",
        via=via.name,
        obstacles=(name,),
        changes=changes,
    )


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
