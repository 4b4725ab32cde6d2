"""The spline of a via sequence, led round what stands in the way of the disc in the body.

Tested through ``planning/methods/test_clear_spline``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from viaspline.planning.alternatives.passed_leg import PassedLeg
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.routing.asked_sides import AskedSides


@dataclass(frozen=True)
class ClearedSpline:
    """A clear spline, with what it was led round.

    Attributes:
        spline_path: The curve.
        sides: For every leg, the sides that bind it by now.
        passed: The legs that were led round something.
    """

    spline_path: SplinePath
    sides: tuple[AskedSides, ...]
    passed: Mapping[int, PassedLeg] = field(default_factory=dict)
