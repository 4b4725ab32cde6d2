"""Why a robot isn't served, in words: who is in its way, where, and how.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.fleet.unserved.blocked_stretch import BlockedStretch

SHORT_M = 3.0
"""A shorter stretch is told as a place [m]."""


@dataclass(frozen=True)
class Blocking:
    """That one robot is in the way of another one.

    Attributes:
        name: The robot that isn't served.
        other: The other one.
        stands: Whether that isn't served either, and stands at its start.
        stretch: Where.
    """

    name: str
    other: str
    stands: bool
    stretch: BlockedStretch


def reason_of(blocking: Blocking, *, is_proven: bool) -> str:
    """Why a robot isn't served.

    Args:
        blocking: Who is in the way, and where.
        is_proven: Whether it is proven that not both can be served.
    """
    name, other = repr(blocking.name), repr(blocking.other)
    how = _how(blocking)
    if is_proven:
        return f"{how}; whatever they do, {name} and {other} can't both get to where they have to"
    return how


def _how(blocking: Blocking) -> str:
    """Who rests where whom has to pass, or where they meet."""
    name, other, one = repr(blocking.name), repr(blocking.other), blocking.stretch
    along = f"{max(one.span[0], 0.0):.1f} m along its path"
    beside = f"{max(one.span[2], 0.0):.1f} m along its path"
    if one.at_start and one.other_start:
        return f"{name} and {other} have to get past each other {_place(one)}"
    if blocking.stands and one.other_start:
        return f"{other}, which isn't served, stands at its start where {name} has to pass, {along}"
    if one.other_goal:
        return f"{other} rests at its goal where {name} has to pass, {along}"
    if one.other_start:
        return f"{other} stands at its start where {name} has to pass, {along}"
    if one.at_goal:
        return f"{name} would rest at its goal where {other} has to pass, {beside}"
    if one.at_start:
        return f"{name} stands at its start where {other} has to pass, {beside}"
    return f"{name} can't let {other} pass {_place(one)}"


def _place(one: BlockedStretch) -> str:
    """Where a stretch is."""
    (x0, y0), (x1, y1) = one.ends
    if one.length < SHORT_M or math.dist(*one.ends) < SHORT_M:
        return f"at ({x0:.1f}, {y0:.1f})"
    return f"on the {one.length:.1f} m from ({x0:.1f}, {y0:.1f}) to ({x1:.1f}, {y1:.1f})"
