"""Small lattices, and what is true of motions on them, by brute force."""

from collections import deque
from itertools import pairwise, product

import numpy as np
from hypothesis import strategies as st


def lattice_of(free):
    """The neighbours of the free cells of a grid of flags."""
    numbers = np.full((free.shape[0] + 2, free.shape[1] + 2), -1, np.int32)
    numbers[1:-1, 1:-1][free] = np.arange(free.sum())
    beside = numbers[1:-1, 2:], numbers[2:, 1:-1], numbers[1:-1, :-2], numbers[:-2, 1:-1]
    return np.ascontiguousarray(np.stack([part[free] for part in beside], axis=-1))


@st.composite
def problems(draw, most_cells=7, most_robots=3):
    """A small lattice, and robots with different starts and different goals."""
    rows, columns = draw(st.sampled_from([(1, 5), (2, 3), (2, 4), (3, 3)]))
    flags = draw(st.lists(st.booleans(), min_size=rows * columns, max_size=rows * columns))
    free = np.array(flags).reshape(rows, columns)
    while free.sum() > most_cells:
        free[tuple(np.argwhere(free)[-1])] = False
    free.flat[0] = True
    cells = int(free.sum())
    robots = draw(st.integers(1, min(most_robots, cells)))
    starts = draw(st.permutations(range(cells)))[:robots]
    goals = draw(st.permutations(range(cells)))[:robots]
    return lattice_of(free), np.array(starts, np.int32), np.array(goals, np.int32)


def goes_in_a_ring(before, after):
    """Whether some robots go each to the cell of the next."""
    who = {cell: robot for robot, cell in enumerate(before)}
    for robot in range(len(before)):
        ahead = robot
        for _ in before:
            if before[ahead] == after[ahead] or after[ahead] not in who:
                break
            ahead = who[after[ahead]]
            if ahead == robot:
                return True
    return False


def may_follow(before, after):
    """Whether nobody meets and nobody goes in a ring."""
    return len(set(after)) == len(after) and not goes_in_a_ring(before, after)


def is_a_way(neighbours, starts, goals, places):
    """Whether all go from start to goal, from cell to cell, and never meet or go in a ring."""
    steps = list(zip(*places.tolist(), strict=True))
    return (
        steps[0] == tuple(starts)
        and steps[-1] == tuple(goals)
        and all(
            a == b or b in neighbours[a]
            for before, after in pairwise(steps)
            for a, b in zip(before, after, strict=True)
        )
        and all(may_follow(a, b) for a, b in pairwise(steps))
    )


def keeps_a_step_apart(places):
    """Whether nobody goes to a cell in which another one was when it set out."""
    return all(
        places[robot, step + 1] == places[robot, step]
        or places[robot, step + 1] not in np.delete(places[:, step], robot)
        for step in range(places.shape[1] - 1)
        for robot in range(len(places))
    )


def there_is_a_way(neighbours, starts, goals):
    """By search among all configurations."""
    seen, queue = {tuple(starts)}, deque([tuple(starts)])
    while queue:
        before = queue.popleft()
        if before == tuple(goals):
            return True
        options = [[a, *(b for b in neighbours[a] if b >= 0)] for a in before]
        for after in product(*options):
            if after not in seen and may_follow(before, after):
                seen.add(after)
                queue.append(after)
    return False
