"""When the sensor first sees what isn't on the map.

Tested through ``space/online/test_fly``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.mission.shapes.solids import Solid
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.world.space.spatial_world import SpatialWorld


@dataclass(frozen=True, eq=False)
class UnseenSolid:
    """Something that isn't on the map.

    Attributes:
        name: What it is called.
        solid: It.
        world: A world of it alone.
    """

    name: str
    solid: Solid
    world: SpatialWorld


def first_sighting(
    leg: FlownLeg, unseen: Sequence[UnseenSolid], reach: float, now: float, step: float
) -> tuple[float, tuple[UnseenSolid, ...]]:
    """When something is first seen on a leg, and all that is seen then.

    Args:
        leg: What is flown.
        unseen: What nobody has seen yet.
        reach: Of the sensor, from the reference point [m].
        now: From when on [s].
        step: Between two looks [s].

    Returns:
        (time [s], what): infinite and nothing if nothing is seen any more.
    """
    end = min(leg.until, leg.law.end_time)
    times = np.arange(now, end + step, step)
    places = leg.states(np.minimum(times, end))[0]
    near = [np.asarray(one.world.distance(places)) <= reach for one in unseen]
    when = [int(np.argmax(seen)) if seen.any() else len(times) for seen in near]
    first = min(when, default=len(times))
    if first == len(times):
        return np.inf, ()
    found = tuple(one for one, k in zip(unseen, when, strict=True) if k == first)
    return float(times[first]), found
