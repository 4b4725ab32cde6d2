from __future__ import annotations

import io
import math
from dataclasses import replace
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
import shapely
from matplotlib.collections import LineCollection
from numpy.typing import NDArray
from PIL import Image

from viaspline.maps.grid import Grid
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.planning.alternatives.kept_account import KeptAccount
from viaspline.report import style
from viaspline.report.canvas import new_figure, renderer_of
from viaspline.report.driven_line import DrivenKey, draw_driven, sharpest_driven, speed_colours
from viaspline.report.labels import Labels
from viaspline.report.plan_picture import draw_losers, plan_picture, plan_scene, via_ticks
from viaspline.report.profile_strips import mark_clipped, shown_range, with_peaks
from viaspline.report.run_picture import echoes, run_picture
from viaspline.report.sheet import new_sheet
from viaspline.robot.run import Run


def pixels(picture: bytes) -> NDArray[np.uint8]:
    return np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"))


def share_of(colour: str, picture: bytes) -> float:
    """How much of a picture has about this colour."""
    shown = pixels(picture)
    near = np.ones(shown.shape[:2], bool)
    for k, i in enumerate((1, 3, 5)):  # plane by plane: a fifth of the time that all at once take
        near &= np.abs(shown[:, :, k].astype(np.int16) - int(colour[i : i + 2], 16)) < 12
    return float(near.mean())


def test_the_plan_is_on_its_picture(planned: Plan) -> None:
    picture = plan_picture(planned, "yard")
    height, width, _ = pixels(picture).shape
    assert 900 < width < 2500
    assert 600 < height < 2500
    for colour in (style.PATH, style.OBSTACLE, style.LOSER, style.STATION, style.DETOUR):
        assert share_of(colour, picture) > 1e-5, colour


def test_the_run_is_on_its_picture(driven: Run) -> None:
    picture = run_picture(driven, "yard")
    for colour in (style.UNSEEN, style.UNSEEN_FILL, style.OBSTACLE, style.OLD_PATH):
        assert share_of(colour, picture) > 1e-5, colour


def test_the_same_plan_and_run_give_the_same_bytes(planned: Plan, driven: Run) -> None:
    assert plan_picture(planned, "yard") == plan_picture(planned, "yard")
    assert run_picture(driven, "yard") == run_picture(driven, "yard")


def test_there_is_neither_a_date_nor_a_version_in_a_picture(planned: Plan) -> None:
    assert set(Image.open(io.BytesIO(plan_picture(planned, "yard"))).info) <= {"dpi"}


def test_pictures_change_no_global_setting(planned: Plan) -> None:
    before = dict(mpl.rcParams)
    plan_picture(planned, "yard")
    assert dict(mpl.rcParams) == before


def test_a_long_body_is_on_the_picture_as_a_whole() -> None:
    mission = Mission.model_validate(
        {
            "robot": {"footprint": [[-4, -0.5], [4, -0.5], [4, 0.5], [-4, 0.5]]},
            "route": {"start": [0, 0], "goal": [3, 0]},
        }
    )
    _, (x_min, _, x_max, _) = plan_scene(plan(mission))
    assert x_min < -4
    assert x_max > 7


def test_a_way_that_loses_against_several_groups_has_its_label_once(planned: Plan) -> None:
    _, view = plan_scene(planned)
    counts = []
    for times in (1, 3):
        kept = KeptAccount(planned.ledger * times)
        sheet = new_sheet(view, (), "plan", ())
        labels = Labels(sheet.map)
        draw_losers(sheet, labels, replace(planned, account=kept))
        counts.append(len(labels._labels))
    assert counts[0] == counts[1] > 0


def test_a_closed_route_ends_where_it_starts() -> None:
    route = {"start": [0, 0], "via": [[50, 0], [50, 40]], "closed": True}
    mission = Mission.model_validate({"route": route})
    path = plan(mission).path
    assert [text for _, text in via_ticks(path, mission)] == ["S", "1", "2", "S"]
    assert via_ticks(path, mission)[-1][0] == pytest.approx(path.length)


def _mission(points: list[Any], **world: Any) -> Mission:
    route = {"start": points[0], "via": points[1:-1], "goal": points[-1]}
    return Mission.model_validate({"world": world, "route": route})


