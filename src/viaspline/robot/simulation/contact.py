"""When a driven body touches something, or is touched.

Tested through ``robot/simulation/test_machine_drive`` and ``robot/simulation/test_exact_drive``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.run import Event
from viaspline.tracks.encountered import Encounters
from viaspline.tracks.encounters import DrivenStates
from viaspline.world.world import World

TOUCH_DEPTH_M = 1e-9
"""What touches by less doesn't [m]."""


def first_contact(robot: RobotSpec, world: World, rows: Floats) -> Event | None:
    """The first touch in some steps of a motion.

    The steps are so short that a body which is clear at their ends does not touch between them by
    more than a fraction of a millimetre; what is certain is in the run's certificate.

    Args:
        robot: Its body.
        world: Everything that is there.
        rows: Time, x, y, heading, and what else there is, shape (n, 4) or more.
    """
    gaps, nearest = world.nearest(rows[:, 1:3])
    inside = np.flatnonzero(gaps < robot.inner_radius - TOUCH_DEPTH_M)
    if robot.footprint is not None and not inside.size:
        close = np.flatnonzero(gaps < robot.outer_radius)
        bodies, those = world.body_nearest(rows[close, 1:3], rows[close, 3], robot.footprint)
        nearest[close] = those
        inside = close[bodies <= 0.0]
    if not inside.size:
        return None
    i = int(inside[0])
    name = world.name(int(nearest[i]))
    where = float(rows[i, 1]), float(rows[i, 2])
    return Event("contact", float(rows[i, 0]), where, f"touches '{name}'", {"name": name})


def with_contacts(
    events: tuple[Event, ...], met: Encounters | None, motion: DrivenStates
) -> tuple[Event, ...]:
    """The events of a drive in order, with every touch of something that moves."""
    if met is None or not met.contacts:
        return events
    places, _ = motion.state_at(np.array([one.time for one in met.contacts]))
    touches = (
        Event("contact", one.time, tuple(at), one.words, {"name": one.obstacle})
        for one, at in zip(met.contacts, places.tolist(), strict=True)
    )
    return tuple(sorted((*touches, *events), key=lambda event: event.time))
