"""What changes along the path: speed, curvature and height over distance, below the map.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.report.style import INK, MUTED, OBSTACLE, SMALL_PT, TEXT_PT, TIGHTEST
from viaspline.report.units import metres

TICK_SPACING_PX = 3.0
LIMIT_WORDS_PX = 95.0  # at the right end of the strip, for the words at the turning circle
Ticks = Sequence[tuple[float, str]]  # distance [m] and the number of a via point


def strip_names(points: Floats) -> list[str]:
    """The strips that a path needs: the height only when there is one that changes."""
    heights = ["height [m]"] if points.shape[1] == 3 and np.ptp(points[:, 2]) > 1e-6 else []
    return ["speed [m/s]", "curvature [1/m]", *heights]


def fill_strips(
    strips: Sequence[Axes], distances: Floats, values: Sequence[Floats], ticks: Ticks, colour: str
) -> None:
    """Draw one value in every strip.

    Args:
        strips: From ``new_sheet``.
        distances: Along the path [m], not decreasing, shape (n,).
        values: One array of shape (n,) for each strip: speed, signed curvature, and more.
        ticks: Via points: how far along the path, and their number.
        colour: The colour of the lines.
    """
    last = max(float(distances[-1]), 1e-9)
    for i, (axes, value) in enumerate(zip(strips, values, strict=True)):
        axes.plot(distances, value, color=colour, linewidth=1.1)
        axes.set_xlim(0, last)
        axes.margins(y=0.1)
        for distance, _ in _apart(ticks, axes, last):
            axes.axvline(distance, color=OBSTACLE, linewidth=0.5, zorder=0)
        if i == 0:
            top = max(float(np.nanmax(value)), 1e-9) if value.size else 1.0
            axes.set_ylim(0, 1.15 * top)
            axes.fill_between(distances, value, color=colour, alpha=0.12, linewidth=0)
        elif i == 1:
            axes.axhline(0, color=MUTED, linewidth=0.5)
            low, high = shown_range(value)
            pad = 0.15 * (high - low) if high - low > 1e-8 else 0.01  # or it is straight
            axes.set_ylim(low - pad, high + pad)
        elif value.size and float(np.nanmin(value)) < 0.0:
            axes.axhline(0, color=MUTED, linewidth=0.5)
    strips[-1].set_xlabel("distance along the path [m]", size=TEXT_PT, color=MUTED, labelpad=2)
    _number(strips[0], ticks, last)


def with_peaks(values: Floats, most: int) -> NDArray[np.intp]:
    """Which of many values are drawn: those evenly apart, and the least and largest between these.

    Args:
        values: Along the path, shape (n,).
        most: About how many are drawn.

    Returns:
        Their indices, increasing; all of them if they are no more than ``most``.

    >>> values = np.zeros(1000)
    >>> values[501] = 7.0
    >>> kept = with_peaks(values, 30)
    >>> len(kept) <= 30, float(values[kept].max())
    (True, 7.0)
    """
    if len(values) <= most:
        return np.arange(len(values))
    starts = np.linspace(0, len(values), most // 3, endpoint=False).round().astype(np.intp)
    pieces = np.split(values, starts[1:])
    least, largest = ([int(find(piece)) for piece in pieces] for find in (np.argmin, np.argmax))
    return np.unique(np.concatenate([starts, starts + least, starts + largest, [len(values) - 1]]))


def _apart(ticks: Ticks, axes: Axes, last: float) -> Ticks:
    """Those ticks that can be told from the ones before them."""
    least, free = TICK_SPACING_PX * last / axes.get_window_extent().width, -np.inf
    kept = []
    for distance, text in ticks:
        if distance >= free:
            kept.append((distance, text))
            free = distance + least
    return kept


def draw_curvature_limit(axes: Axes, radius: float | None) -> None:
    """The curvature of a robot's turning circle, to either side, as far as the strip shows it."""
    if radius is None:
        return
    low, high = axes.get_ylim()
    shown = [bound for bound in (1.0 / radius, -1.0 / radius) if 1.4 * low < bound < 1.4 * high]
    for bound in shown:
        axes.axhline(bound, color=TIGHTEST, linewidth=0.8, linestyle=(0, (4, 2)))
        axes.set_ylim(min(axes.get_ylim()[0], 1.1 * bound), max(axes.get_ylim()[1], 1.1 * bound))
    for bound in shown[:1]:
        axes.annotate(
            "turning circle", (1.0, bound), xycoords=axes.get_yaxis_transform(),
            xytext=(-3, -2 if bound > 0.0 else 2), textcoords="offset points", color=TIGHTEST,
            size=SMALL_PT - 1, ha="right", va="top" if bound > 0.0 else "bottom",
        )  # fmt: skip


