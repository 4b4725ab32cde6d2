"""Turn paths, and the like, as the curve that leads through a row of via points.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.planning.problem.heights import with_heights
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.turning.bend_row import DETOUR
from viaspline.planning.turning.turn_path import TurnPath


def through_turns(sequence: ViaSequence, turn_paths: Sequence[TurnPath]) -> SplinePath:
    """The curve of turn paths that follow each other, with heights if the vias have them.

    Args:
        sequence: The via points.
        turn_paths: One that leads through all of them, or some that follow each other; those of a
            round begin at any via point.
    """
    joints: list[int] = []
    detours: list[int] = []
    first = 0
    for turn_path in turn_paths:
        vias = turn_path.bends.vias if turn_path.bends.closed else turn_path.bends.vias[:-1]
        begins = first + turn_path.begins[: len(vias)]
        joints += begins[vias != DETOUR].tolist()
        detours += begins[vias == DETOUR].tolist()
        first += len(turn_path.spans)
    spans = np.concatenate([turn_path.spans for turn_path in turn_paths])
    seam = joints[-int(turn_paths[0].bends.vias[0])] if sequence.closed else 0
    spans = np.roll(spans, -seam, axis=0)
    joints = [*sorted((u - seam) % first for u in joints), first]
    detours = sorted((u - seam) % first for u in detours)
    return through_spans(sequence, spans, np.array(joints), detours)


def through_spans(
    sequence: ViaSequence, spans: Floats, joints: Ints, detours: Sequence[int]
) -> SplinePath:
    """Planar spans with the heights of the via points, and exactly through their places.

    Args:
        sequence: The via points.
        spans: [m], (m, 4, 2).
        joints: The span that begins at each via point, as in ``SplinePath``.
        detours: Spans that begin at a detour via point.
    """
    places = sequence.places
    spans, begins = with_heights(spans, joints, places[:, 2:], sequence.closed)
    joints, detours = begins[joints], begins[list(detours)].tolist()
    spans[1:, 0] = spans[:-1, 3]  # they meet but for rounding
    for u, at in zip(joints, places, strict=True):
        if u < len(spans):
            spans[u, 0] = at
        if u > 0:
            spans[u - 1, 3] = at
    return SplinePath.through(sequence, spans, joints, detours)
