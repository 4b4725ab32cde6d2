"""The paths of a fleet, cut into cells, as the kernels of fleets see them.

Tested through ``fleet/test_courses``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Floats, Ints


class PackedCourses(NamedTuple):
    """All paths of a fleet, cut at nodes into cells that are nearly straight.

    The nodes of robot r are ``first[r]`` to ``first[r + 1] - 1``. Cell k lies between nodes k and
    k + 1 of one robot: there is none at the last node of a robot. A robot whose path is a single
    place has two nodes at distance 0.

    In cell k the curve is never farther than ``bow[k]`` from the point of the chord that lies in
    the same proportion between its nodes as the distance along the curve does.

    Attributes:
        first: (n + 1,).
        distance: Along the path of its robot [m], increasing from 0 for each robot, (nodes,).
        place: On the curve, in the plane [m], (nodes, 2).
        bow: [m], (nodes,); 0 at the last node of a robot.
        reach: How far a robot keeps others away on its part: its body's circle, how far it gets
            beside its path, and half of the separation [m], (n,). Two robots' centres are to be
            ``reach[i] + reach[j]`` apart.
    """

    first: Ints
    distance: Floats
    place: Floats
    bow: Floats
    reach: Floats
