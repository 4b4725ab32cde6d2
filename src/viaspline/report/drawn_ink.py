"""What is drawn on axes already, as an image of contrasts: text is best read where there are none.

Tested through ``report/test_labels``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.image import AxesImage
from matplotlib.spines import Spine
from matplotlib.text import Text

from viaspline.kernels.arrays import Floats

GREYS = np.array([0.3, 0.59, 0.11])  # of red, green and blue
STEP_PX = 2  # of the pixels that are looked at


def contrasts(axes: Axes) -> tuple[Floats, Floats]:
    """How much the brightness changes from pixel to pixel on axes, texts and edges left out.

    Args:
        axes: With fixed limits, linear in both ways.

    Returns:
        Changes at every other pixel, the lowest row first, shape (rows, columns), and the place
        of its lower left corner on the figure [pixels], shape (2,).
    """
    figure = axes.get_figure(root=True)
    assert figure is not None
    frame = axes.get_window_extent()
    left, bottom = int(frame.x0), int(frame.y0)
    across, up = int(np.ceil(frame.x1)) - left, int(np.ceil(frame.y1)) - bottom
    width, height = (int(np.ceil(size)) for size in figure.bbox.size)
    renderer = RendererAgg(width, height, figure.dpi)  # type: ignore[no-untyped-call]
    for artist in sorted(axes.get_children(), key=lambda one: one.get_zorder()):
        if _is_ink(axes, artist):
            artist.draw(renderer)
    pixels = np.asarray(renderer.buffer_rgba())[::-1]  # type: ignore[no-untyped-call]
    seen = pixels[bottom : bottom + up, left : left + across][::STEP_PX, ::STEP_PX] / 255.0
    whole = _changes(_grey(seen))
    for image in axes.images:
        whole += _changes(_grey(_sampled(image, axes, across, up)))
    return STEP_PX * whole, np.array([left, bottom], float)


def _is_ink(axes: Axes, artist: Artist) -> bool:
    if artist is axes.patch or not artist.get_visible() or artist.get_animated():
        return False
    return not isinstance(artist, Text | Axis | Spine | AxesImage)


def _grey(colours: Floats) -> Floats:
    """Brightness on white paper of red, green, blue and opacity from 0 to 1."""
    opaque = colours[..., 3]
    # a renderer's colours aren't multiplied with their opacity
    grey: Floats = 1.0 - opaque * (1.0 - colours[..., :3] @ GREYS)
    return grey


def _changes(grey: Floats) -> Floats:
    changes = np.zeros_like(grey)
    changes[:, 1:] += np.abs(np.diff(grey, axis=1))
    changes[1:] += np.abs(np.diff(grey, axis=0))
    return changes


def _sampled(image: AxesImage, axes: Axes, across: int, up: int) -> Floats:
    """The colours of an image at every other pixel of axes, clear where it isn't."""
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    x = x0 + (np.arange(0, across, STEP_PX) + 0.5) / across * (x1 - x0)
    y = y0 + (np.arange(0, up, STEP_PX) + 0.5) / up * (y1 - y0)
    left, right, bottom, top = image.get_extent()
    data = image.get_array()
    assert data is not None
    rows, columns = data.shape[:2]
    column = np.floor((x - left) / (right - left) * columns).astype(int)
    row = np.floor((y - bottom) / (top - bottom) * rows).astype(int)
    inside = ((row >= 0) & (row < rows))[:, None] & ((column >= 0) & (column < columns))
    picked = data[np.clip(row, 0, rows - 1)][:, np.clip(column, 0, columns - 1)]
    colours: Floats = np.asarray(image.to_rgba(picked), float)
    colours[~inside] = 0.0
    return colours
