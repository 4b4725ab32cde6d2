"""Why a corridor has no line: its points, its width and its bends.

Tested through ``planning/corridor/test_corridor_planner``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.mission.strip import Strip
from viaspline.planning.corridor.strip_line import StripLine
from viaspline.planning.problem.via_sequence import ViaSequence


def refuse_disorder(sequence: ViaSequence, strip: Strip) -> None:
    """Refuse points of a route that don't follow each other along the strip.

    Raises:
        NoPathError: Naming the first that lies before the one it comes after.
    """
    rows = np.array([strip.nearest_row(via.at[:2]) for via in sequence.vias])
    if strip.closed:
        rows = (rows - rows[0]) % len(strip.middle)
    for k in np.flatnonzero(np.diff(strip.along[rows]) < 0.0).tolist():
        before, via = sequence.vias[k], sequence.vias[k + 1]
        raise NoPathError(
            f"{via.name!r} lies before {before.name!r} along the corridor", where=via.at[:2],
            remedy="give the points of the route in the direction of the corridor's line",
            via=via.name,
        )  # fmt: skip


def refuse_narrow(strip: Strip, margin: float) -> None:
    """Refuse a strip that is too narrow for a margin [m] on both sides.

    Raises:
        NoPathError: Naming the narrowest place.
    """
    row = int(strip.widths.argmin())
    if strip.widths[row] < 2.0 * (margin - PROOF_SLACK_M):
        where = 0.5 * (strip.left[row] + strip.right[row])
        raise no_room(where, 0.5 * float(strip.widths[row]), margin, strip)


def no_room(
    where: Sequence[float] | Floats, half: float, margin: float, strip: Strip
) -> NoPathError:
    """The error of a place where the line can't keep its margin."""
    wide = float(strip.widths[strip.nearest_row(where)])
    if wide < 2.0 * margin:
        reason = f"the corridor is {wide:.3g} m wide, and the robot needs {2 * margin:.3g} m"
    else:
        reason = (
            f"the corridor's bend leaves {max(half, 0.0):.3g} m to the nearer edge, and the robot "
            f"needs {margin:.3g} m"
        )
    remedy = f"widen it there by {2.0 * (margin - half):.3g} m, or make robot.clearance_m smaller"
    return NoPathError(reason, where=where, remedy=remedy, obstacles=("corridor",))


def refuse_sharp(spline_path: StripLine, max_curvature: float) -> None:
    """Refuse a line that bends more sharply than allowed [1/m].

    Raises:
        NoPathError: Naming the sharpest place.
    """
    curve = PiecewiseCubic(spline_path.spans)
    sharpest, u = curve.max_curvature()
    if sharpest > max_curvature * (1.0 + 1e-9):
        raise NoPathError(
            f"the corridor bends so sharply that the robot needs a turning circle of radius "
            f"{1.0 / sharpest:.3g} m, and its own has {1.0 / max_curvature:.3g} m",
            where=np.asarray(curve.evaluate(u)), remedy="widen the corridor there",
            obstacles=("corridor",),
        )  # fmt: skip
