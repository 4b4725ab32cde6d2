"""How long a simulated drive may take that is followed exactly.

Tested through ``robot/test_simulator``.
"""

from __future__ import annotations

from viaspline.errors import GaveUpError
from viaspline.planner import Plan

MOST_SAMPLES = 10_000_000
"""Of a drive at most: almost six days by the usual step, with a gigabyte and a half of what is kept
of them."""


def check_driving_time(plan: Plan, step: float) -> None:
    """See that the drive of a plan can be simulated, its standstills aside.

    Args:
        plan: Of the whole drive.
        step: From one sample to the next [s].

    Raises:
        GaveUpError: It would take too long, and too much memory.
    """
    law = plan.trajectory
    stood = sum(station.dwell for station in law.stations)
    seconds = law.duration - stood
    if seconds / step <= MOST_SAMPLES:
        return
    most = MOST_SAMPLES * step
    raise GaveUpError(
        f"the drive can't be simulated: it takes {seconds / 3600.0:.0f} h, and a simulation would "
        f"have to keep {seconds / step:.2g} samples of it",
        where=plan.path.spans[0, 0],
        remedy=f"plan it only, or simulate a part of it of no more than {most / 3600.0:.0f} h",
        tried=("a sample at every step of the sensor",),
    )
