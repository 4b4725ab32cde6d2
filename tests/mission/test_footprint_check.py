"""A footprint has to be a body about its reference point."""

from typing import Any

import pytest

from viaspline.errors import MissionError
from viaspline.mission.footprint_check import footprint_fault
from viaspline.mission.model import Mission


def mission(footprint: Any) -> Mission:
    return Mission.model_validate(
        {"robot": {"footprint": footprint}, "route": {"start": [0, 0], "goal": [9, 9]}}
    )


def test_a_sound_footprint_is_taken() -> None:
    assert mission([(-1, -1), (3, -1), (3, 1), (-1, 1)]).robot.footprint is not None


@pytest.mark.parametrize(
    ("footprint", "problem", "remedy"),
    [
        ([(1, -1), (3, -1), (3, 1), (1, 1)], "which lies 1 m outside", "[[-1, -1], [1, -1]"),
        ([(0, -1), (2, -1), (2, 1), (0, 1)], "which lies on its edge", "shift it so that"),
        ([(-1, -1), (1, 1), (1, -1), (-1, 1)], "crosses itself at (0, 0)", "in order"),
        ([(-1, 0), (0, 0), (1, 0)], "has no area", "move a corner"),
    ],
)
def test_what_is_no_body_is_a_flaw_that_names_the_remedy(
    footprint: list[tuple[float, float]], problem: str, remedy: str
) -> None:
    fault = footprint_fault(footprint)
    assert fault is not None
    assert fault.path == ("robot", "footprint")
    assert problem in fault.problem
    assert remedy in fault.remedy
    with pytest.raises((MissionError, ValueError), match=r"robot\.footprint"):
        mission(footprint)


def test_the_remedy_is_a_body() -> None:
    ring = [(1, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1)]  # its centre may lie outside of it
    fault = footprint_fault(ring)
    assert fault is not None
    shifted = fault.remedy.split("e.g. ")[1]
    corners = [tuple(map(float, pair.split(", "))) for pair in shifted.strip("[]").split("], [")]
    assert footprint_fault(corners) is None  # type: ignore[arg-type]


def test_a_mission_with_a_body_is_read_again_as_it_was_dumped() -> None:
    asked = Mission.model_validate(
        {
            "robot": {"footprint": [[-1, -1], [2, -1], [2, 1], [-1, 1]]},
            "route": {"start": [0, 0], "goal": [9, 0]},
        }
    )
    assert Mission.model_validate(asked.model_dump()) == asked
    assert Mission.model_validate_json(asked.model_dump_json()) == asked
