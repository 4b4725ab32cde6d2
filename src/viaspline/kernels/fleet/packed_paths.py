"""All paths of a fleet behind each other, as the kernel takes them that cuts them.

Tested through ``fleet/test_courses``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Floats, Ints


class PackedPaths(NamedTuple):
    """The paths of a fleet and the distances at which they are to be cut.

    Attributes:
        rows: Taylor coefficients of every path's spans; see ``kernels.curve.cubic``, (m, 4, d).
        row_first: Where the rows of each path begin, and where the last ones end, (n + 1,).
        at: Parameters at which the panels of its length integral meet, each path's from 0, (p,).
        along: The distances there [m], (p,).
        panel_first: Where ``at`` and ``along`` of each path begin, (n + 1,).
        knots: Distances that have to be nodes [m], not decreasing within a path, (k,).
        knot_first: Where those of each path begin, (n + 1,).
    """

    rows: Floats
    row_first: Ints
    at: Floats
    along: Floats
    panel_first: Ints
    knots: Floats
    knot_first: Ints
