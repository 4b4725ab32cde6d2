"""Whole runs with odd values for every key of the schema: only answers, never a defect.

``benchmarks/odd_runs.py`` runs thousands.
"""

import importlib.util
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from viaspline.cli import cli

GENERATOR = Path(__file__).parents[1] / "benchmarks" / "odd_missions.py"
ANSWERS = (0, 2, 3, 4, 5)
"""Done, wrong, no path, not reached, gave up."""


@pytest.fixture(scope="module")
def odd_missions() -> Any:
    spec = importlib.util.spec_from_file_location("odd_missions", GENERATOR)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    "seed", [*range(6), *(pytest.param(k, marks=pytest.mark.slow) for k in range(6, 12))]
)
def test_a_run_with_odd_values_ends_with_an_answer(
    odd_missions: Any, tmp_path: Path, seed: int
) -> None:
    mission = odd_missions.OddMissions(np.random.default_rng(seed)).draw()
    file = tmp_path / "odd.yaml"
    file.write_text(json.dumps(mission), encoding="utf-8")
    done = CliRunner().invoke(cli, ["run", str(file), "--out", str(tmp_path / "out"), "-q"])
    assert done.exit_code in ANSWERS, done.output
    assert ("reached" in done.output) == (done.exit_code == 4)
    assert (tmp_path / "out" / "run.json").exists() == (done.exit_code in (0, 4))


def test_the_mission_that_is_made_odd_is_sound(odd_missions: Any, tmp_path: Path) -> None:
    file = tmp_path / "sound.yaml"
    file.write_text(json.dumps(odd_missions.BASE), encoding="utf-8")
    done = CliRunner().invoke(cli, ["run", str(file), "--out", str(tmp_path / "out"), "-q"])
    assert done.exit_code == 0, done.output
