from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from viaspline.commands.figures_command import FIGURE_NAMES
from viaspline.formats.load import load
from viaspline.mission.model import Mission
from viaspline.report.figures import FIGURES
from viaspline.report.figures.missions import OBSTACLES, PATROL, SURVEY

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_the_command_line_promises_the_figures_that_there_are() -> None:
    assert tuple(FIGURES) == FIGURE_NAMES


@pytest.mark.parametrize("name", FIGURE_NAMES)
def test_a_figure_is_a_picture_and_the_same_twice(name: str) -> None:
    _, draw = FIGURES[name]
    picture = draw()
    pixels = np.asarray(Image.open(io.BytesIO(picture)).convert("L"))
    assert min(pixels.shape) > 400
    assert 0.01 < float((pixels < 200).mean()) < 0.5
    assert draw() == picture


@pytest.mark.parametrize(
    ("figure", "example"),
    [(SURVEY, "fig6-survey"), (OBSTACLES, "fig7-obstacles"), (PATROL, "fig8-patrol")],
)
def test_a_figure_and_its_example_are_the_same_mission(
    figure: dict[str, object], example: str
) -> None:
    assert Mission.model_validate(figure) == load(EXAMPLES / f"{example}.yaml")
