from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.animation import PillowWriter
from matplotlib.figure import Figure
from PIL import Image

import viaspline as vs
from viaspline.report.notebook.moving_axes import moments

TANK = {"name": "tank", "circle": {"center": [50, 52], "radius": 10}}
UNSEEN = {"circle": {"center": [65, 60], "radius": 2}}
CART = {"circle": {"center": [0, 0], "radius": 1},
        "motion": {"from": [60, 95], "velocity_mps": [0, -1]}}  # fmt: skip


def driven(sensor: Any, *more: Any) -> vs.Run:
    return vs.simulate(
        vs.Mission.model_validate(
            {
                "world": {"known": [TANK, *more], "unseen": [UNSEEN]},
                "robot": {"sensor": sensor},
                "route": {"start": [10, 50], "via": [[70, 60]], "goal": [90, 20]},
            }
        )
    )


TOWER = {"circle": {"center": [25, 0.5], "radius": 4}, "height_m": [0, 30]}
FLIGHT = vs.Mission.model_validate(
    {"world": {"known": [TOWER]}, "route": {"start": [0, 0, 10], "goal": [50, 0, 15]}}
)
FLEET = vs.Fleet.model_validate(
    {
        "fleet": [
            {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
            {"name": "b", "route": {"start": [20, -20], "goal": [20, 20]}, "rest": "leave"},
        ]
    }
)
CROWD = vs.Fleet.model_validate(
    {
        "fleet": [
            {"name": f"r{i}", "route": {"start": [0, 5 * i], "goal": [9, 5 * i]}} for i in range(23)
        ]
    }
)
RUNS: dict[str, Callable[[], Any]] = {
    "run": lambda: driven({"range_m": 20}),
    "run with a lidar": lambda: driven({"lidar": {"range_m": 20, "beams": 90}}),
    "run among what moves": lambda: driven({"range_m": 20}, CART),
    "flight": lambda: vs.fly(FLIGHT),
    "fleet plan": lambda: vs.plan_fleet(FLEET),
    "fleet run": lambda: vs.simulate_fleet(FLEET),
    "crowd": lambda: vs.simulate_fleet(CROWD),
}


@cache
def made(name: str) -> Any:
    """One of the runs, which is made when it is first asked for."""
    return RUNS[name]()


def lasts(run: Any) -> float:
    if isinstance(run, vs.FleetPlan):
        return max(one.trajectory.end_time for one in run.plans.values())
    return run.end_s if isinstance(run, vs.FleetRun) else run.duration  # type: ignore[no-any-return]


@pytest.mark.parametrize("name", RUNS)
def test_a_run_is_filmed_on_plain_axes(name: str, tmp_path: Path) -> None:
    run = made(name)
    axes = Figure(figsize=(4, 3)).add_subplot()
    film = run.animate(axes, pace=lasts(run), fps=5)
    file = tmp_path / "run.gif"
    film.save(file, writer=PillowWriter(fps=5))
    with Image.open(file) as frames:
        assert frames.n_frames == 6  # type: ignore[attr-defined]
        frames.seek(0)
        first = np.asarray(frames.convert("RGB"))
        frames.seek(5)
        assert (np.asarray(frames.convert("RGB")) != first).any()
    assert f"{lasts(run):.1f} s" in axes.get_title(loc="right")
    assert axes.get_legend_handles_labels()[0]


@pytest.mark.parametrize(
    "numbers", [(0, 5), (-1, 5), (1, 0), (float("nan"), 5), (1e-6, 5), (1, 1e9)]
)
def test_a_film_that_nobody_could_watch_is_refused(numbers: tuple[float, float]) -> None:
    axes = Figure().add_subplot()
    for run in map(made, RUNS):
        with pytest.raises(vs.GeometryError):
            run.animate(axes, pace=numbers[0], fps=numbers[1])


def test_what_is_no_axes_is_refused() -> None:
    for run in map(made, RUNS):
        with pytest.raises(vs.GeometryError, match="not Axes"):
            run.animate(5)


def test_moments_reach_from_the_beginning_to_the_end() -> None:
    times = moments(np.array([3.0, 4.0, 10.0]), pace=2.0, fps=3.0)
    assert times[0] == 3.0
    assert times[-1] == 10.0
    assert np.diff(times).max() <= 2.0 / 3.0 + 1e-9
