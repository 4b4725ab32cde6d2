"""Courses and laws as a file of arrays."""

import io
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

import viaspline as vs
from viaspline.fleet.saved.course_record import CourseRecord

FLEET = vs.Fleet.model_validate(
    {
        "fleet": [
            {"name": "a", "route": {"start": [0, 0], "goal": [9, 0]}},
            {"name": "é b/3", "route": {"start": [4, -5], "goal": [4, 5]}, "rest": "leave"},
        ]
    }
)


@cache
def planned() -> vs.FleetPlan:
    return vs.plan_fleet(FLEET)


@cache
def content() -> bytes:
    return CourseRecord.of(planned()).to_bytes()


def changed(**columns: np.ndarray | None) -> bytes:
    with np.load(io.BytesIO(content())) as file:
        found = {name: file[name] for name in file.files}
    for name, value in columns.items():
        found[name.replace("__", ".")] = value
    file = io.BytesIO()
    np.savez(file, **{name: value for name, value in found.items() if value is not None})
    return file.getvalue()


def test_what_is_read_is_what_was_written_to_the_bit_and_the_bytes_are_the_same() -> None:
    again = CourseRecord.from_bytes(content())
    assert again.courses == planned().courses
    assert again.laws == planned().laws
    assert again.rides == planned().rides
    assert again.to_bytes() == content()


@pytest.mark.parametrize(
    ("spoiled", "words"),
    [
        (lambda: b"", "can't be read"),
        (lambda: b"{}", "can't be read"),
        (lambda: content()[:200], "can't be read"),
        (lambda: changed(names=None), "courses.first isn't"),
        (lambda: changed(names=np.zeros(2)), "names no robots"),
        (lambda: changed(courses__first=np.array([0, 1, 5])), "no two nodes"),
        (lambda: changed(courses__first=np.array([0.0, 5.0, 9.0])), "courses.first isn't"),
        (lambda: changed(laws__arrive=None), "has no laws.arrive"),
        (lambda: changed(laws__arrive=np.zeros(3)), "has no laws.arrive"),
        (lambda: changed(laws__is_timed=np.zeros(2)), "has no laws.is_timed"),
        (lambda: changed(laws__speed=planned().laws.packed.speed * np.nan), "else than numbers"),
        (lambda: changed(courses__place=np.zeros(planned().courses.packed.first[-1])), "numbers"),
        (lambda: changed(bodies=np.zeros((2, 3))), "another shape"),
        (lambda: changed(durations=np.array([None] * 2)), "be read|has no durations|allow_pickle"),
    ],
)  # fmt: skip
def test_what_is_no_record_is_told(spoiled: Callable[[], bytes], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        CourseRecord.from_bytes(spoiled())
