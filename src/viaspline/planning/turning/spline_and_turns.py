"""Turns on the blocked legs alone, with the spline as it is on all others.

Where a mission says how taut its spline is to be, that is what it gets wherever nothing stands in
the way. Turns begin and end straight, in the direction of the spline at the via point; the leg
beside them takes that over, with its other end as it was.

Tested through ``planning/turning/test_spline_and_turns``.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import replace

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cardinal_tangents import flattened
from viaspline.planning.problem.via_sequence import Leg, ViaSequence, lay
from viaspline.planning.turning.bend_row import DETOUR, Bends, LegBends, bends_of_legs
from viaspline.planning.turning.turn_path import TurnPath

LayRow = Callable[[Bends], TurnPath | None]


def runs_of(blocked: Collection[int], legs: int, closed: bool) -> Iterator[tuple[int, ...]]:
    """Legs that follow each other and are blocked, in the order of the path.

    Example:
        >>> list(runs_of({0, 2, 3}, 5, closed=False))
        [(0,), (2, 3)]
        >>> list(runs_of({0, 3, 4}, 5, closed=True))
        [(3, 4, 0)]
    """
    for first in sorted(blocked):
        before = (first - 1) % legs if closed else first - 1
        if before in blocked:
            continue
        run = [first]
        while (after := (run[-1] + 1) % legs if closed else run[-1] + 1) in blocked:
            run.append(after)
        yield tuple(run)


def turns_on_runs(
    sequence: ViaSequence, bends: Sequence[LegBends], blocked: Collection[int], lay_row: LayRow
) -> tuple[Floats, list[int], list[int], float] | None:
    """The spline of a sequence, with turns on its blocked legs.

    Args:
        sequence: Via points without detours, some of its legs free.
        bends: Those of each leg.
        blocked: Its blocked legs.
        lay_row: Lays a clear turn path round a row of bends, if it can.

    Returns:
        The spans [m], (m, 4, 2), the span that begins at each via point and m where the last one
        ends, the spans that begin at detour via points, and the largest turn [rad]; None where
        there is no room.
    """
    if sequence.tangents != "continuous":  # a leg of one cubic can begin or end straight nowhere
        return None
    first = sequence.first_spans()
    spline = np.ascontiguousarray(lay(sequence)[:, :, :2])
    count = len(sequence.legs)
    legs = [spline[first[k] : first[k + 1]] for k in range(count)]
    detours: dict[int, list[int]] = {}
    largest = 0.0
    for run in runs_of(blocked, count, sequence.closed):
        before, after = run[0] - 1, run[-1] + 1
        if sequence.closed:
            before, after = before % count, after % count
        part = _part(sequence, run, spline[first[run[0]]], spline[first[run[-1] + 1] - 1])
        turn_path = lay_row(bends_of_legs(part, [bends[k] for k in run]))
        if turn_path is None:
            return None
        largest = max(largest, turn_path.largest_turn)
        vias = turn_path.bends.vias
        ends = [*turn_path.begins[vias != DETOUR].tolist()[:-1], len(turn_path.spans)]
        for k, a, b in zip(run, ends, ends[1:], strict=False):
            legs[k] = turn_path.spans[a:b]
            begins = turn_path.begins[vias == DETOUR]
            detours[k] = (begins[(begins > a) & (begins < b)] - a).tolist()
        if before >= 0:
            legs[before] = flattened(np.ascontiguousarray(legs[before]), False, True)
        if after < count:
            legs[after] = flattened(np.ascontiguousarray(legs[after]), True, False)
    joints = np.cumsum([0, *(len(leg) for leg in legs)])
    places = [int(joints[k]) + at for k, inner in detours.items() for at in inner]
    return np.concatenate(legs), joints.tolist(), sorted(places), largest


def _part(sequence: ViaSequence, run: Sequence[int], begin: Floats, end: Floats) -> ViaSequence:
    """The via points of some legs, in the directions of the spline where it goes on."""
    vias = [sequence.ends(run[0])[0], *(sequence.ends(k)[1] for k in run)]
    last = len(sequence.vias) - 1
    is_first = not sequence.closed and run[0] == 0
    is_last = not sequence.closed and run[-1] + 1 == last
    return replace(
        sequence,
        vias=tuple(vias),
        legs=tuple(Leg.straight(0.5, len(vias[0].at)) for _ in run),
        closed=False,
        start_tangent=sequence.start_tangent if is_first else begin[1] - begin[0],
        end_tangent=sequence.end_tangent if is_last else end[3] - end[2],
        parts_of=(),
    )
