from __future__ import annotations

import numpy as np
from matplotlib.lines import Line2D

from viaspline.curve.path import PathVia
from viaspline.mission.model import Mission
from viaspline.report import style
from viaspline.report.canvas import new_figure
from viaspline.report.labels import Labels
from viaspline.report.path_marks import mark_sharpest
from viaspline.report.via_marks import draw_vias, via_marks


def _via(x: float, index: int, dwell: float = 0.0) -> PathVia:
    return PathVia(f"via {index}", (x, 0.0), "user", 0.0, dwell, index)


def test_via_points_at_one_place_have_one_mark_with_all_numbers() -> None:
    users = [_via(0, 0), _via(5, 1), _via(9, 2), _via(5, 3), _via(0, 4)]
    pixels = np.array([[100.0 * via.at[0], 0.0] for via in users])
    marks = via_marks(users, False, pixels)
    assert [(mark.kind, mark.text) for mark in marks] == [
        ("start and goal", "S,G"), ("via point", "1,3"), ("via point", "2"),
    ]  # fmt: skip
    assert marks[0].fill == style.START


def test_a_number_that_has_no_room_on_its_mark_stands_beside_it() -> None:
    route = {"start": [0, 0], "via": [[x, 0] for x in (4, 4.1, 7, 8.5, 7, 8.5, 7)],
             "goal": [10, 0]}  # fmt: skip
    mission = Mission.model_validate({"route": route})
    axes = new_figure(8, 8, style.DPI).add_axes((0, 0, 1, 1))
    axes.set_xlim(-1, 11)
    axes.set_ylim(-6, 6)
    labels = Labels(axes)
    places = [0.0, 4.0, 4.1, 7.0, 8.5, 7.0, 8.5, 7.0, 10.0]
    draw_vias(axes, labels, [_via(x, k) for k, x in enumerate(places)], mission)
    assert [text.get_text() for text in axes.texts] == ["S", "1", "4,6", "G"]
    labels.place(np.zeros((0, 2)), np.zeros((0, 2)))
    beside = {text.get_text(): text for text in axes.texts[4:]}
    assert set(beside) == {"2", "3, 5, 7"}
    assert abs(beside["3, 5, 7"].get_position()[0] - 7.0) < 1.0


def test_a_station_is_a_square() -> None:
    marks = via_marks([_via(0, 0), _via(5, 1, dwell=3.0), _via(9, 2)], False, np.eye(3)[:, :2] * 99)
    assert [mark.kind for mark in marks] == ["start", "station", "goal"]


def test_what_is_marked_at_a_via_point_leaves_its_number_seen() -> None:
    mission = Mission.model_validate({"route": {"start": [0, 0], "via": [[5, 0]], "goal": [9, 0]}})
    axes = new_figure(8, 8, style.DPI).add_axes((0, 0, 1, 1))
    axes.set_xlim(-1, 11)
    axes.set_ylim(-6, 6)
    labels = Labels(axes)
    draw_vias(axes, labels, [_via(x, k) for k, x in enumerate((0.0, 5.0, 9.0))], mission)
    marks = list(axes.lines)
    (around,) = mark_sharpest(axes, labels, (5.1, 0.0), 0.4)
    assert isinstance(around, Line2D)
    assert all(around.get_zorder() < mark.get_zorder() for mark in marks)
    assert around.get_markersize() > max(mark.get_markersize() for mark in marks)
