"""A step of a navigator as a message: what it was given, and what it decided.

Tested through ``bags/test_replay``.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.motion_sensor import MovingSighting
from viaspline.robot.run import Event
from viaspline.robot.simulation.driven_step import DrivenStep, Sensed
from viaspline.robot.state import Command, RobotState


class Given(NamedTuple):
    """What a navigator is given in a step: when [s], where it is, what it is shown."""

    time: float
    state: RobotState
    sensed: Sensed


def step_message(step: DrivenStep, number_of: Callable[[Obstacle], int]) -> dict[str, Any]:
    """A step as a message.

    Args:
        step: What was given and decided.
        number_of: By which number an obstacle is told of.
    """
    return {
        **_given(step, number_of),
        **decision_message(step.command, step.nav),
    }


def decision_message(command: Command, nav: Navigator) -> dict[str, Any]:
    """What a navigator decided in its last step, as that part of a message."""
    return {
        "command": _command(command),
        "events": [_event(event) for event in nav.events],
        "path_length": nav.driven + nav.path.length,
        "end_time": nav.trajectory.end_time,
    }


def _given(step: DrivenStep, number_of: Callable[[Obstacle], int]) -> dict[str, Any]:
    state, sensed = step.state, step.sensed
    scans: list[dict[str, Any]] = []
    told: list[int] = []
    moving: list[dict[str, Any]] = []
    if isinstance(sensed, Scan):
        scans.append(_scan(sensed))
    else:
        for one in sensed:
            if isinstance(one, Obstacle):
                told.append(number_of(one))
            else:
                moving.append(_moving(one, number_of(one.obstacle)))
    return {
        "time": step.time,
        "position": state.position,
        "heading": state.heading,
        "speed": state.speed,
        "speed_across": state.speed_across,
        "stamp": _perhaps(state.stamp),
        "scan": scans,
        "told": told,
        "moving": moving,
    }


def _scan(scan: Scan) -> dict[str, Any]:
    names = ("position", "heading", "angle_min", "angle_increment", "range_max", "ranges")
    return {name: getattr(scan, name) for name in names} | {"stamp": _perhaps(scan.stamp)}


def _perhaps(stamp: float | None) -> list[float]:
    """An instant that need not be said, as a list of one or none."""
    return [] if stamp is None else [stamp]


def _said(stamps: Any) -> float | None:
    return float(stamps[0]) if len(stamps) else None


def _moving(seen: MovingSighting, number: int) -> dict[str, Any]:
    return {
        "index": seen.index,
        "number": number,
        "frame": seen.frame,
        "velocity": seen.velocity,
    }


def _command(command: Command) -> dict[str, Any]:
    return {
        "speed": command.speed,
        "acceleration": command.acceleration,
        "curvature": command.curvature,
        "yaw_rate": command.yaw_rate,
        "position": command.position,
        "heading": command.heading,
        "distance": command.distance,
        "stopped": command.stopped,
        "finished": command.finished,
        "velocity": command.velocity,
        "actuator_names": list(command.actuators),
        "actuators": list(command.actuators.values()),
    }


def _event(event: Event) -> dict[str, Any]:
    return {
        "kind": event.kind,
        "time": event.time,
        "at": event.at,
        "message": event.message,
        "data": json.dumps(dict(event.data), default=str, sort_keys=True),
    }


def given_from(message: Mapping[str, Any], obstacles: Mapping[int, Obstacle]) -> Given:
    """What a navigator was given, by a message.

    Args:
        message: Of a step.
        obstacles: What was told of by then, by numbers.

    Raises:
        KeyError: An obstacle wasn't told of.
        GeometryError: The numbers make no scan.
    """
    state = RobotState(
        tuple(message["position"].tolist()),
        message["heading"],
        message["speed"],
        message["speed_across"],
        _said(message["stamp"]),
    )
    if message["scan"]:
        (scan,) = message["scan"]
        return Given(message["time"], state, Scan(**{**scan, "stamp": _said(scan["stamp"])}))
    told = [obstacles[number] for number in message["told"].tolist()]
    moving = [
        MovingSighting(
            one["index"],
            obstacles[one["number"]],
            tuple(one["frame"].tolist()),
            tuple(one["velocity"].tolist()),
        )
        for one in message["moving"]
    ]
    return Given(message["time"], state, (*told, *moving))
