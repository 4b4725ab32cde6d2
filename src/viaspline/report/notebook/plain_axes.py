"""Values on anybody's matplotlib axes: with the layers of the reports, and nothing else touched."""

from __future__ import annotations

from collections.abc import Iterable

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Rectangle

from viaspline.errors import GeometryError
from viaspline.presentable.upper_doors import opened_for
from viaspline.report.canvas import any_name
from viaspline.report.sheet import Box, Sheet

NOWHERE = float("nan")


@any_name()
def plot(value: object, ax: Axes | None = None) -> Axes:
    """Draw a value.

    Args:
        value: A plan, a run, a mission, a curve and so on.
        ax: Where to. On empty axes the view is chosen, at equal scales; on others it grows. Without
            any a new figure of pyplot is made; with some, pyplot isn't touched.

    Returns:
        The axes. ``ax.legend()`` names all that was drawn.

    Raises:
        GeometryError: When ``ax`` is no axes of matplotlib.
    """
    axes = axes_from(ax)
    name_in_legend(axes, opened_for("marks", value)(value, axes))
    return axes


def axes_from(ax: Axes | None) -> Axes:
    """The axes that were handed in, or new ones of pyplot.

    Raises:
        GeometryError: They are something else.
    """
    if ax is None:
        from matplotlib import pyplot

        return pyplot.subplots()[1]
    if not isinstance(ax, Axes):
        problem = f"ax is of the class {type(ax).__name__}, not Axes"
        raise GeometryError(f"{problem}; give one of matplotlib's, such as pyplot.gca()")
    return ax


def map_on(axes: Axes, view: Box) -> Sheet:
    """Axes as the map of a sheet: at equal scales, in metres, wide enough for a view.

    Args:
        axes: What they show already stays in view.
        view: x_min, y_min, x_max, y_max [m].
    """
    x0, y0, x1, y1 = view
    if axes.has_data():
        (a0, a1), (b0, b1) = axes.get_xlim(), axes.get_ylim()
        x0, x1 = min(x0, a0, a1), max(x1, a0, a1)
        y0, y1 = min(y0, b0, b1), max(y1, b0, b1)
    axes.set_xlim(x0, x1)
    axes.set_ylim(y0, y1)
    axes.set_aspect("equal")
    axes.apply_aspect()  # for what is as large on the page as it has to be
    name_axes(axes, "x, east [m]", "y, north [m]")
    across = float(axes.get_window_extent().width) / (x1 - x0)
    return Sheet(axes.figure, axes, (), (0.0, 0.0, 0.0, 0.0), across)  # type: ignore[arg-type]


def name_axes(axes: Axes, x: str, y: str) -> None:
    """Say what axes measure, unless they say something already."""
    if not axes.get_xlabel():
        axes.set_xlabel(x)
    if not axes.get_ylabel():
        axes.set_ylabel(y)


def name_in_legend(axes: Axes, handles: Iterable[Artist]) -> None:
    """Have ``axes.legend()`` name what a legend of ours would: no more and no less."""
    wanted = list(handles)
    kept = {id(one) for one in wanted}
    labels = {str(one.get_label()) for one in wanted}
    drawn = {id(one) for one in axes.get_children()}
    for artist in axes.get_children():
        if id(artist) not in kept and str(artist.get_label()) in labels:
            artist.set_label("_" + str(artist.get_label()))
    for one in wanted:
        if id(one) in drawn:
            continue
        if isinstance(one, Rectangle):
            one.set_xy((NOWHERE, NOWHERE))
        elif isinstance(one, Patch):
            one = _as_square(one)
        elif isinstance(one, Line2D):
            one.set_data([NOWHERE], [NOWHERE])
        axes.add_artist(one)
    if axes.name != "3d" and axes.get_aspect() == "auto" and axes.images:
        axes.set_aspect("equal")  # a picture among the layers has loosened it


def _as_square(patch: Patch) -> Rectangle:
    """A square with the looks of a patch that has no shape of its own."""
    square = Rectangle((NOWHERE, NOWHERE), 1, 1)
    square.update_from(patch)
    square.set_label(str(patch.get_label()))
    return square
