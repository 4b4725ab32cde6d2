"""Paths past what moves: the static one first, then round where something will be.

Tested through ``spacetime/test_plan_among``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.errors import GeometryError, PlanningError
from viaspline.mission.shapes.obstacle import Obstacle, Side
from viaspline.planning.alternatives.solution import Solution
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.plan_drive import find_drive
from viaspline.spacetime.meetings import Meeting, first_meeting, times_near
from viaspline.spacetime.standing_ghost import standing_ghost
from viaspline.spacetime.timed_drive import Passing
from viaspline.spacetime.timed_problem import TimedProblem, without_lanes
from viaspline.trajectory.trajectory import Trajectory

MAX_PASSINGS = 4
"""How many times a path is led round something that moves at most."""

LOOKED_AROUND = 2.0
"""So many times the time of the drive, and as long as the goal is held, it is looked where
something is near the path,"""

PLACES_AROUND = 24
"""and at so many instants of that the path is led round it."""

LAID_S = 0.5
"""What laying one of them may spend [s of the reference machine]; most take a hundredth of that."""

SIDES: tuple[Side, Side] = ("left", "right")


@dataclass(frozen=True)
class Alternative:
    """A path that might be driven.

    Attributes:
        solution: Proven clear of what stands.
        free: The law along it if nothing moved.
        ghosts: What it was led round,
        passings: and what that stands for.
        is_searched: Whether it was searched together with its times; see ``searched_paths``.
    """

    solution: Solution
    free: Trajectory
    ghosts: tuple[Obstacle, ...] = ()
    passings: tuple[Passing, ...] = ()
    is_searched: bool = False


def alternatives_to(problem: TimedProblem, taken: Alternative) -> Iterator[Alternative]:
    """Paths that are led round what a path first meets, where it is met, on either side of it.

    What was led round on that side already is led round where it is met now.

    Args:
        problem: What is asked.
        taken: The path with its law, as if nothing moved.
    """
    meeting = _met(problem, taken)
    if meeting is not None:
        yield from _on_either_side(problem, taken, meeting.obstacle, meeting.windows)


def alternatives_elsewhere(problem: TimedProblem, taken: Alternative) -> Iterator[Alternative]:
    """Paths that are led round what a path first meets, where that is before or afterwards.

    There the robot may wait for it, in a bay beside its way or on the far side of it.

    Args:
        problem: What is asked.
        taken: The path with its law, as if nothing moved.
    """
    meeting = _met(problem, taken)
    if meeting is None:
        return
    begin = problem.mission.route.depart_s
    end = begin + LOOKED_AROUND * (taken.free.end_time - begin) + problem.mission.route.hold_s
    path, required = taken.solution.path, problem.required
    near = times_near(path, problem.moving, meeting.obstacle, required, (begin, end))
    if not near.size:
        return
    chosen = near[np.linspace(0, len(near) - 1, PLACES_AROUND).round().astype(int)]
    windows = tuple((time, time) for time in _coarse_first(tuple(dict.fromkeys(chosen.tolist()))))
    yield from _on_either_side(problem, taken, meeting.obstacle, windows)


def _coarse_first(times: tuple[float, ...]) -> list[float]:
    """Times in an order in which those that are tried first lie far apart, wherever it ends.

    >>> _coarse_first((0.0, 1.0, 2.0, 3.0, 4.0))
    [0.0, 4.0, 2.0, 1.0, 3.0]
    """
    digits = (len(times) - 1).bit_length()
    order = sorted(range(len(times)), key=lambda k: f"{k:0{digits}b}"[::-1])
    return [times[k] for k in order]


def _met(problem: TimedProblem, taken: Alternative) -> Meeting | None:
    """What is met first by a path that may be led round something more."""
    if len(taken.passings) >= MAX_PASSINGS:
        return None
    return meeting_of(problem, taken.solution.path, taken.free)


def meeting_of(problem: TimedProblem, path: Path, free: Trajectory) -> Meeting | None:
    """What a path first meets, under way or where the robot holds its goal.

    Args:
        problem: What is asked.
        path: What is driven.
        free: The law along it, as if nothing moved.
    """
    until = free.end_time + problem.mission.route.hold_s
    span = (free.start_time, until)
    return first_meeting(path, free, problem.moving, problem.required, span)


def _on_either_side(
    problem: TimedProblem,
    taken: Alternative,
    obstacle: int,
    windows: tuple[tuple[float, float], ...],
) -> Iterator[Alternative]:
    for window in windows:
        for side in SIDES:
            if problem.budget.is_spent:
                return
            found = _led_round(problem, taken, obstacle, side, window)
            if found is not None:
                yield found


def _led_round(
    problem: TimedProblem,
    taken: Alternative,
    obstacle: int,
    side: Side,
    window: tuple[float, float],
) -> Alternative | None:
    """The path led round one thing more; None where there is none."""
    made = standing_ghost(problem.moving, obstacle, side, window)
    if made is None:
        return None
    ghost, passing = made
    kept = [
        (old, other)
        for old, other in zip(taken.ghosts, taken.passings, strict=True)
        if (other.obstacle, other.side) != (passing.obstacle, passing.side)
    ]
    others = tuple(old for old, _ in kept)
    ghosts = (*others, _named_apart(ghost, others))
    world = problem.world.with_obstacles(ghosts)
    points = [point.at[:2] for _, point in problem.mission.route.points()]
    if (world.distances_to(len(world) - 1, points) < problem.requirements.required).any():
        return None
    squares = problem.squares
    if squares is not None and not squares.may_join(world, points):
        return None
    try:
        with problem.budget.share(LAID_S) as budget:
            requirements = replace(without_lanes(problem.requirements), budget=budget)
            laid = find_drive(problem.mission, world, requirements)
        free = problem.free_law(laid.path)
    except (PlanningError, GeometryError):
        return None
    certificate = proven(laid.path, problem.world, problem.requirements)
    solution = replace(laid, certificate=certificate)
    return Alternative(solution, free, ghosts, (*(other for _, other in kept), passing))


def _named_apart(ghost: Obstacle, others: tuple[Obstacle, ...]) -> Obstacle:
    """The ghost by a name that none of the others has."""
    taken = {other.name for other in others}
    name, number = ghost.name, 2
    while name in taken:
        name, number = f"{ghost.name} ({number})", number + 1
    return ghost.model_copy(update={"name": name})
