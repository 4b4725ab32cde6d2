"""Courses and laws as a file of arrays."""

import io

import numpy as np
import pytest

import viaspline as vs
from viaspline.fleet.saved.course_record import CourseRecord

PLAN = vs.plan_fleet(
    vs.Fleet.model_validate(
        {
            "fleet": [
                {"name": "a", "route": {"start": [0, 0], "goal": [9, 0]}},
                {"name": "é b/3", "route": {"start": [4, -5], "goal": [4, 5]}, "rest": "leave"},
            ]
        }
    )
)
CONTENT = CourseRecord.of(PLAN).to_bytes()


def changed(**columns: np.ndarray | None) -> bytes:
    with np.load(io.BytesIO(CONTENT)) as file:
        found = {name: file[name] for name in file.files}
    for name, value in columns.items():
        found[name.replace("__", ".")] = value
    file = io.BytesIO()
    np.savez(file, **{name: value for name, value in found.items() if value is not None})
    return file.getvalue()


def test_what_is_read_is_what_was_written_to_the_bit_and_the_bytes_are_the_same() -> None:
    again = CourseRecord.from_bytes(CONTENT)
    assert again.courses == PLAN.courses
    assert again.laws == PLAN.laws
    assert again.rides == PLAN.rides
    assert again.to_bytes() == CONTENT


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "can't be read"),
        (b"{}", "can't be read"),
        (CONTENT[:200], "can't be read"),
        (changed(names=None), "courses.first isn't"),
        (changed(names=np.zeros(2)), "names no robots"),
        (changed(courses__first=np.array([0, 1, 5])), "no two nodes"),
        (changed(courses__first=np.array([0.0, 5.0, 9.0])), "courses.first isn't"),
        (changed(laws__arrive=None), "has no laws.arrive"),
        (changed(laws__arrive=np.zeros(3)), "has no laws.arrive"),
        (changed(laws__is_timed=np.zeros(2)), "has no laws.is_timed"),
        (changed(laws__speed=PLAN.laws.packed.speed * np.nan), "else than numbers"),
        (changed(courses__place=np.zeros(PLAN.courses.packed.place.shape[0])), "than numbers"),
        (changed(bodies=np.zeros((2, 3))), "another shape"),
        (changed(durations=np.array([None, None])), "can't be read|has no durations|allow_pickle"),
    ],
)  # fmt: skip
def test_what_is_no_record_is_told(content: bytes, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        CourseRecord.from_bytes(content)
