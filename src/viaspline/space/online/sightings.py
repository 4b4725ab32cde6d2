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
    legs: Sequence[FlownLeg], unseen: Sequence[UnseenSolid], reach: float, now: float, step: float
) -> tuple[float, tuple[UnseenSolid, ...]]:
    """When something is first seen on legs, and all that is seen then.

    Args:
        legs: What is flown, each until the next one begins.
        unseen: What nobody has seen yet.
        reach: Of the sensor, from the reference point [m].
        now: From when on [s].
        step: Between two looks [s].

    Returns:
        (time [s], what): infinite and nothing if nothing is seen any more.
    """
    end = min(legs[-1].until, legs[-1].law.end_time)
    times = np.minimum(np.arange(now, end + step, step), end)
    owner = np.searchsorted([leg.until for leg in legs[:-1]], times, side="right")
    places = np.concatenate([leg.states(times[owner == k])[0] for k, leg in enumerate(legs)])
    near = [np.asarray(one.world.distance(places)) <= reach for one in unseen]
    when = [int(np.argmax(seen)) if seen.any() else len(times) for seen in near]
    first = min(when, default=len(times))
    if first == len(times):
        return np.inf, ()
    found = tuple(one for one, k in zip(unseen, when, strict=True) if k == first)
    return float(times[first]), found
