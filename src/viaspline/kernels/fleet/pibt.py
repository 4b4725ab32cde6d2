"""The next step of all robots on a lattice, by priority inheritance with backtracking (PIBT).

Okumura, Machida, Défago and Tamura: Priority inheritance with backtracking for iterative
multi-agent path finding, Artificial Intelligence 310, 2022. A robot that wants the cell of another
one lets that one choose first; if it finds nothing, the robot takes its next best cell. Here nobody
moves in a ring: see ``lattice_table``.

Tested through ``kernels/fleet/test_lacam``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Ints, Steps
from viaspline.kernels.fleet.corridor_swaps import can_swap, must_swap
from viaspline.kernels.fleet.random_numbers import random_below
from viaspline.kernels.jit import inlined, inner


class StepChoice(NamedTuple):
    """Where all robots are, and where they go next.

    Attributes:
        at: Their cells, (n,).
        to: Their cells at the next step, -1 as long as that is open, (n,).
        here: Who is in a cell, the number of the robot plus 1, 0 for nobody, (cells,).
        there: Who is in a cell at the next step, as far as that is known, (cells,).
        stack: Robots that wait for the choice of the one above, (n,).
        options: The cells that each of these may go to, the best one first, (n, k + 1).
        tried: How many of them were tried, and how many there are, (n, 2).
        pulled: The robot that each of these pulls along to change places with it, or -1, (n,).
        goals: Cells, (n,).
        neighbours: The lattice, (cells, k).
        distances: Steps to every goal, (n, cells).
        random: The state of the random numbers, (1,).
    """

    at: Steps
    to: Steps
    here: Steps
    there: Steps
    stack: Steps
    options: Steps
    tried: Steps
    pulled: Steps
    goals: Steps
    neighbours: Steps
    distances: Steps
    random: Ints


@inner
def new_choice(neighbours: Steps, goals: Steps, distances: Steps, seed: int) -> StepChoice:
    """Room for the choices of all robots."""
    robots, width = len(distances), neighbours.shape[1]
    return StepChoice(
        np.empty(robots, np.int32),
        np.empty(robots, np.int32),
        np.zeros(len(neighbours), np.int32),
        np.zeros(len(neighbours), np.int32),
        np.empty(robots, np.int32),
        np.empty((robots, width + 1), np.int32),
        np.empty((robots, 2), np.int32),
        np.empty(robots, np.int32),
        goals,
        neighbours,
        distances,
        np.full(1, seed % 2147483646 + 1, np.int64),
    )


@inlined
def may_step(choice: StepChoice, robot: int, cell: int) -> bool:
    """Whether a robot may go to a cell, as far as the others' next cells are known."""
    if choice.there[cell] != 0:
        return False
    home = choice.at[robot]
    if cell == home:
        return True
    ahead = choice.here[cell]
    while ahead != 0:
        further = choice.to[ahead - 1]
        if further == home:
            return False  # round in a ring
        if further < 0 or further == choice.at[ahead - 1]:
            return True
        ahead = choice.here[further]
    return True


@inlined
def step_to(choice: StepChoice, robot: int, cell: int) -> None:
    """Let a robot go to a cell."""
    choice.to[robot] = cell
    choice.there[cell] = robot + 1


@inner
def _put_on_stack(choice: StepChoice, depth: int, robot: int) -> None:
    """Sort the cells that a robot may go to: near the goal, then empty, then by chance."""
    choice.stack[depth] = robot
    width = choice.neighbours.shape[1]
    cell = choice.at[robot]
    turn = random_below(choice.random, width)
    count = 0
    for k in range(width + 1):
        to = cell if k == width else choice.neighbours[cell, (k + turn) % width]
        if to < 0:
            continue
        at = count
        key = 2 * choice.distances[robot, to] + (choice.here[to] != 0 and to != cell)
        while at > 0:
            other = choice.options[depth, at - 1]
            if (
                2 * choice.distances[robot, other] + (choice.here[other] != 0 and other != cell)
                <= key
            ):
                break
            choice.options[depth, at] = other
            at -= 1
        choice.options[depth, at] = to
        count += 1
    choice.tried[depth, 0] = 0
    choice.tried[depth, 1] = count
    other = _to_swap_with(choice, robot, choice.options[depth, 0])
    choice.pulled[depth] = other
    if other >= 0:
        for k in range(count // 2):
            last = count - 1 - k
            kept = choice.options[depth, k]
            choice.options[depth, k] = choice.options[depth, last]
            choice.options[depth, last] = kept


@inner
def _to_swap_with(choice: StepChoice, robot: int, best: int) -> int:
    """The robot that one has to change places with before it can go on; -1 if there is none.

    Either it stands in its way, or it is behind and wants to pass, and the one makes room for it.
    """
    cell = choice.at[robot]
    if best == cell:
        return -1
    neighbours, here, goals = choice.neighbours, choice.here, choice.goals
    other = here[best] - 1
    if (
        other >= 0
        and choice.to[other] < 0
        and must_swap(neighbours, choice.distances, here, goals, robot, other, cell, best)
        and can_swap(neighbours, here, goals, best, cell)
    ):
        return other
    for k in range(neighbours.shape[1]):
        near = neighbours[cell, k]
        if near < 0 or near == best:
            continue
        other = here[near] - 1
        if (
            other >= 0
            and choice.to[other] < 0
            and must_swap(neighbours, choice.distances, here, goals, other, robot, cell, best)
            and can_swap(neighbours, here, goals, best, cell)
        ):
            return other
    return -1


@inner
def _pull_along(choice: StepChoice, depth: int) -> None:
    """Let robots follow those on the stack that pull them, if these do what they wanted first."""
    for level in range(depth, -1, -1):
        robot, other = choice.stack[level], choice.pulled[level]
        if other < 0 or choice.tried[level, 0] != 1 or choice.to[other] >= 0:
            continue
        if may_step(choice, other, choice.at[robot]):
            step_to(choice, other, choice.at[robot])


@inner
def step_by_priority(choice: StepChoice, first: int) -> bool:
    """Choose where a robot goes next, and where those go whom it drives from their cells.

    Returns:
        Whether it may go somewhere; if not, it is entered where it is, where another one is, too.
    """
    depth = 0
    _put_on_stack(choice, 0, first)
    while depth >= 0:
        robot = choice.stack[depth]
        drives_away = False
        while choice.tried[depth, 0] < choice.tried[depth, 1]:
            cell = choice.options[depth, choice.tried[depth, 0]]
            choice.tried[depth, 0] += 1
            if not may_step(choice, robot, cell):
                continue
            step_to(choice, robot, cell)
            other = choice.here[cell] - 1
            if other < 0 or choice.to[other] >= 0:
                _pull_along(choice, depth)
                return True  # and with it all that wait for it
            depth += 1
            _put_on_stack(choice, depth, other)
            drives_away = True
            break
        if not drives_away:
            step_to(choice, robot, choice.at[robot])
            depth -= 1
    return False
