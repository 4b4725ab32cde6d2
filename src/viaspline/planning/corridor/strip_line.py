"""A line inside a strip, with joints at the places that it runs through.

Tested through ``planning/corridor/test_corridor_planner``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from viaspline.errors import NoPathError
from viaspline.kernels.arrays import Floats, Ints
from viaspline.planning.corridor.line_in_strip import Line
from viaspline.planning.corridor.strip_problem import StripProblem

AT_JOINT_PART = 1e-9  # a gate so near to a joint lies on it, as a parameter


@dataclass(frozen=True, eq=False)
class StripLine:
    """A line inside a strip.

    Attributes:
        spans: Bézier control polygons [m], (m, 4, 2); of a closed strip the last ends where the
            first starts, at the first place.
        at: Parameters of the places that it runs through, whole numbers, (k,).
    """

    spans: Floats
    at: Ints


def split(line: Line, problem: StripProblem) -> StripLine:
    """The spans of a line with joints at its gates, from the first gate on.

    Raises:
        NoPathError: When it does not come to the gates in their order, naming the first.
    """
    count = line.knots.count
    at = line.at.copy()
    if line.knots.closed:
        laps = (at - at[0]) % count
        laps[0] = 0.0
    else:
        laps = at
    if (np.diff(laps) <= 0.0).any():
        k = int(np.flatnonzero(np.diff(laps) <= 0.0)[0]) + 1
        raise NoPathError(
            "the corridor's line can't serve its places in their order",
            where=problem.gates[k].place, remedy="move them apart along the corridor",
        )  # fmt: skip
    spans = list(line.spans)
    joints = np.empty(at.size, np.int64)
    for k in np.argsort(at)[::-1].tolist():  # from behind, so that those before keep their index
        span = min(int(at[k]), count - 1)
        w = at[k] - span
        if AT_JOINT_PART < w < 1.0 - AT_JOINT_PART:
            spans[span : span + 1] = _halves(spans[span], w)
            joints[at > at[k]] += 1
            joints[k] = span + 1
        else:
            joints[k] = span + round(w)
    whole = np.array(spans)
    if line.knots.closed:
        whole = np.roll(whole, -joints[0], axis=0)
        joints = (joints - joints[0]) % len(whole)
    for gate, joint in zip(problem.gates, joints.tolist(), strict=True):
        if joint > 0 or line.knots.closed:
            whole[joint - 1, 3] = gate.place
        if joint < len(whole):
            whole[joint, 0] = gate.place
    return StripLine(whole, joints)


def _halves(span: Floats, w: float) -> tuple[Floats, Floats]:
    """A cubic cut in two, by de Casteljau."""
    rows = [span]
    for _ in range(3):
        rows.append((1.0 - w) * rows[-1][:-1] + w * rows[-1][1:])
    left = np.array([row[0] for row in rows])
    right = np.array([row[-1] for row in rows[::-1]])
    return left, right
