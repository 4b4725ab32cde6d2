"""The sides that are asked for along a path that is driven, and where it passes on a wrong one.

A leg under way is held to what was asked of the whole of it: its barriers stand square to the
straight line between the user's two via points, wherever the robot is by now.

Tested through ``test_side_promises``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise

import numpy as np

from viaspline.curve.path import GUIDE, SEAM, Path, PathVia
from viaspline.errors import GaveUpError
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.world.clusters import group_labels
from viaspline.planning.checking.barrier_crossings import crossings
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.via_sequence import WholeLeg
from viaspline.planning.routing.asked_sides import AskedSides, forced_barriers, sided
from viaspline.world.world import World

SAME_U = 1e-9  # a part of a path that is shorter than this in its parameter is none


def leg_ends(path: Path) -> list[PathVia]:
    """The via points between which a path's legs lie: the user's, and a corridor's guides."""
    return [via for via in path.vias if via.kind == "user" or via.name == GUIDE]


def whole_legs(path: Path, u: float, targets: Sequence[PathVia]) -> tuple[WholeLeg, ...]:
    """The legs of the route that lie between ``u`` on a path and some of its via points.

    Args:
        path: What is driven.
        u: Where the first leg is left by now.
        targets: The via points at the ends of the legs, in order.
    """
    passed = [via for via in leg_ends(path) if via.u <= u + SAME_U]
    first = passed[-1] if passed else path.vias[0]
    if not passed and path.vias[-1].name == SEAM:
        first = leg_ends(path)[-1]  # a round's first leg began at what is its last via point now
    return tuple(
        WholeLeg(
            np.array(start.at), np.array(goal.at),
            path.spans[round(start.u) : round(goal.u)] if start.u < goal.u else None,
        )
        for start, goal in pairwise((first, *targets))
    )  # fmt: skip


def spans_on_wrong_side(
    path: Path, u: float, world: World, requirements: Requirements
) -> dict[int, str]:
    """The spans of a path from ``u`` on that pass something on the wrong side, and what that is.

    Args:
        path: What is driven.
        u: From where on.
        world: What is known.
        requirements: What the path keeps.
    """
    indices = sided(world)
    ends = [via for via in leg_ends(path) if via.u > u + SAME_U] if indices.size else []
    found: dict[int, str] = {}
    starts = (u, *(via.u for via in ends[:-1]))
    groups = _groups_of(world, requirements)
    for leg, start, goal in zip(whole_legs(path, u, ends), starts, ends, strict=False):
        ahead = path.section(start, goal.u).spans
        if not crossings(ahead, forced_barriers(leg, indices, world)).any():
            continue  # whether they bind takes longer to find out
        sides = AskedSides.of(
            WholeLeg(leg.start, leg.goal), indices, world, requirements.required, groups
        )
        for k in np.flatnonzero(sides.crossed(ahead)).tolist():
            found[int(start) + k] = world.name(int(sides.wrong(ahead[k : k + 1])[0]))
    return found


def refuse_wrong_side(
    piece: Floats, leg: WholeLeg, world: World, requirements: Requirements
) -> None:
    """Raise GaveUpError for a piece of a leg that passes something on the wrong side.

    Args:
        piece: Its spans [m], (m, 4, d).
        leg: The whole leg.
        world: What is known.
        requirements: What the path keeps.
    """
    groups = _groups_of(world, requirements)
    sides = AskedSides.of(leg, sided(world), world, requirements.required, groups)
    wrong = sides.wrong(piece)
    if wrong.size:
        names = tuple(world.name(int(i)) for i in wrong)
        raise GaveUpError(
            f"{names[0]!r} is too near to turn to the side that is asked for under way",
            where=piece[0, 0],
            remedy="stop and turn on the spot, or look farther ahead",
            tried=("running out before it",),
            obstacles=names,
        )


def _groups_of(world: World, requirements: Requirements) -> Callable[[], Ints]:
    """Gives the label of every obstacle's group, (n,); found once, when it is first asked for."""

    @cache
    def groups() -> Ints:
        labels: Ints = group_labels(world.packed, 2 * requirements.required)
        return labels

    return groups
