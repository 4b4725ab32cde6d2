import io
import subprocess
import sys
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from PIL import Image

import viaspline as vs
from viaspline.kernels.kernel_cache import CACHE_FOLDER

TANK = {"name": "tank", "circle": {"center": [50, 52], "radius": 10}}
MISSION = vs.Mission.model_validate(
    {
        "world": {
            "bounds": [0, 0, 100, 100],
            "known": [TANK],
            "unseen": [{"circle": {"center": [65, 60], "radius": 2}}],
            "speed_zones": [{"polygon": [[80, 20], [99, 20], [90, 40]], "max_speed_mps": 1}],
        },
        "robot": {"sensor": {"range_m": 20}},
        "route": {"start": [10, 50], "via": [{"at": [70, 60], "dwell_s": 5}], "goal": [90, 20]},
    }
)
TOWER = {"circle": {"center": [25, 0.5], "radius": 4}, "height_m": [0, 30]}
FLIGHT = vs.Mission.model_validate(
    {
        "world": {"known": [TOWER], "ground": {"flat_m": 0}, "bounds": [-9, -20, 60, 20]},
        "route": {"start": [0, 0, 10], "goal": [50, 0, 15]},
    }
)
PAIR = vs.Fleet.model_validate(
    {
        "fleet": [
            {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
            {"name": "b", "route": {"start": [20, -20], "goal": [20, 20]}},
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
CART = vs.Obstacle(
    circle={"center": (0, 0), "radius": 1}, motion={"from": (60, 95), "velocity_mps": (0, -1)}
)
AMONG = MISSION.model_copy(
    update={"world": MISSION.world.model_copy(update={"known": (CART,), "unseen": ()})}
)
CELLS = np.random.default_rng(1).random((30, 50)) < 0.2


@cache
def planned() -> vs.Plan:
    return vs.plan(MISSION)


@cache
def flown() -> Any:
    return vs.plan(FLIGHT)


@cache
def fleet_plan() -> vs.FleetPlan:
    return vs.plan_fleet(PAIR)


@cache
def crowd_plan() -> vs.FleetPlan:
    return vs.plan_fleet(CROWD)


SHOWN: dict[str, Callable[[], Any]] = {
    "mission": lambda: MISSION,
    "mission among what moves": lambda: AMONG,
    "mission in space": lambda: FLIGHT,
    "plan": planned,
    "plan among what moves": lambda: vs.plan(AMONG),
    "plan in space": flown,
    "run": lambda: vs.simulate(MISSION, plan=planned()),
    "flight": lambda: vs.fly(flown()),
    "fleet": lambda: PAIR,
    "fleet plan": fleet_plan,
    "fleet run": lambda: vs.simulate_fleet(PAIR, plan=fleet_plan()),
    "crowd": lambda: CROWD,
    "plan of a crowd": crowd_plan,
    "run of a crowd": lambda: vs.simulate_fleet(CROWD, plan=crowd_plan()),
    "path": lambda: planned().path,
    "path in space": lambda: flown().path,
    "spline": lambda: vs.CardinalSpline([(0, 0), (3, 2), (5, -1), (8, 0)]),
    "spline of one coordinate": lambda: vs.CardinalSpline([(0,), (3,), (1,)]),
    "law": lambda: planned().trajectory,
    "world": lambda: planned().world,
    "world with nothing in it": lambda: vs.World(),
    "grid": lambda: vs.Grid(CELLS, 0.2, (1, 2, 0.2)),
    "grid with nothing in it": lambda: vs.Grid(np.zeros((2, 2), bool), 1.0),
}


@cache
def shown(name: str) -> Any:
    return SHOWN[name]()


def labels_of(axes: Axes) -> list[str]:
    return [str(one.get_label()) for one in axes.get_legend_handles_labels()[0]]


def has_ink(data: bytes) -> bool:
    pixels = np.asarray(Image.open(io.BytesIO(data)).convert("L"))
    return bool((pixels < 200).mean() > 0.002)


@pytest.mark.parametrize("name", SHOWN)
def test_a_value_is_drawn_on_plain_axes_and_its_legend_names_all_of_it_once(name: str) -> None:
    axes = Figure(figsize=(6, 5)).add_subplot()
    assert shown(name).plot(axes) is axes
    assert axes.get_xlabel()
    assert axes.get_ylabel()
    named = labels_of(axes)
    assert len(named) == len(set(named))
    assert not any(label.startswith("_") for label in named)
    if "nothing" not in name:
        assert named
        axes.legend()
    buffer = io.BytesIO()
    axes.get_figure(root=True).savefig(buffer, format="png")  # type: ignore[union-attr]
    assert has_ink(buffer.getvalue())


@cache
def picture_of(name: str) -> bytes:
    data: bytes = shown(name)._repr_png_()
    return data


@pytest.mark.parametrize("name", SHOWN)
def test_there_is_something_on_the_picture_of_a_notebook(name: str) -> None:
    assert picture_of(name)[:8] == b"\x89PNG\r\n\x1a\n"
    assert has_ink(picture_of(name))


SOON_DRAWN = ("run", "plan in space", "plan of a crowd", "spline", "grid")
"""Of each kind of drawing one."""


@pytest.mark.parametrize(
    "name",
    [name if name in SOON_DRAWN else pytest.param(name, marks=pytest.mark.slow) for name in SHOWN],
)
def test_the_picture_of_a_notebook_is_the_same_every_time(name: str) -> None:
    assert shown(name)._repr_png_() == picture_of(name)


@pytest.mark.parametrize("name", ["mission", "plan", "run", "plan in space", "fleet plan", "grid"])
def test_a_map_is_at_equal_scales_and_shows_the_whole_value(name: str) -> None:
    axes = Figure(figsize=(9, 4)).add_subplot()
    shown(name).plot(axes)
    axes.get_figure(root=True).draw_without_rendering()  # type: ignore[union-attr]
    ends = axes.transData.transform([(0, 0), (1, 0), (0, 1)])
    assert ends[1, 0] - ends[0, 0] == pytest.approx(ends[2, 1] - ends[0, 1])
    if hasattr(shown(name), "path"):
        points = shown(name).path.sample(1.0)[2]
        (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
        assert x0 <= points[:, 0].min()
        assert points[:, 0].max() <= x1
        assert y0 <= points[:, 1].min()
        assert points[:, 1].max() <= y1


def test_what_axes_show_already_stays_in_view() -> None:
    axes = Figure().add_subplot()
    vs.CardinalSpline([(500, 500), (600, 500)]).plot(axes)
    planned().plot(axes)
    assert axes.get_xlim()[0] <= 10
    assert axes.get_xlim()[1] >= 600
    assert axes.get_ylim()[1] >= 500


def test_any_canvas_and_a_part_of_a_figure_will_do() -> None:
    figure = Figure()
    FigureCanvasSVG(figure)
    planned().plot(figure.add_subplot())
    left, right = Figure().subfigures(1, 2)
    shown("run").plot(left.add_subplot())
    fleet_plan().plot(right.add_subplot())
    assert labels_of(left.axes[0])


def test_axes_in_three_dimensions_show_flights_in_perspective() -> None:
    for value in (flown(), shown("flight"), flown().path):
        axes = Figure().add_subplot(projection="3d")
        value.plot(axes)
        assert "path" in labels_of(axes) or "curve" in labels_of(axes)
        assert axes.get_zlim()[0] <= 10  # type: ignore[attr-defined]
        assert axes.get_zlim()[1] >= 15  # type: ignore[attr-defined]


@pytest.mark.parametrize("junk", [5, "ax", [], Figure()])
def test_what_is_no_axes_is_refused(junk: Any) -> None:
    for name in SHOWN:
        with pytest.raises(vs.GeometryError, match="not Axes"):
            shown(name).plot(junk)


def test_pyplot_is_touched_only_without_axes(tmp_path: Path) -> None:
    code = (
        "import sys, viaspline as vs\n"
        "from matplotlib.figure import Figure\n"
        "spline = vs.CardinalSpline([(0, 0), (3, 2)])\n"
        "spline.plot(Figure().add_subplot()), spline._repr_png_(), spline._repr_html_()\n"
        "assert 'matplotlib.pyplot' not in sys.modules\n"
        "axes = spline.plot()\n"
        "from matplotlib import pyplot\n"
        "assert pyplot.gca() is axes\n"
    )
    environment = {"MPLBACKEND": "agg", "MPLCONFIGDIR": str(tmp_path), "PATH": ""}
    if CACHE_FOLDER is not None:  # it would compile the kernels of curves again
        environment["VIASPLINE_CACHE_DIR"] = str(CACHE_FOLDER.parent)
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env=environment
    )
    assert done.returncode == 0, done.stderr
