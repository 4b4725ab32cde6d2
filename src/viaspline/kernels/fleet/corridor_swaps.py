"""Whether two robots that stand in a corridor have to change places, and can.

Okumura: Improving LaCAM for scalable eventually optimal multi-agent pathfinding, IJCAI 2023. One of
them pulls the other along to where the corridor forks, and lets it pass there.

Tested through ``kernels/fleet/test_lacam``.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Steps
from viaspline.kernels.jit import inlined, inner


@inlined
def _goes_on(neighbours: Steps, here: Steps, goals: Steps, back: int, cell: int) -> tuple[int, int]:
    """Into how many cells a way leads on that comes from ``back``, and the last of them.

    Dead ends in which a robot is at its goal don't count.
    """
    count, further = 0, -1
    width = neighbours.shape[1]
    for k in range(width):
        to = neighbours[cell, k]
        if to < 0 or to == back:
            continue
        if here[to] != 0 and goals[here[to] - 1] == to:
            exits = 0
            for other in range(width):
                exits += neighbours[to, other] >= 0
            if exits == 1:
                continue
        count += 1
        further = to
    return count, further


@inner
def must_swap(
    neighbours: Steps, distances: Steps, here: Steps, goals: Steps, pusher: int, puller: int,
    behind: int, ahead: int,
) -> bool:  # fmt: skip
    """Whether one robot wants to go where another one comes from, with no fork on its way.

    Args:
        neighbours: The lattice, (cells, k).
        distances: Steps to every goal, (n, cells).
        here: Who is in a cell, the number of the robot plus 1, (cells,).
        goals: Cells, (n,).
        pusher: The one.
        puller: The other.
        behind: The cell of the pusher.
        ahead: The cell of the puller.
    """
    for _ in range(len(neighbours)):
        if distances[pusher, ahead] >= distances[pusher, behind]:
            break
        count, further = _goes_on(neighbours, here, goals, behind, ahead)
        if count >= 2:
            return False
        if count == 0:
            break
        behind, ahead = ahead, further
    return distances[puller, behind] < distances[puller, ahead] and (
        distances[pusher, behind] == 0 or distances[pusher, ahead] < distances[pusher, behind]
    )


@inner
def can_swap(neighbours: Steps, here: Steps, goals: Steps, behind: int, ahead: int) -> bool:
    """Whether a way that leads from one cell to the next one forks somewhere.

    Args:
        neighbours: The lattice, (cells, k).
        here: Who is in a cell, the number of the robot plus 1, (cells,).
        goals: Cells, (n,).
        behind: The one cell.
        ahead: The next one.
    """
    origin = behind
    for _ in range(len(neighbours)):
        if ahead == origin:
            return False
        count, further = _goes_on(neighbours, here, goals, behind, ahead)
        if count >= 2:
            return True
        if count == 0:
            return False
        behind, ahead = ahead, further
    return False
