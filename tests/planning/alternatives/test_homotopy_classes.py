"""Rows of taut paths, laid from the shortest to the longest."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.alternatives.homotopy_classes import (
    Attempt,
    TautRow,
    cheapest_laid,
    gap_across,
)
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.routing.taut_path import TautPath
from viaspline.world.world import World


@dataclass(frozen=True)
class Laid:
    """Something of a length."""

    length: float


def row(length: float) -> TautRow:
    corners = np.zeros((2, 8))
    corners[1, 0] = length
    return TautRow.of([TautPath(corners, np.empty((0, 6)), length)])


class Length:
    """Little of length."""

    def of(self, laid: Laid, /) -> float:
        return laid.length

    def least(self, row: TautRow, /) -> float:
        return row.length


LENGTH = Length()
lengths = st.lists(st.floats(1, 100).map(lambda x: round(x, 2)), min_size=1, max_size=8)


@given(lengths, st.lists(st.floats(1, 3), min_size=8, max_size=8))
def test_the_shortest_of_all_that_can_be_laid_is_found(ways: list[float], more: list[float]):
    """What is laid along a row is no shorter than it: brute force over all."""
    needed = {way: way * extra for way, extra in zip(ways, more, strict=False)}
    tried: list[float] = []

    def attempt(one: TautRow, bound: float) -> Attempt[Laid]:
        tried.append(one.length)
        return Attempt(Laid(needed[one.length]))

    found = cheapest_laid([row(way) for way in ways], attempt, LENGTH)
    assert found is not None
    assert found.length <= min(needed.values()) * (1 + 2e-6)
    assert tried == sorted(tried)
    assert all(way <= found.length * (1 + 2e-6) for way in tried)


def test_rows_after_a_stuck_one_are_tried_in_their_turn() -> None:
    after = {5.0: (9.0, 7.0), 7.0: (8.0,)}

    def attempt(one: TautRow, bound: float) -> Attempt[Laid]:
        if one.length in after:
            return Attempt(None, map(row, after[one.length]))
        return Attempt(Laid(one.length + 0.5))

    assert cheapest_laid([row(5.0)], attempt, LENGTH) == Laid(8.5)
    assert cheapest_laid([row(5.0)], attempt, LENGTH, max_rows=2) is None
    assert cheapest_laid([row(5.0)], attempt, LENGTH, best=Laid(8.0)) == Laid(8.0)


def test_rows_that_lie_alike_are_one_and_are_found_only_when_they_are_needed() -> None:
    asked: list[float] = []

    def others() -> Iterator[TautRow]:
        asked.append(0.0)
        yield row(6.0)

    def attempt(one: TautRow, bound: float) -> Attempt[Laid]:
        asked.append(one.length)
        return Attempt(Laid(20.0), others()) if len(asked) == 1 else Attempt(Laid(30.0), others())

    assert cheapest_laid([row(5.0), row(5.0 + 1e-9)], attempt, LENGTH) == Laid(20.0)
    assert asked == [5.0, 0.0, 6.0]


def test_ways_of_one_length_on_either_side_are_two() -> None:
    """A disc in the middle of a leg is as far round on the left as on the right."""
    tried = 0

    def attempt(one: TautRow, bound: float) -> Attempt[Laid]:
        nonlocal tried
        tried += 1
        return Attempt(Laid(20.0 + one.taut_paths[0].corners[1, 1]))

    left, right = past(2.0), past(-2.0)
    assert left.is_same(past(2.0))
    assert not left.is_same(right)
    assert cheapest_laid([left, right], attempt, LENGTH) == Laid(18.0)
    assert tried == 2


def past(off: float) -> TautRow:
    """From (0, 0) to (10, 0) over a place to the left of the line."""
    corners = np.zeros((3, 8))
    corners[:, :2] = (0, 0), (5, off), (10, 0)
    return TautRow.of([TautPath.through(corners)])


def test_the_segment_across_a_gap_goes_from_wall_to_wall() -> None:
    walls = [[(0, 2), (10, 2), (10, 9), (0, 9)], [(0, -9), (10, -9), (10, -3), (0, -3)]]
    world = World([Obstacle(polygon=ring) for ring in walls])
    corners = np.zeros((2, 8))
    corners[:, 0] = -5, 15
    path = TautPath(corners, np.empty((0, 6)), 20.0)
    found = gap_across(world, Requirements(radius=1.0, clearance=0.0), path, np.array([4.0, 2.0]))
    assert found is not None
    ends = shapely.MultiPoint(found.reshape(2, 2))
    assert all(
        min(shapely.Polygon(ring).distance(point) for ring in walls) < 2e-3 for point in ends.geoms
    )
    assert abs(abs(found[0, 3] - found[0, 1]) - 5.0) < 1e-2
