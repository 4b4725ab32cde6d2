"""A time law by nodes of its path: when a robot comes to each, when it goes on, and how fast.

Tested through ``fleet/timing/test_time_paths``.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.trajectory.trajectory import Trajectory


def law_at_nodes(law: Trajectory, nodes: Floats) -> tuple[Floats, Floats, Floats]:
    """When a robot comes to nodes, when it goes on, and how fast it is there, (k,) each.

    Args:
        law: It stands at its start from its first time on, and at its end for ever.
        nodes: Distances, from the start to the end [m], (k,).
    """
    come, speed = law.time_at(nodes), law.speed_at(nodes)
    first = np.minimum(law.distances.searchsorted(nodes, side="left"), len(law.times) - 1)
    last = np.maximum(law.distances.searchsorted(nodes, side="right") - 1, 0)
    known = law.distances[first] == nodes
    arrive = np.where(known, law.times[first], come)
    leave = np.where(known, law.times[last], come)
    speed = np.where(known, law.speeds[last], speed)
    arrive[0], leave[-1] = law.times[0], np.inf
    return arrive, leave, speed


def law_through_nodes(
    along: Floats, speed: Floats, arrive: Floats, leave: Floats, static: Trajectory
) -> Trajectory:
    """The law through all nodes of a path, those twice at which the robot stands.

    Args:
        along: Distances of the nodes, increasing [m], (k,).
        speed: There [m/s], (k,).
        arrive: When the robot comes there [s], (k,).
        leave: When it goes on [s], (k,).
        static: Any law along this path.
    """
    stands = np.append(leave[:-1] > arrive[:-1], False)
    twice = np.repeat(np.arange(along.size), 1 + stands)
    times = arrive[twice]
    times[np.flatnonzero(twice[1:] == twice[:-1]) + 1] = leave[stands]
    speeds = speed[twice]
    lasts = np.diff(times)
    rises = np.divide(np.diff(speeds), lasts, out=np.zeros(lasts.size), where=lasts > 0.0)
    return replace(
        static, distances=along[twice], speeds=speeds, times=times, accelerations=rises,
        changes=None, jerks=None,
    )  # fmt: skip