def _wave(across: float, up: float, count: int = 20) -> list[list[float]]:
    return [
        [across * i / count, up * math.sin(3 * i), *([0.0] if not up else [])][:2]
        for i in range(count)
    ]


SCENES = {
    "five metres": _mission([[0, 0], [2, 1], [5, 0]], bounds=[-2, -2, 7, 3]),
    "five kilometres": _mission(
        [[0, 0], [2000, 900], [5000, 0]],
        known=[{"name": "lake", "circle": {"center": [3000, 300], "radius": 200}}],
    ),
    "nothing in it": _mission([[0, 0], [10, 0]]),
    "very wide": _mission(_wave(5000, 3)),
    "very tall": _mission([[y, x] for x, y in _wave(5000, 3)]),
    "a million metres away": _mission([[1e6, 2e6], [1e6 + 30, 2e6 + 9], [1e6 + 60, 2e6]]),
    "with heights": _mission([[0, 0, 5], [30, 20, 12], [60, 0, 9]]),
    "via points on a heap": _mission([[0, 0], *([30 + 1e-3 * i, 0] for i in range(9)), [60, 9]]),
    "names that no font has": _mission(
        [[0, 0], {"at": [30, 9], "name": "ポンプ $x_1$ \\frac [red]\n" * 4}, [60, 0]]
    ),
    "a fence": _mission([[0, 0], [30, 5]], fences=[[[-9, -9], [60, -9], [40, 30], [-9, 20]]]),
}


@pytest.mark.parametrize("scene", SCENES)
def test_a_scene_of_any_kind_gives_a_picture(scene: str) -> None:
    picture = plan_picture(plan(SCENES[scene]), scene)
    height, width, _ = pixels(picture).shape
    assert 0.3 < width / height < 4
    assert share_of(style.PATH, picture) > 1e-4


def test_thousands_of_obstacles_are_drawn() -> None:
    rng = np.random.default_rng(2)
    centres = rng.uniform(0, 500, (4000, 2))
    far = np.abs(centres[:, 1] - 250) > 20
    known = [{"circle": {"center": list(c), "radius": 1.0}} for c in centres[far].tolist()]
    planned = plan(_mission([[10, 250], [490, 250]], bounds=[0, 0, 500, 500], known=known))
    assert share_of(style.OBSTACLE, plan_picture(planned, "many")) > 5e-3


