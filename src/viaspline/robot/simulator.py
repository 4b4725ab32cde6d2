"""The simulator: the whole world, a sensor, a navigator, and a robot."""

from __future__ import annotations

from collections.abc import Callable

from viaspline.errors import GeometryError
from viaspline.formats.asked_for import AskedMission, asked_mission
from viaspline.handed_in import check_callable, seed_from, time_from
from viaspline.planner import Plan
from viaspline.robot.navigator import Navigator
from viaspline.robot.run import Run
from viaspline.robot.simulation.driven_step import StepWatcher, unwatched
from viaspline.robot.simulation.driving_budget import check_driving_time
from viaspline.robot.simulation.exact_drive import drive_exactly
from viaspline.robot.simulation.exact_run import run_of_exact
from viaspline.robot.simulation.machine_drive import drive_machine
from viaspline.robot.simulation.machine_run import run_of_machine
from viaspline.robot.simulation.pace import Pace, by_work
from viaspline.robot.simulation.standing_budget import check_standing_time
from viaspline.trajectory.limits import REACTION_S
from viaspline.world.world import World

ProgressCallback = Callable[[float, float, float], None]

MAX_DURATION_RATIO = 10.0
"""A drive is broken off after so many times its planned duration,"""

MAX_DELAY_S = 600.0
"""and this much longer, counted from when it may depart [s]."""


STEP_S = 0.05
"""Time between two looks of the sensor, if nobody says [s]."""


def longest_step(step: float) -> float:
    """The longest time between two steps that a simulated navigator reckons with [s].

    >>> longest_step(0.02) >= 0.02
    True
    """
    return max(step, REACTION_S)


def simulate(
    mission: AskedMission,
    *,
    seed: int = 0,
    step: float = STEP_S,
    progress: ProgressCallback | None = None,
    plan: Plan | None = None,
    pace: Pace = by_work,
    watch: StepWatcher = unwatched,
) -> Run:
    """Drive a mission in the world as it is, with what is not on the map.

    A robot without a drive follows its path exactly. One with a drive, or with a localisation that
    is not exact, is commanded by the navigator and moves as its machine does, with its delay, its
    limits and its noise: then ``Run.path`` is the way that it really took, its certificate that of
    the driven body, and ``Run.tracking`` what it was off.

    Where a robot that follows exactly stands for more than a minute and a half, and nothing that
    moves is near, the time is stepped over, and ``Run.times`` has few moments of it.

    The same mission gives the same run, bit by bit. A drive takes at most ten times its planned
    duration and ten minutes; then it is broken off, with that as its reason.

    Args:
        mission: What to do, or the file in which that stands.
        seed: Of all that is random: the noise of a lidar, of the drive and of the localisation.
        step: Time between two looks of the sensor [s].
        progress: Called with the time [s], the distance driven and the length of the path [m].
        plan: The mission's plan, if there is one already.
        pace: How much of the world's time passes while the robot searches for a new path:
            ``by_work``, the same on every machine, or ``by_clock``, what it takes here.
        watch: Called with every step of the navigator that is made: a robot that follows exactly
            leaves out those in which nothing can change.

    Returns:
        What was driven, whether the robot reached its goal or not: see ``Run.reached``.

    Raises:
        MissionError: When a file can't be read, or has faults.
        PlanningError: When there is no path at all, or none was found.
        GaveUpError: When a budget ran out before that was known, the drive would take millions of
            steps, or the robot would stand for more than half a day in all and that can't be
            stepped over.
        GeometryError: When the step is not above 0, the sensor sees no farther than the robot's
            body, or a robot with a drive is sent on a route with heights.

    Example:
        >>> from viaspline.mission.model import Mission
        >>> run = simulate(Mission.model_validate({
        ...     "world": {"unseen": [{"circle": {"center": [25, 1], "radius": 2}}]},
        ...     "robot": {"sensor": {"range_m": 10}},
        ...     "route": {"start": [0, 0], "goal": [50, 0]},
        ... }))
        >>> run.reached, run.certificate.holds, len(run.replans)
        (True, True, 1)
    """
    mission = asked_mission(mission)
    if mission.is_spatial:
        raise GeometryError("the mission is one in space; give fly(plan(mission))")
    step, seed = time_from("step", step), seed_from("seed", seed)
    check_callable("pace", pace, "give by_work or by_clock")
    if isinstance(pace, type):
        raise GeometryError(f"pace is the class {pace.__name__}; give by_work or by_clock")
    check_callable("watch", watch, "give a function of a step")
    if progress is not None:
        check_callable("progress", progress, "give a function of a time and two lengths")
    nav = Navigator(mission, plan, reaction=longest_step(step), period=step, warm=False)
    world = World.everything(nav.mission)
    check_standing_time(nav, world, seed)
    limit = MAX_DURATION_RATIO * nav.plan.trajectory.duration + MAX_DELAY_S
    limit += nav.mission.route.depart_s

    def tell(time: float, nav: Navigator) -> None:
        if progress is not None:
            length = nav.plan.path.length if mission.route.laps > 1 else nav.path.length
            progress(time, nav.driven + nav.distance, length)

    if nav.controller is None:
        check_driving_time(nav.plan, step)
        driven = drive_exactly(nav, world, step, seed, tell, limit, pace, watch)
        return run_of_exact(driven, world, step)
    moved = drive_machine(nav, world, step, seed, tell, limit, pace, watch)
    return run_of_machine(moved, world, step)
