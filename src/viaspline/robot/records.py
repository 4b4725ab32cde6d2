"""What is noted when a robot goes over to a new path, or gives up."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.robot.journey import NavigationState
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.ways_on import Choice
from viaspline.robot.run import Event, Replan
from viaspline.trajectory.retime import braking


def take(context: ReplanContext, choice: Choice, skip: Mapping[int, str]) -> NavigationState:
    """Go over to a new path, without the points of the route in ``skip``."""
    journey, path = context.journey, choice.found.path
    if path is journey.path:
        return journey
    now = journey.place(journey.distance)
    names = {via.index: via.name for via, _ in journey.ahead}
    events = [
        Event("skipped", journey.time, now, f"gives up '{names[index]}': {why}")
        for index, why in sorted(skip.items())
    ]
    if choice.mode == "from_rest" and context.speed > 0.0:
        events.append(Event("braked", journey.time, now, "brakes, to leave from rest"))
    why = f"goes round {_list(context.names)}" if context.names else "takes a better way"
    message = f"{why} on a {choice.mode.replace('_', ' ')} path"
    events.append(Event("replanned", journey.time, now, message, {"mode": choice.mode}))
    return replace(
        journey.noted(*events),
        path=path,
        laid=journey.world,
        sighted=min(journey.sighted, choice.found.changed_from),
        probed_until=0.0,
        trajectory=choice.trajectory,
        turns=choice.turns,
        skipped=journey.skipped + tuple(sorted(skip.items())),
        replans=(*journey.replans, _record(context, choice)),
    )


def give_up(journey: NavigationState, speed: float, reason: str) -> NavigationState:
    """Brake as hard as possible from a speed [m/s], and stand."""
    trajectory = braking(journey.distance, speed, journey.limits.brake, journey.time)
    if speed > 0.0:
        here = journey.place(journey.distance)
        journey = journey.noted(Event("braked", journey.time, here, f"brakes: {reason}"))
    return replace(journey, trajectory=trajectory, dwell=None, giving_up=reason)


def _record(context: ReplanContext, choice: Choice) -> Replan:
    journey, found = context.journey, choice.found
    at = found.changed_from
    position, heading, curvature = jumps(journey.path, found.path, at)
    return Replan(
        time=journey.time,
        at=journey.place(at),
        distance=at,
        mode=choice.mode,
        changed_from=at,
        rejoins_at=found.rejoins_at,
        obstacles=context.names,
        position_jump=position,
        heading_jump=heading,
        curvature_jump=curvature,
        path=found.path,
        old_path=journey.path,
    )


def jumps(old: Path, new: Path, at: float) -> tuple[float, float, float]:
    """How far two paths are apart where one leaves the other: in place, heading and curvature.

    The new one is compared with the old one as that would have gone on. So a jump that the
    old one has at a via point anyway doesn't count.

    Returns:
        [m], [rad], [1/m].
    """
    before, after = _going_on(old, at), _going_on(new, at)
    gap = float(np.linalg.norm(np.asarray(after[0]) - np.asarray(before[0])))
    return gap, abs(math.remainder(after[1] - before[1], math.tau)), abs(after[2] - before[2])


def _going_on(path: Path, at: float) -> tuple[object, float, float]:
    """Position, heading and curvature just after a place."""
    u, end = float(path.parameter(at)), path.domain[1]
    nearest = round(u)
    if abs(u - nearest) < 1e-9 and nearest < end:
        u = float(nearest)  # the side after the joint, whatever the rounding says
    return path.evaluate(u), float(path.heading(u)), float(path.curvature(u))


def _list(names: Sequence[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)
