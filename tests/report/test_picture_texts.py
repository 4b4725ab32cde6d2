"""No text of a picture lies over another one or beyond the picture.

``benchmarks/picture_texts.py`` draws a hundred random missions.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from typing import Any

import pytest

from viaspline.planner import Plan
from viaspline.report.plan_picture import plan_picture
from viaspline.report.run_picture import run_picture
from viaspline.robot.run import Run

COUNTER = Path(__file__).parents[2] / "benchmarks" / "picture_texts.py"


@pytest.fixture(scope="module")
def counter() -> Any:
    spec = importlib.util.spec_from_file_location("picture_texts", COUNTER)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # where its dataclasses look for their types
    spec.loader.exec_module(module)
    return module


@pytest.mark.slow
def test_texts_of_random_missions_overlap_nowhere_and_stay_on_their_pictures(counter: Any) -> None:
    for kind, count in counter.counted(2, seed=5).items():
        assert count.pictures == 2
        assert count.texts > 20, kind
        assert (count.over, count.beyond) == (0, 0), kind


def test_texts_of_a_yard_overlap_nowhere(counter: Any, planned: Plan, driven: Run) -> None:
    for draw in (lambda: plan_picture(planned, "yard"), lambda: run_picture(driven, "yard")):
        with counter.drawn_texts() as drawn:
            draw()
        words = {text for text, _, _ in drawn.texts.values()}
        assert {"pump, stops 5 s", "shed", "sharpest place"} <= words
        assert drawn.over() == []
        assert drawn.beyond() == []
    assert "driven path" in words


def test_the_counter_sees_what_lies_over_another_text_or_beyond(counter: Any) -> None:
    from viaspline.report.canvas import new_figure, png

    figure = new_figure(4, 4)
    figure.text(0.5, 0.5, "one")
    figure.text(0.51, 0.5, "other")
    figure.text(0.99, 0.1, "beyond the edge")
    with counter.drawn_texts() as drawn:
        png(figure)
    assert drawn.over() == [("other", "one")]
    assert drawn.beyond() == ["beyond the edge"]