def mark_clipped(axes: Axes, distances: Floats, curvature: Floats, sharpest: float) -> None:
    """Say of peaks of the curvature that they go on beyond the strip, and how far the largest does.

    Args:
        axes: The strip, with its final limits.
        distances: Along the path [m], shape (n,).
        curvature: Signed [1/m], shape (n,).
        sharpest: The largest of the whole path, without its sign [1/m].
    """
    low, high = axes.get_ylim()
    peaks = [(i, 1) for i in _peaks(curvature, high)]
    peaks += [(i, -1) for i in _peaks(-curvature, -low)]
    if not peaks:
        return
    across = axes.get_window_extent().width
    for i, side in peaks:
        axes.plot(
            distances[i], 0.93 if side > 0 else 0.07, transform=axes.get_xaxis_transform(),
            marker="^" if side > 0 else "v", markersize=5, color=TIGHTEST, linestyle="none",
            zorder=5, scalex=False, scaley=False,
        )  # fmt: skip
    i, side = max(peaks, key=lambda one: abs(curvature[one[0]]))
    pixels = distances[i] / max(float(distances[-1]), 1e-9) * across
    is_late = pixels > 0.5 * across
    off = min(pixels - 6.0, across - LIMIT_WORDS_PX) if is_late else pixels + 6.0
    axes.annotate(
        _beyond_words(sharpest), (0.0, 1.0 if side > 0 else 0.0),
        xycoords="axes fraction", xytext=(off * 72.0 / axes.figure.dpi, -3 * side),
        textcoords="offset points", color=TIGHTEST, size=SMALL_PT - 1,
        ha="right" if is_late else "left", va="top" if side > 0 else "bottom",
    )  # fmt: skip


def _beyond_words(sharpest: float) -> str:
    if not np.isfinite(sharpest):
        return "beyond: turns back on the spot"
    return f"beyond: {sharpest:.3g} 1/m, {radius_words(1.0 / sharpest)}"


def _peaks(values: Floats, most: float) -> list[int]:
    """The highest place of each stretch that is higher than the strip."""
    beyond = np.flatnonzero(values > most)
    if not beyond.size:
        return []
    stretches = np.split(beyond, np.flatnonzero(np.diff(beyond) > 1) + 1)
    return [int(one[np.argmax(values[one])]) for one in stretches]


def radius_words(radius: float) -> str:
    """A radius [m] in two or three digits behind the point.

    Example:
        >>> radius_words(1.1234), radius_words(0.0106), radius_words(1e-7)
        ('radius 1.12 m', 'radius 0.011 m', 'radius below 1 mm')
    """
    if radius < 1e-3:
        return "radius below 1 mm"
    return f"radius {metres(radius, 2 if radius > 0.1 else 3)}"


def shown_range(value: Floats) -> tuple[float, float]:
    """From where to where a strip shows a value; a few peaks don't flatten all the rest."""
    low, high = min(0.0, float(np.nanmin(value))), max(0.0, float(np.nanmax(value)))
    usual = float(np.nanpercentile(np.abs(value), 98))
    most = 6.0 * usual if usual > 0 else np.inf
    return (max(low, -most), min(high, most)) if max(high, -low) > 3 * most else (low, high)


def _number(axes: Axes, ticks: Ticks, last: float) -> None:
    """Numbers of the via points above the first strip, as far as they fit."""
    free = -np.inf
    per_metre = axes.get_window_extent().width / last
    for distance, text in ticks:
        pixels = distance * per_metre
        width = 9.0 * len(text)
        if pixels - width / 2 < free:
            continue
        free = pixels + width / 2 + 4
        axes.annotate(
            text, (distance, 1), xycoords=("data", "axes fraction"), xytext=(0, 2),
            textcoords="offset points", size=SMALL_PT - 1, color=INK, ha="center", va="bottom",
        )  # fmt: skip
