"""The navigator: sense, decide, steer; state in, state out."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.robot_model import PERIOD_S, drive_model_of, is_driven
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import Plan, plan
from viaspline.robot.advance import advance, commanded, happened
from viaspline.robot.controller import Controller
from viaspline.robot.journey import NavigationState, trajectory_on
from viaspline.robot.perception.belief import Belief
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.perceive import look
from viaspline.robot.replanning.reroute import notice
from viaspline.robot.run import Event, Replan, Visit
from viaspline.robot.state import Command, RobotState
from viaspline.robot.steer import steer
from viaspline.robot.visits import visits_of
from viaspline.trajectory.limits import REACTION_S
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World

ROUNDING = 1e-12  # of times


class Navigator:
    """Drives a mission in a person's own control loop; immutable.

    Every step takes what was measured and seen, and gives a command and the navigator of the
    next step. Nothing is kept anywhere else, so a step can be repeated, stored or tried out. It
    reads no clock: time is what the caller says it is (only the wall-clock time that a re-plan
    took is noted, in ``compute_times``).

    A robot with a sensor never drives faster than v with v²/(2 max_accel) + v reaction <= range -
    radius - clearance, so it can stop before it comes too close to whatever comes into range. If
    the sensor hardly sees past the clearance, a quarter of what it sees past the body counts.

    A robot with a lidar is given scans. It drives into unknown space openly: paths lead through it
    as if it were free, but every time law ends, at rest, where its whole body has only been on
    places that beams have passed. What beams have hit is kept as small discs, with a radius of a
    twentieth of the distance that the path keeps (5 mm to 0.1 m) and one standard deviation of the
    noise; discs that later scans see through again and again are forgotten, those on the map never.
    So it keeps that much more than the clearance from what it has seen, and a gap that is narrower
    than that is closed to it. It is laid a new path when the old one is blocked, or when something
    that has gone opened one that is 5 % and 0.5 m shorter; and it passes what it knows on the side
    that it meant to, unless the other is shorter by as much.

    A robot with a drive, or with a localisation that is not exact, is controlled in a closed loop:
    its commands bring it to where it should be when they take effect, after the delay of the drive.
    So time runs ahead by that delay in here, in the events and re-plans too. Where the robot is
    too far behind, its time law waits for it.

    Args:
        mission: What to do.
        plan: Its plan, if there is one already.
        reaction: Longest time between two steps [s].
        period: Usual time between two steps; only the control of a robot with a drive asks [s].

    Raises:
        NoPathError: When there is no path at all.
        GeometryError: When the sensor sees no farther than the robot's body.

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
        ['started', 'detected', 'replanned']
    """

    def __init__(
        self,
        mission: Mission,
        plan: Plan | None = None,
        *,
        reaction: float = REACTION_S,
        period: float = PERIOD_S,
    ) -> None:
        if not 0.0 < reaction < float("inf"):
            raise GeometryError(f"reaction is {reaction}; give a time above 0")
        limits = limits_of(mission.robot, reaction)
        self._plan = _planned(mission) if plan is None else plan
        journey = NavigationState(
            # with the tension that was advised
            mission=mission.model_copy(update={"spline": self._plan.mission.spline}),
            limits=limits,
            reaction=reaction,
            world=self._plan.world,
            seen=frozenset(self._plan.world.obstacles),
            plan_path=self._plan.path,
            path=self._plan.path,
            laid=self._plan.world,
            trajectory=self._plan.trajectory,
            time=0.0,
            tracking_error=self._plan.tracking_error,
        )
        journey = replace(journey, belief=_belief(journey), controller=_controller(journey, period))
        self._journey = replace(journey, trajectory=trajectory_on(journey, speed=0.0, time=0.0))

    def step(
        self, state: RobotState, sensed: Iterable[Obstacle] | Scan, time: float
    ) -> tuple[Command, Navigator]:
        """What to do from now on until the next step.

        Args:
            state: Where the robot is, as measured.
            sensed: What is seen now: a lidar's scan, or every obstacle in sight; those already
                known make no difference.
            time: Now [s], never less than in the step before.

        Returns:
            The command, and the navigator for the next step.

        Raises:
            GeometryError: When time runs backwards, the state is not finite or has the wrong
                dimension, or a scan is given to a robot that has no lidar.
        """
        journey = self._journey
        _check(state, time, journey)
        if not journey.events:
            journey = _started(journey, time)
        before = journey
        if not journey.finished or journey.controller is not None:
            journey = advance(journey, state, time)
        if isinstance(sensed, Scan):
            if journey.belief is None:
                raise GeometryError(
                    "a scan was given, but the mission's robot has no lidar; give it one by "
                    "robot.sensor.lidar"
                )
            journey = happened(look(journey, sensed))
        else:
            new = tuple(dict.fromkeys(o for o in sensed if o not in journey.seen))
            if new and not journey.finished:
                journey = happened(notice(journey, new))
        journey = commanded(before, journey, state, time)
        return steer(journey, state), self._with(journey)

    def _with(self, journey: NavigationState) -> Navigator:
        navigator = object.__new__(Navigator)
        navigator._plan, navigator._journey = self._plan, journey
        return navigator

    def reference(self, time: float) -> RobotState:
        """Where a robot that follows exactly will be at a time, if nothing new is seen [s]."""
        distance, speed, _ = self._journey.trajectory.state_at(time)
        u = self.path.parameter(float(distance))
        place = np.asarray(self.path.evaluate(u))
        return RobotState(tuple(place.tolist()), float(self.path.heading(u)), float(speed))

    @property
    def controller(self) -> Controller | None:
        """The controller of a robot with a drive; None if it follows exactly."""
        return self._journey.controller

    @property
    def mission(self) -> Mission:
        """What was asked for."""
        return self._journey.mission

    @property
    def plan(self) -> Plan:
        """The plan before the robot set off."""
        return self._plan

    @property
    def world(self) -> World:
        """All that is known by now."""
        return self._journey.world

    @property
    def path(self) -> Path:
        """The path; all that was driven is its beginning."""
        return self._journey.path

    @property
    def trajectory(self) -> Trajectory:
        """The time law along the path, from the last change on."""
        return self._journey.trajectory

    @property
    def distance(self) -> float:
        """Progress along the path at the last step [m]."""
        return self._journey.distance

    @property
    def finished(self) -> bool:
        """Whether the drive is over."""
        return self._journey.finished

    @property
    def reached(self) -> bool:
        """Whether it is over and ended at the goal."""
        return self._journey.reached

    @property
    def reason(self) -> str | None:
        """Why the robot won't reach its goal; None if it will, as far as is known."""
        return self._journey.giving_up

    @property
    def visits(self) -> tuple[Visit, ...]:
        """How each point of the route was served so far, in order."""
        return visits_of(self._journey)

    @property
    def events(self) -> tuple[Event, ...]:
        """Everything that happened so far."""
        return self._journey.events

    @property
    def replans(self) -> tuple[Replan, ...]:
        """Every new path so far."""
        return self._journey.replans

    @property
    def compute_times(self) -> tuple[float, ...]:
        """How long each re-plan took, by the clock on the wall [s]."""
        return self._journey.compute_times


