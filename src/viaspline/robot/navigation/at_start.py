"""A robot that stands at its start with its plan, and how it sets off."""

from __future__ import annotations

import math
from dataclasses import replace

from viaspline.machine.pose_filter import PoseFilter
from viaspline.machine.turns_on_spot import heading_onward, turns_on
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import MovingThings
from viaspline.planner import Plan
from viaspline.robot.controller import Controller
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.law_horizon import is_in_parts
from viaspline.robot.navigation.log import Log
from viaspline.robot.navigation.navigation_state import NavigationState
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.reschedule import rescheduled
from viaspline.robot.navigation.rounds import first_round
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.perception.belief import Belief
from viaspline.robot.perception.moving.track_hits import TrackedHits
from viaspline.robot.perception.moving.tracking_premises import TrackingPremises
from viaspline.robot.run import Event
from viaspline.robot.state import RobotState
from viaspline.trajectory.limits import REACTION_S
from viaspline.world.moving_obstacles import MovingObstacles


def at_start(task: DriveTask, plan: Plan) -> NavigationState:
    """A robot that stands at the start, with its plan.

    Args:
        task: What is asked of the drive.
        plan: Its plan.
    """
    robot, world = task.mission.robot, plan.world
    has_lidar = robot.sensor is not None and robot.sensor.lidar is not None
    belief = Belief.at_start(world, robot) if has_lidar else None
    path, laps = first_round(task, plan.path)
    controller = None
    if task.model is not None:
        pose_filter = PoseFilter.of(robot, task.period)
        controller = Controller.of(task.model, task.period, path, plan.trajectory, pose_filter)
    looks_ahead = task.model is None and math.isfinite(task.spot_turning.rate)
    facing = heading_onward(path, 0.0) if looks_ahead else None
    progress = Progress(time=0.0, controller=controller, facing=facing)
    moving = MovingObstacles.known(task.mission)
    hits = None
    things = _things_that_move(task.mission)
    if belief is not None and things is not None:
        premises = TrackingPremises(things.max_speed_mps, noise=belief.surfaces.noise)
        hits = TrackedHits(premises)
    knowledge = Knowledge(
        world, frozenset(world.obstacles), belief, moving=moving, charted=len(moving), hits=hits
    )
    turns = turns_on(path, task.spot_turning)
    schedule = Schedule(path, plan.trajectory, laid_in=world, turns=turns, laps=laps)
    changes = (
        not is_in_parts(task.limits, path)
        or belief is not None
        or laps is not None
        or task.reaction != REACTION_S
    )
    if changes and plan.timed is None:
        schedule = rescheduled(task, progress, knowledge, schedule, speed=0.0)
        law = schedule.trajectory
        begins = law.delayed(plan.trajectory.start_time - law.start_time)
        schedule = replace(schedule, trajectory=begins)
    return NavigationState(progress, knowledge, schedule, Log())


def _things_that_move(mission: Mission) -> MovingThings | None:
    """What it has to reckon with; a mission in which something unseen moves says that it does.

    Without this its lidar would take everything for walls: all that moves would leave them behind.
    """
    if mission.robot.moving is None and mission.world.unseen_moving:
        return MovingThings(safety="none")
    return mission.robot.moving


def set_off(
    task: DriveTask, state: NavigationState, measured: RobotState, time: float, plan: Plan
) -> NavigationState:
    """The state of a robot at its first step, at a time [s].

    Where anything of the mission moves, its clock is the one that counts: the robot stands until it
    may depart, whatever it sees meanwhile. Else its law begins when the robot does. One that stands
    at its start after it was to depart gets a law from now on.
    """
    progress, schedule = state.progress, state.schedule
    if progress.controller is not None:
        time += progress.controller.ahead
    words = f"sets off on a path of {schedule.path.length:.1f} m"
    mission, law, departs = plan.mission, schedule.trajectory, -math.inf
    if plan.timed is not None or mission.world.unseen_moving:
        departs = mission.route.depart_s
    if plan.timed is None:
        law = law.delayed(max(time, departs) - law.start_time)
    progress = replace(progress, time=time, set_off=True)
    schedule = replace(schedule, trajectory=law, committed_until=departs)
    if _is_late(schedule, measured, time):
        schedule = rescheduled(task, progress, state.knowledge, schedule, speed=0.0)
    return replace(
        state,
        progress=progress,
        schedule=schedule,
        log=state.log.with_events(Event("started", time, schedule.place(0.0), words)),
    )


def _is_late(schedule: Schedule, measured: RobotState, time: float) -> bool:
    """Whether a robot is nearer to its start than to where its law has it by now."""
    should = float(schedule.trajectory.distance_at(time))
    to_start, to_there = (
        math.dist(measured.position, schedule.place(along)) for along in (0.0, should)
    )
    return should > 0.0 and to_start <= to_there