def _hall(yaw: float = 0.0, resolution: float = 0.25, size: int = 80) -> Grid:
    """A square room with a wall across and unknown ground in two corners."""
    blocked = np.zeros((size, size), bool)
    blocked[[0, -1]] = blocked[:, [0, -1]] = True
    blocked[: size * 5 // 8, size // 2 : size // 2 + max(size // 40, 1)] = True
    unknown = np.zeros_like(blocked)
    unknown[-size // 6 :, : size // 6] = unknown[-size // 6 :, -size // 6 :] = True
    return Grid(blocked | unknown, resolution, (3.0, -2.0, yaw), "hall.yaml", unknown)


def _across(grid: Grid, *more: dict[str, Any]) -> Mission:
    size = grid.width
    start, goal = grid.to_world([(0.2 * size, 0.2 * size), (0.8 * size, 0.2 * size)]).tolist()
    return Mission.model_validate(
        {
            "world": {"known": [{"grid": grid}, *more]},
            "robot": {"radius_m": 0.3, "clearance_m": 0.1},
            "route": {"start": start, "goal": goal},
        }
    )


@pytest.mark.parametrize("yaw", [0.0, 0.5])
def test_a_map_is_on_the_picture_of_a_plan(yaw: float) -> None:
    picture = plan_picture(plan(_across(_hall(yaw))), "hall")
    assert share_of(style.UNKNOWN, picture) > 0.005
    assert share_of(style.OBSTACLE_EDGE, picture) > 4e-4
    assert share_of(style.PATH, picture) > 1e-3


def test_several_maps_differ_in_colour() -> None:
    mask = np.zeros((80, 80), bool)
    mask[50:60, 10:30] = True
    mission = _across(_hall(), {"grid": Grid(mask, 0.25, (3.0, -2.0, 0.0)), "name": "keep out"})
    assert share_of(style.OBSTACLES[1][0], plan_picture(plan(mission), "hall")) > 0.002


def test_what_a_lidar_has_shown_is_on_the_picture_and_the_rest_stays_faint(scanned: Run) -> None:
    assert scanned.reached
    points = echoes(scanned)
    assert len(points) > 50
    assert np.abs(scanned.world.distance(points)).max() < 1e-6
    picture = run_picture(scanned, "posts")
    assert share_of(style.UNSEEN, picture) > 1e-3
    assert share_of(style.FAINT_FILL, picture) > 1e-3
    assert share_of(style.UNSEEN_FILL, picture) < share_of(style.FAINT_FILL, picture)


def test_a_run_without_a_lidar_has_shown_no_points(driven: Run) -> None:
    assert echoes(driven).shape == (0, 2)


def test_a_peak_does_not_flatten_the_rest_of_a_strip() -> None:
    curvature = np.sin(np.linspace(0, 20, 1000))
    curvature[500] = 1e6
    low, high = shown_range(curvature)
    assert (low, high) == (pytest.approx(-1, abs=0.01), pytest.approx(6, abs=0.1))
    assert shown_range(np.array([0.0, 0.0, 3.0])) == (0.0, 3.0)


def test_a_clipped_peak_is_marked_with_its_radius() -> None:
    axes = new_figure(6, 2).add_axes((0.1, 0.2, 0.8, 0.7))
    distances, curvature = np.linspace(0, 20, 1000), np.sin(np.linspace(0, 20, 1000))
    curvature[500] = -40.0
    axes.plot(distances, curvature)
    axes.set_xlim(0, 20)
    axes.set_ylim(-6, 6)
    mark_clipped(axes, distances, curvature, 50.0)
    (mark,) = [line for line in axes.lines if line.get_marker() == "v"]
    assert float(np.ravel(mark.get_xdata())[0]) == distances[500]
    assert [text.get_text() for text in axes.texts] == ["beyond: 50 1/m, radius 0.020 m"]
    mark_clipped(axes, distances, np.clip(curvature, -1, 1), 1.0)
    assert len(axes.texts) == 1


def test_a_peak_between_the_values_that_are_drawn_is_drawn() -> None:
    curvature = np.sin(np.linspace(0, 20, 10_000))
    curvature[[5001, 7003]] = 40.0, -30.0
    kept = with_peaks(curvature, 900)
    assert len(kept) <= 901
    assert (np.diff(kept) > 0).all()
    assert {0, 5001, 7003, 9999} <= set(kept.tolist())
    assert with_peaks(curvature[:900], 900).tolist() == list(range(900))


def test_the_sharpest_place_of_a_run_is_that_of_its_exact_curve(driven: Run) -> None:
    sharpest = sharpest_driven(driven)
    assert sharpest is not None
    assert sharpest.radius * driven.path.max_curvature()[0] == pytest.approx(1.0)
    assert np.abs(driven.curvatures).max() <= sharpest.curvature * (1 + 1e-6)
    near = np.hypot(*(driven.positions[:, :2] - sharpest.at).T).min()
    assert near < 0.5


def test_the_legend_shows_the_driven_path_in_its_colours(driven: Run) -> None:
    axes = new_figure(6, 4).add_axes((0, 0, 1, 1))
    colours, limits = speed_colours(driven.speeds)
    line = draw_driven(axes, driven.positions, driven.speeds, colours, limits)
    legend = axes.legend(handles=[line], handler_map={LineCollection: DrivenKey()})
    assert [text.get_text() for text in legend.get_texts()] == ["driven path"]
    (shown,) = legend.findobj(LineCollection)
    assert len(np.unique(shown.get_colors(), axis=0)) > 8


def test_an_area_names_itself_where_its_name_fits() -> None:
    axes = new_figure(6, 6).add_axes((0, 0, 1, 1))
    axes.set_xlim(0, 10)
    axes.set_ylim(0, 10)
    labels = Labels(axes)
    area = shapely.box(1, 1, 6, 6)
    labels.add("walkway", (3.5, 3.5), area=area)
    path = np.column_stack((np.linspace(0, 10, 400), np.full(400, 3.5)))
    labels.place(path, np.zeros((0, 2)))
    box = axes.texts[0].get_window_extent(renderer_of(axes.figure))
    corners = axes.transData.inverted().transform(box.get_points())
    assert area.contains(shapely.box(*corners.ravel()))
    assert not corners[0, 1] < 3.5 < corners[1, 1]
