from __future__ import annotations

import io

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

from viaspline.report.canvas import new_figure, png
from viaspline.report.labels import Labels


def _axes() -> Axes:
    axes = new_figure(6, 6).add_axes((0.1, 0.1, 0.8, 0.8))
    axes.set_xlim(0, 10)
    axes.set_ylim(0, 10)
    return axes


def _boxes(axes: Axes) -> list[np.ndarray]:
    canvas = axes.figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    renderer = canvas.get_renderer()
    return [text.get_window_extent(renderer).extents for text in axes.texts]


places = st.tuples(st.floats(0, 10), st.floats(0, 10))


@settings(deadline=None, max_examples=25)
@given(st.lists(places, min_size=2, max_size=12))
def test_labels_overlap_neither_each_other_nor_the_edge(at: list[tuple[float, float]]) -> None:
    axes = _axes()
    labels = Labels(axes)
    for i, place in enumerate(at):
        labels.add(f"label {i}", place)
    labels.place(np.zeros((0, 2)), np.array(at))
    boxes = _boxes(axes)
    frame = axes.get_window_extent().extents
    for i, box in enumerate(boxes):
        assert (box[:2] >= frame[:2]).all()
        assert (box[2:] <= frame[2:]).all()
        for other in boxes[:i]:
            assert (box[:2] >= other[2:]).any() or (box[2:] <= other[:2]).any()


def test_a_label_keeps_off_the_path() -> None:
    axes = _axes()
    labels = Labels(axes)
    labels.add("pump", (5, 5))
    path = np.column_stack([np.linspace(0, 10, 400)] * 2)
    labels.place(path, np.array([[5.0, 5.0]]))
    (box,) = _boxes(axes)
    on_screen = axes.transData.transform(path)
    assert not ((on_screen > box[:2]) & (on_screen < box[2:])).all(axis=1).any()


def test_all_letters_of_a_label_are_drawn_within_the_map() -> None:
    figure = new_figure(4, 2, 100)
    axes = figure.add_axes((0.1, 0.1, 0.8, 0.8))
    axes.set(xlim=(0, 10), ylim=(0, 10), xticks=[], yticks=[])
    labels = Labels(axes)
    labels.add("new path, 454 s (reflex)", (9.8, 5.0), colour="#ff0000")
    lines = np.array([(x, y) for x in np.linspace(0, 5.8, 90) for y in np.linspace(0, 10, 90)])
    labels.place(lines, np.array([[9.8, 5.0]]))

    def columns() -> np.ndarray:
        seen = np.asarray(Image.open(io.BytesIO(png(figure))).convert("RGB")).astype(int)
        return np.flatnonzero((seen[..., 0] - seen[..., 1:].max(axis=2) > 60).any(axis=0))

    within = columns()
    for text in axes.texts:
        text.set_clip_on(False)
    assert within.size > 50
    assert np.array_equal(within, columns())


def test_a_label_goes_on_a_thing_that_is_large_enough() -> None:
    axes = _axes()
    labels = Labels(axes)
    labels.add("lake", (5, 5), inside=6.0)
    labels.place(np.zeros((0, 2)), np.zeros((0, 2)))
    assert axes.texts[0].get_position() == (5, 5)
