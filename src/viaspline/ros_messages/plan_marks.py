"""The marks of a plan and of what happens on its drive."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import count
from typing import Any, Final

import numpy as np

from viaspline.curve.path import Path
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.planner import Plan
from viaspline.robot.run import Event
from viaspline.ros_messages.log_message import ERROR, WARN, level_of
from viaspline.ros_messages.marker_message import Colour, ball, line, words

DETOUR: Final[Colour] = (0.90, 0.45, 0.00, 1.0)
SIDE: Final[Colour] = (0.45, 0.45, 0.45, 0.5)
PROOF: Final[Colour] = (0.10, 0.55, 0.30, 1.0)
LACKING: Final[Colour] = (0.80, 0.10, 0.10, 1.0)
PLAIN: Final[Colour] = (0.15, 0.35, 0.75, 1.0)
_POINTS: Final = 60
"""Points of the line of a side that was not taken."""


def plan_marks(time: float, plan: Plan, size: float) -> list[dict[str, Any]]:
    """Detours, the sides that were not taken, and where the certificate is tightest.

    Args:
        time: [s].
        plan: What is shown.
        size: Height of the words [m].

    >>> from viaspline.mission.model import Mission
    >>> from viaspline.planner import plan
    >>> planned = plan(Mission.model_validate({
    ...     "world": {"known": [{"circle": {"center": [25, 0.5], "radius": 4}}]},
    ...     "route": {"start": [0, 0], "goal": [50, 0]},
    ... }))
    >>> [mark["ns"] for mark in plan_marks(0.0, planned, 0.3)]
    ['detours', 'sides', 'sides', 'certificate', 'certificate']
    """
    marks = path_marks(time, plan.path, size)
    numbers = count()
    for entry in plan.ledger:
        for one in entry.candidates:
            if one.chosen or not len(one.spans):
                continue
            curve = PiecewiseCubic(one.spans)
            points = np.asarray(curve.at_distance(np.linspace(0.0, curve.length, _POINTS)))
            length = "" if one.length is None else f" {one.length:.1f} m"
            marks.append(line(time, "sides", next(numbers), points.tolist(), 0.1 * size, SIDE))
            middle = points[_POINTS // 2].tolist()
            text = f"{one.side} of {', '.join(entry.members)}:{length}"
            marks.append(words(time, "sides", next(numbers), middle, 0.7 * size, SIDE, text))
    proof = plan.certificate
    if np.isfinite(proof.clearance):
        colour = PROOF if proof.holds else LACKING
        text = f"{proof.clearance:.3f} m clear of {proof.obstacle} (asked: {proof.required:g} m)"
        marks.append(ball(time, "certificate", 0, proof.tightest_at, 0.6 * size, colour))
        marks.append(
            words(time, "certificate", 1, _above(proof.tightest_at, size), size, colour, text)
        )
    return marks


def path_marks(time: float, path: Path, size: float) -> list[dict[str, Any]]:
    """The detour via points of a path.

    >>> from viaspline.curve.path import PathVia
    >>> via = PathVia("detour 1", (1.0, 0.0), "detour", 0.5)
    >>> path_marks(0.0, Path([[[0, 0], [1, 0], [2, 0], [3, 0]]], [via]), 0.3)[0]["ns"]
    'detours'
    """
    detours = [via for via in path.vias if via.kind == "detour"]
    return [ball(time, "detours", i, via.at, size, DETOUR) for i, via in enumerate(detours)]


def event_mark(time: float, number: int, event: Event, size: float) -> dict[str, Any]:
    """What happened, in words where it happened.

    >>> event_mark(1.0, 4, Event("via", 1.0, (3.0, 4.0), "passes 'pump'"), 0.3)["text"]
    "passes 'pump'"
    """
    level = level_of(event.kind)
    colour = LACKING if level >= ERROR else DETOUR if level >= WARN else PLAIN
    return words(time, "events", number, _above(event.at, size), size, colour, event.message)


def _above(at: Sequence[float], size: float) -> list[float]:
    return [at[0], at[1], (at[2] if len(at) > 2 else 0.0) + size]
