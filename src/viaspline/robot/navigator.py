"""The navigator: sense, decide, schedule, command; state in, state out."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.handed_in import (
    all_finite,
    check_kind,
    number_from,
    numbers_from,
    period_from,
    time_from,
)
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.robot_model import drive_model_of
from viaspline.machine.turns_on_spot import heading_onward
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.spot_turning import PERIOD_S, is_driven
from viaspline.planner import Plan
from viaspline.planner import plan as plan_mission
from viaspline.planning.turning.hybrid_astar.pose_search import prepare_body
from viaspline.robot.controller import Controller
from viaspline.robot.navigation.at_start import at_start
from viaspline.robot.navigation.drive_task import DriveTask, requirements_under_way
from viaspline.robot.navigation.law_horizon import renewed_at
from viaspline.robot.navigation.log import Log
from viaspline.robot.navigation.navigation_state import NavigationState
from viaspline.robot.navigation.rounds import grows_after
from viaspline.robot.navigator_step import step_taken
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.motion_sensor import MovingSighting
from viaspline.robot.plan_at_hand import check_plan_of
from viaspline.robot.run import Event, Replan, Visit
from viaspline.robot.state import Command, RobotState
from viaspline.robot.warmed import KernelCallback, warm_up
from viaspline.trajectory.limits import REACTION_S
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World

MAX_CLOCK_S = 1e10
"""A clock may count from 1970 or from when the machine was started, and tells microseconds [s]."""

_MISSION_EXAMPLE = "give Mission.model_validate({...}) or load(file)"
_PLAN_FIRST = "give Navigator(plan.mission, plan)"


class Navigator:
    """Drives a mission in a person's own control loop; immutable.

    Every step takes what was measured and seen, and gives a command and the navigator of the
    next step. Nothing is kept anywhere else, so a step can be repeated, stored or tried out. It
    reads no clock: time is what the caller says it is (only the wall-clock time that a re-plan
    took is noted, in ``compute_times``).

    It keeps nothing of the past: ``events``, ``replans`` and the like are those of the last step,
    for whoever wants to write them down (``Logbook`` does). Of a route of many laps it has a round
    ahead; what lies behind is taken off the path and handed out. So a day's patrol takes no more
    memory than its first hour.

    A robot with a sensor never drives faster than v with v²/(2 max_accel) + v reaction <= range -
    radius - clearance, so it can stop before it comes too close to whatever comes into range. If
    the sensor hardly sees past the clearance, a quarter of what it sees past the body counts.

    A robot with a lidar is given scans. It drives into unknown space openly: paths lead through it
    as if it were free, but every time law ends, at rest, where its whole body has only been on
    places that beams have passed. What beams have hit is kept as small discs, with a radius of a
    twentieth of the distance that the path keeps (5 mm to 0.1 m) and one standard deviation of the
    noise, which shrinks to an eighth of it with 64 hits; discs that later scans see through again
    and again are forgotten, those on the map never. So it keeps that much more than the clearance
    from what it has seen, and a gap that is narrower than that is closed to it. Where it stands
    and sees no way on, it goes back as it came, through what it has taken for too narrow since:
    its body was there. It is laid a new path when the old one is blocked, or when something
    that has gone opened one that is 5 % and 0.5 m shorter; and it passes what it knows on the side
    that it meant to, unless the other is shorter by as much.

    A step is bounded. Where something is in its way, a robot under way looks for a new path no
    longer than it can and still stop, and no longer than 0.03 s of work in each step; meanwhile it
    goes on as it meant to (see ``work``). What it had no time for goes on in the steps to come,
    while it brakes: also whether a new path on another side is worth it. At rest each step goes on
    from what the one before it has found.

    A robot with a drive, or with a localisation that is not exact, is controlled in a closed loop:
    its commands bring it to where it should be when they take effect, after the delay of the drive.
    So time runs ahead by that delay in here, in the events and re-plans too. Where the robot is
    too far behind, its time law waits for it. A path that is laid under way is driven ahead in the
    same loop first: where the robot would get farther beside it than is kept for that, it goes
    more slowly, and a path to which it can't stay so near at all is not taken.

    The model is watched. A pose or a scan that is older than 0.2 s, and a clock that runs
    backwards, stop the robot until there is something newer. What it is beside its path beyond what
    is kept for that, a speed that isn't reached, a time law that waits, a pose that jumps: each is
    an event with its figures (``deviation``, ``slip``, ``lag``, ``pose_jump``, ``stale``,
    ``clock``). What it is measured beside its path is kept from then on (``allowance``): the path
    ahead is proven anew with that, laid anew where it doesn't hold, and where that can't be the
    robot stops and says so. It also goes on more slowly and steers more gently.

    What moves costs no more: a law past it is looked for with a budget, and of the ways round it
    each step tries some, the next one those that come after. Under passive safety a robot that no
    step is proven safe for stands, and ends its drive after a minute of that, with the reason.

    Args:
        mission: What to do.
        plan: Its plan, if there is one already.
        reaction: Longest time between two steps [s]; the period, if that is longer.
        period: Usual time between two steps [s], below 10: one over the rate.
        warm: Load, and on a machine's first run compile, all that any step can need, before the
            plan: see ``warm``. Without it a step that is the first to need a kernel waits for it.
        progress: Hears the name of every kernel that has to be compiled for that.

    Raises:
        PlanningError: When there is no path at all, or none was found.
        GaveUpError: When a budget ran out before that was known.
        GeometryError: When the sensor sees no farther than the robot's body, or the plan is one for
            another robot or route.

    Example:
        >>> mission = Mission.model_validate({
        ...     "robot": {"sensor": {"range_m": 20}},
        ...     "route": {"start": [0, 0], "goal": [50, 0]},
        ... })
        >>> nav = Navigator(mission)
        >>> state = RobotState(position=(0.0, 0.0), heading=0.0, speed=0.0)
        >>> command, nav = nav.step(state, sensed=[], time=0.0)
        >>> command.acceleration, command.curvature
        (1.0, 0.0)
        >>> rock = Obstacle(circle={"center": (25, 1), "radius": 2}, name="rock")
        >>> state = RobotState(position=(6.0, 0.0), heading=0.0, speed=2.0)
        >>> command, nav = nav.step(state, sensed=[rock], time=4.0)
        >>> [event.kind for event in nav.events]
        ['detected', 'replanned']
    """

    def __init__(
        self,
        mission: Mission,
        plan: Plan | None = None,
        *,
        reaction: float = REACTION_S,
        period: float = PERIOD_S,
        warm: bool = True,
        progress: KernelCallback | None = None,
    ) -> None:
        has_plan = isinstance(mission, Plan)
        check_kind("mission", mission, Mission, _PLAN_FIRST if has_plan else _MISSION_EXAMPLE)
        reaction, period = time_from("reaction", reaction), period_from("period", period)
        reaction = max(reaction, period)
        if plan is not None:
            check_plan_of(mission, plan)
        warm_up(mission, progress, warm)
        limits = limits_of(mission.robot, reaction)
        plan = plan_mission(mission) if plan is None else plan
        # with the order and the tension that were chosen: a corridor follows the order
        chosen = {"spline": plan.mission.spline, "route": plan.mission.route}
        mission = mission.model_copy(update=chosen)
        model = drive_model_of(mission.robot, period) if is_driven(mission.robot) else None
        requirements = requirements_under_way(mission, plan.tracking_error)
        if mission.robot.footprint is not None and mission.robot.sensor is not None:
            prepare_body(requirements)
        self._plan = plan
        self._task = DriveTask(mission, requirements, limits, reaction, model, period=period)
        self._state = at_start(self._task, plan)

    def __repr__(self) -> str:
        state = "finished" if self.finished else f"at {self.distance:.1f} m"
        return f"<Navigator: {state} of {self.path.length:.1f} m>"

    def step(
        self, state: RobotState, sensed: Iterable[Obstacle | MovingSighting] | Scan, time: float
    ) -> tuple[Command, Navigator]:
        """What to do from now on until the next step.

        Args:
            state: Where the robot is, as measured.
            sensed: What is seen now: a lidar's scan, or every obstacle in sight; those already
                known make no difference. What moves is told of as ``MovingSighting``; what isn't
                for half a second is taken to have gone.
            time: Now [s]. While it is less than in the step before, the robot stands.

        Returns:
            The command, and the navigator for the next step.

        Raises:
            GeometryError: When the state or the time is not finite or has the wrong dimension, or
                a scan is given to a robot that has no lidar.
        """
        time = number_from("time", time)
        _check(state, time, self._state)
        taken = step_taken(self._task, self._plan, self._state, state, sensed, time)
        navigator = object.__new__(Navigator)
        navigator._plan, navigator._task, navigator._state = self._plan, taken.task, taken.state
        return taken.command, navigator

    def warm(self, progress: KernelCallback | None = None) -> None:
        """Load all that any step can need, so that none has to wait for it.

        The constructor does that unless it is refused there. On a machine that never did it the
        kernels are compiled, in a process of their own, by driving small missions of the kind; that
        takes a minute or two. From then on it takes a second in each process, and nothing when it
        was done before. All that is there by then is taken out of garbage collections (by
        ``gc.freeze``), which would halt a step for a tenth of a second.

        Args:
            progress: Hears the name of every kernel that has to be compiled.
        """
        warm_up(self.mission, progress)

    @property
    def allowance(self) -> float:
        """How far beside its path the robot may get by what is kept for that now [m].

        It grows when the robot is measured farther beside its path.
        """
        return self._task.requirements.tracking_error

    def reference(self, time: float) -> RobotState:
        """Where a robot that follows exactly will be at a time, if nothing new is seen [s]."""
        distance, speed, _ = self._state.schedule.trajectory.state_at(number_from("time", time))
        u = self.path.parameter(float(distance))
        place = np.asarray(self.path.evaluate(u))
        stands = speed == 0.0
        heading = heading_onward(self.path, float(distance)) if stands else self.path.heading(u)
        return RobotState(tuple(place.tolist()), float(heading), float(speed))

    @property
    def controller(self) -> Controller | None:
        """The controller of a robot with a drive; None if it follows exactly."""
        return self._state.progress.controller

    @property
    def work(self) -> float:
        """What the last step has spent on looking for a new path [s of the reference machine].

        The robot goes on as it had meant to for that long: its command is due so much later.
        """
        return self._state.work

    @property
    def searches(self) -> bool:
        """Whether it is still looking for a new path, and so every step counts."""
        return self._state.schedule.pending is not None

    @property
    def held(self) -> str | None:
        """Why the robot is held still: its ``pose`` or its ``scan`` is stale, or the ``clock``."""
        return self._state.watch.held

    @property
    def mission(self) -> Mission:
        """What was asked for."""
        return self._task.mission

    @property
    def plan(self) -> Plan:
        """The plan before the robot set off."""
        return self._plan

    @property
    def world(self) -> World:
        """All that is known by now."""
        return self._state.knowledge.world

    @property
    def path(self) -> Path:
        """The path; what was driven is its beginning, all of it but on a route of many laps.

        Such a path is a round that ends where it begins and goes on there; its last three eighths
        are looked at when the robot comes nearer. What lies behind is taken off it now and then:
        ``driven`` says how long that was.
        """
        return self._state.schedule.path

    @property
    def trajectory(self) -> Trajectory:
        """The time law along the path, from the last change on."""
        return self._state.schedule.trajectory

    @property
    def distance(self) -> float:
        """Progress along the path at the last step [m]."""
        return self._state.progress.distance

    @property
    def driven(self) -> float:
        """Distance that was driven before the path begins [m]; 0 but on a route of many laps."""
        return self._state.schedule.driven

    @property
    def quiet_until(self) -> float:
        """Until then a robot that follows exactly and sees nothing new may leave out steps [s].

        Under passive safety there is no such time: with every look its law may go on for longer.
        """
        state, end = self._state, self.trajectory.end_time
        if self.mission.robot.is_passive:
            return state.progress.time
        renewed = renewed_at(self._task, state.knowledge, state.schedule)
        return min(renewed, grows_after(state.schedule), end)

    @property
    def finished(self) -> bool:
        """Whether the drive is over."""
        return self._state.progress.finished

    @property
    def reached(self) -> bool:
        """Whether it is over and ended at the goal."""
        return self.finished and self.reason is None

    @property
    def reason(self) -> str | None:
        """Why the robot won't reach its goal; None if it will, as far as is known."""
        return self._state.schedule.giving_up

    @property
    def log(self) -> Log:
        """All that is noted of the last step; a ``Logbook`` keeps it."""
        return self._state.log

    @property
    def visits(self) -> tuple[Visit, ...]:
        """The points of the route that were served in the last step, in order."""
        return tuple(visit for _, visit in self._state.log.served)

    @property
    def events(self) -> tuple[Event, ...]:
        """What happened in the last step."""
        return self._state.log.events

    @property
    def replans(self) -> tuple[Replan, ...]:
        """The new paths of the last step."""
        return self._state.log.replans

    @property
    def compute_times(self) -> tuple[float, ...]:
        """How long each search in the last step took, by the clock on the wall [s]."""
        return self._state.log.compute_times


def _check(measured: RobotState, time: float, state: NavigationState) -> None:
    """Refuse what can't have been measured after the last step."""
    check_kind("state", measured, RobotState, "give RobotState(position, heading, speed)")
    dimension = state.schedule.path.dimension
    position = numbers_from("state.position", measured.position)
    motion = (measured.heading, measured.speed, measured.speed_across, time)
    if position.shape != (dimension,) or not np.isfinite(position).all() or not all_finite(*motion):
        raise GeometryError(
            f"the state {measured} at {time} s needs {dimension} finite coordinates, "
            "a finite heading, speed and time"
        )
    if measured.stamp is not None and not all_finite(measured.stamp):
        raise GeometryError(
            f"state.stamp is {measured.stamp!r:.40}; give seconds by the clock of the steps, "
            "or None for now"
        )
    if abs(time) > MAX_CLOCK_S:
        raise GeometryError(
            f"time is {time:g} s, and by such a clock a step can't be told from the next; give "
            f"seconds from a beginning that is no more than {MAX_CLOCK_S:g} s away"
        )
