"""What a saved fleet says of its patrols: that all comes again after a period.

Tested through ``fleet/saved/test_load_fleet_plan`` and ``fleet/saved/test_fleet_file``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.patrols.driven_laps import seams_of
from viaspline.fleet.patrols.fleet_patrols import FleetPatrols
from viaspline.fleet.patrols.take_off_first import spans_before_laps
from viaspline.fleet.saved.fleet_file import FleetFile
from viaspline.mission.fleet.fleet import Fleet
from viaspline.trajectory.trajectory import Trajectory

SAME: Final = 1e-6
"""Places [m], speeds [m/s] and times [s] that differ by no more are one."""


def checked_patrols(
    told: FleetFile, fleet: Fleet, plans: Mapping[str, AnyPlan]
) -> FleetPatrols | None:
    """What never ends of a fleet, if it comes again as is said.

    Args:
        told: What stands in its file.
        fleet: What was asked for.
        plans: Of the robots that are served, by name.

    Returns:
        None where all of them end.

    Raises:
        SavedPlanError: Something doesn't come again, or moves when only patrols are said to.
    """
    patrols = told.patrols()
    asked = [one.name for one in fleet.members if one.mission.route.is_patrol]
    names = sorted(name for name in asked if name in plans)
    if patrols is None:
        if names:
            raise told.file.wrong(f"says nothing of the patrol '{names[0]}'")
        return None
    if sorted(patrols.begins) != names or min(patrols.laps.values(), default=1) < 1:
        raise told.file.wrong("patrols names other robots than those that never end")
    since, period = patrols.repeats_from, patrols.period
    if not (period > 0.0 and since + period <= patrols.planned_until + SAME):
        raise told.file.wrong("patrols aren't planned for a whole period")
    for name, plan in plans.items():
        if name in patrols.begins:
            if not _comes_again(plan, patrols, name):
                raise told.file.wrong(f"'{name}' isn't every {period:g} s where it was before")
        elif plan.trajectory.end_time > since + SAME:
            raise told.file.wrong(f"'{name}' hasn't arrived when only patrols are said to move")
    return patrols


def _comes_again(plan: AnyPlan, patrols: FleetPatrols, name: str) -> bool:
    """Whether a patrol is, from when it sets out on, a round farther after each period."""
    laps, law = plan.mission.route.laps, plan.trajectory
    rounds, before = patrols.laps[name], spans_before_laps(plan)
    begins, period = patrols.begins[name], patrols.period
    spans = plan.path.spans[before:]
    if law.end_time < patrols.planned_until - period or len(spans) % laps or rounds > laps:
        return False
    a_lap = len(spans) // laps
    if not np.allclose(spans[a_lap:], spans[: len(spans) - a_lap], rtol=0.0, atol=SAME):
        return False
    seams = seams_of(plan.path, laps, before)
    late = float(law.distance_at(begins)) - float(seams[0])
    if late > SAME or begins > patrols.repeats_from + SAME:
        return False
    return _is_repeated(law, begins, period, float(seams[rounds] - seams[0]))


def _is_repeated(law: Trajectory, begins: float, period: float, farther: float) -> bool:
    """Whether a law goes on after each period as it did in it, at every point of both.

    Args:
        law: From rest to rest at the end of a round.
        begins: When its first round does [s].
        period: [s].
        farther: A round [m].
    """
    times = np.concatenate((law.times, law.times - period))
    times = times[(times >= begins) & (times <= law.end_time - period)]
    now, speed, _ = law.state_at(times)
    then, faster, _ = law.state_at(times + period)
    near = np.abs(then - now - farther) <= SAME * (1.0 + farther)
    return bool((near & (np.abs(faster - speed) <= 1e-4)).all())


def for_ever(patrols: FleetPatrols | None) -> tuple[float, float] | None:
    """From when on and after how long all comes again [s]; None where nothing does."""
    return None if patrols is None else (patrols.repeats_from, patrols.period)
