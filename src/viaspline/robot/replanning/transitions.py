"""What a robot goes over to: a new path, or a stop for good.

Tested through ``robot/test_simulator`` and ``robot/replanning/test_decide``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.machine.turns_on_spot import turns_on
from viaspline.robot.navigation.decision import Decision
from viaspline.robot.navigation.progress import SAME_PLACE_M
from viaspline.robot.navigation.reschedule import braking_at_once, rescheduled
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.replanning.deadline import (
    gone_on,
    last_place,
    must_brake,
    stopping_place,
)
from viaspline.robot.replanning.path_candidate import PathCandidate
from viaspline.robot.replanning.replan_context import ReplanContext
from viaspline.robot.replanning.replan_search import ReplanResult
from viaspline.robot.run import Event, Replan

SAME_U = 1e-9
"""A parameter nearer than this to a joint of two spans is that joint."""


def take_over(
    context: ReplanContext, candidate: PathCandidate, skip: Mapping[int, str]
) -> Decision:
    """Go over to a new path, without the points of the route in ``skip``."""
    progress, old = context.progress, context.schedule
    path = candidate.solution.path
    if path is old.path:
        return Decision(replace(old, reduced=candidate.reduced, pending=None, held_at=math.inf))
    given_up = tuple(sorted(skip.items()))
    return Decision(
        replace(
            old,
            path=path,
            trajectory=candidate.trajectory,
            laid_in=context.knowledge.world,
            laid_at=progress.time,
            timed_at=progress.time,
            turns=_turns(context, candidate),
            slow=candidate.slow,
            reduced=candidate.reduced,
            gives_way=old.gives_way or candidate.waits,
            sighted_until=min(old.sighted_until, candidate.solution.changed_from),
            probed_until=0.0,
            laps=None if old.laps is None else old.laps.without(skip),
            pending=None,
            held_at=math.inf,
        ),
        events=_events(context, candidate, given_up),
        replan=_record(context, candidate),
        skipped=given_up,
    )


def stop_for_good(context: ReplanContext, reason: str) -> Decision:
    """Brake as hard as possible, and stand."""
    schedule = context.schedule
    trajectory = braking_at_once(context.task, context.progress, schedule, context.speed)
    schedule = replace(schedule, trajectory=trajectory, giving_up=reason, pending=None)
    return Decision(schedule, (braked(context, reason),) if context.speed > 0.0 else ())


def keep_searching(context: ReplanContext, result: ReplanResult) -> Decision | None:
    """Look on in the steps to come; until then go no farther than the path is clear.

    Under way the robot brakes for that as late as it can, or as soon as its time to search is up.

    Returns:
        None where a robot that stands has spent all that it may on its search.
    """
    assert result.begin_with is not None
    before, schedule = context.schedule, context.schedule
    held_at = stopping_place(context) if must_brake(context) else last_place(context)
    pending = gone_on(context, result.begin_with, held_at, result.doubt)
    if pending is None:
        return None
    held = replace(schedule, pending=pending, held_at=held_at)
    if before.pending is None or held_at != before.held_at:  # else its law ends there already
        held = rescheduled(context.task, context.progress, context.knowledge, held, context.speed)
    if before.pending is not None or context.speed == 0.0:
        return Decision(held)
    names = ", ".join(f"'{name}'" for name in context.obstruction.names)
    why = f"looks for a way round {names}, and goes no farther until it has one"
    return Decision(held, (Event("braked", context.progress.time, context.here, why),))


def let_go(context: ReplanContext) -> Schedule:
    """The schedule of a robot that has nothing in its way: a search for a new path is over."""
    if context.schedule.pending is None:
        return context.schedule
    free = replace(context.schedule, pending=None, held_at=math.inf)
    return rescheduled(context.task, context.progress, context.knowledge, free, context.speed)


def braked(context: ReplanContext, reason: str) -> Event:
    """The event that a robot brakes."""
    return Event("braked", context.progress.time, context.here, f"brakes: {reason}")


def _events(
    context: ReplanContext, candidate: PathCandidate, given_up: Sequence[tuple[int, str]]
) -> tuple[Event, ...]:
    time, here = context.progress.time, context.here
    names = {via.index: via.name for via, _ in context.vias_ahead}
    events = [
        Event("skipped", time, here, f"gives up '{names[index]}': {why}") for index, why in given_up
    ]
    if candidate.mode == "from_rest" and context.speed > 0.0:
        events.append(Event("braked", time, here, "brakes, to leave from rest"))
    blocking = ", ".join(f"'{name}'" for name in context.obstruction.names)
    why = f"goes round {blocking}" if blocking else "takes a better way"
    message = f"{why} on a {candidate.mode.replace('_', ' ')} path"
    events.append(Event("replanned", time, here, message, {"mode": candidate.mode}))
    return tuple(events)


def _turns(context: ReplanContext, candidate: PathCandidate) -> tuple[float, ...]:
    """Where the robot turns on a new path: where it stops for that, and at corners [m]."""
    stops = candidate.turns
    corners = turns_on(candidate.solution.path, context.task.spot_turning)
    others = (at for at in corners if all(abs(at - stop) > SAME_PLACE_M for stop in stops))
    return tuple(sorted((*stops, *others)))


def _record(context: ReplanContext, candidate: PathCandidate) -> Replan:
    old, solution = context.schedule, candidate.solution
    leave = solution.changed_from
    position, heading, curvature = _jumps(old.path, solution.path, leave)
    return Replan(
        time=context.progress.time,
        at=old.place(leave),
        distance=old.driven + leave,
        mode=candidate.mode,
        changed_from=leave,
        rejoins_at=solution.rejoins_at,
        obstacles=context.obstruction.names,
        work=context.work,
        position_jump=position,
        heading_jump=heading,
        curvature_jump=curvature,
        path=solution.path,
        old_path=old.path,
        driven=old.driven,
    )


def _jumps(old: Path, new: Path, at: float) -> tuple[float, float, float]:
    """How far two paths are apart where one leaves the other: in place, heading and curvature.

    The new one is compared with the old one as that would have gone on. So a jump that the
    old one has at a via point anyway doesn't count.

    Returns:
        [m], [rad], [1/m].
    """
    before, after = _going_on(old, at), _going_on(new, at)
    gap = float(np.linalg.norm(after[0] - before[0]))
    return gap, abs(math.remainder(after[1] - before[1], math.tau)), abs(after[2] - before[2])


def _going_on(path: Path, at: float) -> tuple[Floats, float, float]:
    """Position, heading and curvature just after a place."""
    u, end = float(path.parameter(at)), path.domain[1]
    nearest = round(u)
    if abs(u - nearest) < SAME_U and nearest < end:
        u = float(nearest)  # the side after the joint, whatever the rounding says
    place: Floats = np.asarray(path.evaluate(u))
    return place, float(path.heading(u)), float(path.curvature(u))
