"""What a world in space answers to a certificate; see ``kernels/clearance/world_protocol``.

Tested through ``world/space/test_spatial_world``.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.world_protocol import (
    answers,
    chord_distance,
    dimension,
    distance_at,
    pace,
)
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.space_distance import space_distance, space_segment


@answers(dimension, PackedSpace)
def _spatial_dimension(space: PackedSpace) -> int:
    return 3


@answers(pace, PackedSpace)
def _spatial_pace(space: PackedSpace) -> float:
    return 0.0


@answers(distance_at, PackedSpace)
def _spatial_distance(
    space: PackedSpace, place: Floats, instant: float, limit: float
) -> tuple[float, int]:
    return space_distance(space, place[0], place[1], place[2], limit)


@answers(chord_distance, PackedSpace)
def _spatial_chord(
    space: PackedSpace, first: Floats, last: Floats, instant: float, limit: float
) -> tuple[float, int]:
    return space_segment(space, first[0], first[1], first[2], last[0], last[1], last[2], limit)
