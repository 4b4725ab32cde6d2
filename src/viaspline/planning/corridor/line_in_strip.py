"""A line in a strip on its way to the least curvature: a spline that its control points move.

Tested through ``planning/corridor/test_corridor_planner``.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

from viaspline.kernels.arrays import Floats, Ints
from viaspline.planning.corridor.bspline import Knots
from viaspline.planning.corridor.strip_problem import StripProblem

SAMPLES_PER_SPAN = 3  # samples
SPAN_WIDTHS = 0.4  # of the strip's width: the length of a span
MAX_SPANS = 2000  # spans
NEWTON_STEPS = 8  # steps to the place that is nearest to a gate


@dataclass(frozen=True, eq=False)
class Line:
    """A line on its way to the least curvature.

    Attributes:
        knots: Of its spline.
        controls: Control points [m], (n, 2).
        rows: Nearest row of the strip at each sample.
        at: Parameters of the gates.
        extra: Added to the margin at each sample [m].
    """

    knots: Knots
    controls: Floats
    rows: Ints
    at: Floats
    extra: Floats

    @classmethod
    def through(cls, points: Floats, rows: Ints, task: StripProblem) -> Line:
        """The line through points at equal distances.

        Args:
            points: Close together along it [m], (k, 2).
            rows: The strip's row that is nearest to each.
            task: What it keeps.
        """
        closed = task.strip.closed
        ring = np.vstack((points, points[:1])) if closed else points
        along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(ring, axis=0), axis=1))]
        long = max(SPAN_WIDTHS * task.width, along[-1] / MAX_SPANS)
        knots = Knots(max(round(along[-1] / long), 8), closed)
        curve = CubicSpline(along, ring, bc_type="periodic" if closed else "natural")
        equal = np.linspace(0.0, along[-1], knots.count + 1)
        controls = knots.through(curve(equal[:-1] if closed else equal))
        at = samples(knots, SAMPLES_PER_SPAN)
        count = len(task.strip.middle)
        unwrapped = np.unwrap(rows, period=count) if closed else rows
        if closed:
            unwrapped = np.r_[unwrapped, unwrapped[0] + count]
        guess = np.rint(np.interp(at * along[-1] / knots.count, along, unwrapped)).astype(np.int64)
        places = knots.matrix(at) @ controls
        found = task.strip.follow(places, guess, task.window)
        line = cls(knots, controls, found, np.zeros(0), np.zeros(at.size))
        return replace(line, at=line.passing(task, places, at))

    def passing(self, task: StripProblem, places: Floats, at: Floats) -> Floats:
        """Parameters at which the line is nearest to the gates."""
        if not task.gates:
            return np.zeros(0)
        closed, count = self.knots.closed, float(self.knots.count)
        aims = np.array([gate.place for gate in task.gates])
        rows = np.array([gate.row for gate in task.gates])
        apart = np.abs(self.rows - rows[:, None])
        if closed:
            size = len(task.strip.middle)
            apart = np.minimum(apart % size, -apart % size)
        gap = np.linalg.norm(places - aims[:, None], axis=2)
        found = at[np.where(apart <= task.window, gap, np.inf).argmin(axis=1)]
        for _ in range(NEWTON_STEPS):
            here = found % count if closed else np.clip(found, 0.0, count)
            place, slope, bend = (self.knots.matrix(here, k) @ self.controls for k in range(3))
            away = place - aims
            steep = (slope * slope).sum(axis=1)
            steep = np.maximum(steep + (away * bend).sum(axis=1), 0.1 * steep)
            found = here - np.clip((away * slope).sum(axis=1) / steep, -0.5, 0.5)
        if closed:
            return np.asarray(found % count, np.float64)
        found[0], found[-1] = 0.0, count
        return np.asarray(np.clip(found, 0.0, count), np.float64)

    @property
    def spans(self) -> Floats:
        """Bézier control polygons [m], (m, 4, 2)."""
        return self.knots.spans(self.controls)


def samples(knots: Knots, each: int) -> Floats:
    """Equally spaced parameters, the end of an open spline among them."""
    return np.arange(each * knots.count + (not knots.closed)) / each
