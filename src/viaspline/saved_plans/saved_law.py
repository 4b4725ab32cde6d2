"""The time law of a saved plan, whose times, speeds and accelerations go together.

Tested through ``saved_plans/test_load_plan``.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.saved_plans.plan_file import PlanFile
from viaspline.trajectory.limits import Station
from viaspline.trajectory.motion_pieces import after
from viaspline.trajectory.trajectory import Trajectory

ROUNDED: Final = 1e-6
"""By which a distance [m] or a speed [m/s] that was reckoned may be rounded."""


def saved_law(plan: PlanFile) -> Trajectory:
    """The law that stands in a file.

    Raises:
        SavedPlanError: It is none: it goes back, or its parts don't go together.
    """

    def column(name: str, rows: int | None = None) -> Floats:
        values = plan.numbers("trajectory", "law", name)
        if values.ndim != 1 or (rows is not None and len(values) != rows):
            raise plan.wrong(f"trajectory.law.{name} isn't as long as it has to be")
        return values

    said = plan.part("trajectory", "law")
    distances = column("distances_m")
    count = len(distances)
    if count < 2:
        raise plan.wrong("trajectory.law has no two points")
    speeds, times = column("speeds_mps", count), column("times_s", count)
    accelerations = column("accelerations_mps2", count - 1)
    changes, jerks = (
        column(name, count - 1) if name in said else None for name in ("changes_1ps2", "jerks_mps3")
    )
    over_limit, over_jerk = (
        plan.number("trajectory", "law", name) if name in said else None
        for name in ("over_limit_until_m", "over_jerk_until_m")
    )
    if (np.diff(distances) < 0.0).any() or (np.diff(times) < 0.0).any() or (speeds < 0.0).any():
        raise plan.wrong("trajectory.law goes back")
    law = Trajectory(
        distances, speeds, times, accelerations, _stops(plan), over_limit, changes, jerks, over_jerk
    )
    _check_motion(plan, law)
    return law


def _stops(plan: PlanFile) -> tuple[Station, ...]:
    listed = plan.part("trajectory", "stations")
    try:
        return tuple(Station(one["distance_m"], one["dwell_s"], str(one["name"])) for one in listed)
    except (KeyError, TypeError, GeometryError) as error:
        raise plan.wrong(f"trajectory.stations are none: {error}") from None


def _check_motion(plan: PlanFile, law: Trajectory) -> None:
    """See that each piece of a law leads from its beginning to its end, in its time."""
    none = np.zeros(len(law.accelerations))
    changes = none if law.changes is None else law.changes
    jerks = none if law.jerks is None else law.jerks
    late = np.diff(law.times)
    gone, speed, _ = after(late, law.speeds[:-1], law.accelerations, changes, jerks)
    width = np.diff(law.distances)
    off = np.abs(gone - width) > ROUNDED * (1.0 + width)
    off |= np.abs(speed - law.speeds[1:]) > ROUNDED * (1.0 + law.speeds[1:])
    if off.any():
        where = law.distances[int(np.argmax(off))]
        raise plan.wrong(f"trajectory.law isn't a motion from {where:.2f} m on")
