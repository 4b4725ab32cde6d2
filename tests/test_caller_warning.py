"""Warnings name the line of whoever called."""

from pathlib import Path

import pytest

import viaspline as vs

LOOP = {"keyframes": [[0, 1, 2], [4, 5, 2]], "after": "loop"}
JUMPING = {
    "world": {"known": [{"circle": {"center": [0, 0], "radius": 1}, "motion": LOOP}]},
    "route": {"start": [-5, -5], "goal": [-9, -9]},
}


@pytest.mark.parametrize("built", [vs.Mission.model_validate, lambda data: vs.Mission(**data)])
def test_a_mission_that_is_built_warns_at_the_line_that_built_it(built) -> None:
    with pytest.warns(vs.MissionWarning, match="jumps by 4 m") as told:
        built(JUMPING)
    assert told[0].filename == __file__


def test_a_mission_that_is_loaded_warns_at_the_line_that_loaded_it(tmp_path: Path) -> None:
    file = tmp_path / "loop.yaml"
    file.write_text(
        "world: {known: [{circle: {center: [0, 0], radius: 1}, motion: "
        "{keyframes: [[0, 1, 2], [4, 5, 2]], after: loop}}]}\n"
        "route: {start: [-5, -5], goal: [-9, -9]}\n"
    )
    with pytest.warns(vs.MissionWarning, match="jumps by 4 m") as told:
        vs.load(file)
    assert told[0].filename == __file__
