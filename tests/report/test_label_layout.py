"""The layout of labels, beside a search through all choices."""

from __future__ import annotations

from itertools import product

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.report.label_layout import (
    LEFT_OUT,
    LabelPlaces,
    cost_of,
    least_cost_places,
    overlaps,
)

NOWHERE = np.full((1, 2), np.nan)


def _label(corners: list[tuple[int, int]], left_out: float = 50.0) -> LabelPlaces:
    low = np.array(corners, float)
    boxes = np.hstack((low, low + np.array([4.0, 2.0])))
    leaders = np.broadcast_to(NOWHERE, (len(boxes), 1, 2)).copy()
    return LabelPlaces(boxes, np.arange(1.0, len(boxes) + 1.0), leaders, left_out)


corners = st.lists(st.tuples(st.integers(0, 9), st.integers(0, 6)), min_size=1, max_size=3)


def _apart(labels: list[LabelPlaces], chosen: tuple[int, ...] | list[int]) -> bool:
    boxes = [
        one.boxes[k] for one, k in zip(labels, chosen, strict=True) if k != LEFT_OUT
    ]  # fmt: skip
    if not boxes:
        return True
    met = overlaps(np.array(boxes), np.array(boxes))
    return not met[~np.eye(len(boxes), dtype=bool)].any()


@settings(max_examples=60)
@given(st.lists(corners, min_size=1, max_size=4))
def test_no_two_labels_overlap_and_the_choice_is_about_the_best(
    places: list[list[tuple[int, int]]],
) -> None:
    labels = [_label(one) for one in places]
    chosen = least_cost_places(labels, np.zeros((0, 4)))
    assert _apart(labels, chosen)
    every = product(*(range(-1, len(one.costs)) for one in labels))
    best = min(cost_of(labels, one) for one in every if _apart(labels, one))
    assert best <= cost_of(labels, chosen) <= best + 50.0  # one label more is left out, at most


def test_a_label_makes_room_for_another_one() -> None:
    first, second = _label([(0, 0), (20, 0)]), _label([(1, 0)])
    assert least_cost_places([first, second], np.zeros((0, 4))) == [1, 0]


def test_labels_keep_off_what_is_written_already() -> None:
    taken = np.array([[0.0, 0.0, 3.0, 3.0]])
    assert least_cost_places([_label([(1, 1), (8, 1)])], taken) == [1]
    assert least_cost_places([_label([(1, 1)])], taken) == [LEFT_OUT]


def test_no_leader_runs_through_another_label() -> None:
    across = np.linspace((1.0, 11.0), (21.0, 11.0), 20)
    far = LabelPlaces(
        np.array([[21.0, 10, 25, 12], [0, 20, 4, 22]]), np.array([1.0, 9.0]),
        np.stack((across, np.full((20, 2), np.nan))), 50.0,
    )  # fmt: skip
    assert least_cost_places([_label([(9, 10)]), far], np.zeros((0, 4))) == [0, 1]


def test_the_same_labels_get_the_same_places() -> None:
    labels = [_label([(k % 5, k % 3), (2 * k, 0), (k, 5)]) for k in range(9)]
    chosen = least_cost_places(labels, np.zeros((0, 4)))
    assert least_cost_places(labels, np.zeros((0, 4))) == chosen
