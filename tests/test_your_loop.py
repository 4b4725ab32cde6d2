"""The loops that the documentation shows: they run, and they are what it shows."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from viaspline.robot.navigator import Navigator

ROOT = Path(__file__).resolve().parents[1]


def example(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, ROOT / "examples" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def nearest(track: np.ndarray, posts: np.ndarray) -> float:
    """The least room between the robot's middle and round posts, by their centres [m]."""
    gaps = [np.hypot(*(track - post[:2]).T).min() - post[2] for post in posts]
    return float(min(gaps))


def test_the_page_shows_the_example_as_it_is() -> None:
    page = (ROOT / "docs" / "your-loop.md").read_text()
    assert (ROOT / "examples" / "loop_by_hand.py").read_text() in page


def test_the_loop_by_hand_reaches_its_goal_and_keeps_its_clearance(
    capsys: pytest.CaptureFixture[str],
) -> None:
    loop = example("loop_by_hand")
    nav, track = loop.drive(Navigator(loop.mission))
    assert nav.reached, nav.reason
    assert nearest(np.array(track), loop.POSTS) >= 0.3 + 0.3 - 0.01
    assert "sets off" in capsys.readouterr().out


def test_the_loop_in_mujoco_reaches_its_goal_and_keeps_its_clearance() -> None:
    pytest.importorskip("mujoco", reason="needs the extra sim")
    loop = example("loop_in_mujoco")
    nav, track = loop.drive(Navigator(loop.MISSION))
    assert nav.reached, nav.reason
    assert nearest(track, np.array(loop.POSTS)) >= 0.3 + 0.25 - 0.01