_planned = plan


def _belief(journey: NavigationState) -> Belief | None:
    robot = journey.mission.robot
    if robot.sensor is None or robot.sensor.lidar is None:
        return None
    return Belief.at_start(journey.world, robot)


def _controller(journey: NavigationState, period: float) -> Controller | None:
    robot = journey.mission.robot
    if not is_driven(robot):
        return None
    return Controller.of(drive_model_of(robot, period), period, journey.path, journey.trajectory)


def _started(journey: NavigationState, time: float) -> NavigationState:
    if journey.controller is not None:
        time += journey.controller.ahead
    journey = replace(journey, time=time, trajectory=journey.trajectory.delayed(time))
    length = f"sets off on a path of {journey.path.length:.1f} m"
    return journey.noted(Event("started", time, journey.place(0.0), length))


def _check(state: RobotState, time: float, journey: NavigationState) -> None:
    last = journey.time - (0.0 if journey.controller is None else journey.controller.ahead)
    if journey.events and time < last - ROUNDING * (1.0 + abs(last)):
        raise GeometryError(f"time {time} s is before the last step's, {last} s")
    numbers = (*state.position, state.heading, state.speed, state.speed_across, time)
    if len(state.position) != journey.path.dimension or not np.isfinite(numbers).all():
        raise GeometryError(
            f"the state {state} at {time} s needs {journey.path.dimension} finite coordinates, "
            "a finite heading, speed and time"
        )
