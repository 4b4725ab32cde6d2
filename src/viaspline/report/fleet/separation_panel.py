"""How far apart the nearest two robots are over time, beside what is proven of that.

Tested through ``report/fleet/test_fleet_picture``.
"""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.report import style
from viaspline.report.fleet.fleet_page import name_panel
from viaspline.report.fleet.places_over_time import NearestTwo
from viaspline.report.units import down

TOP_SHARE = 4.0  # of what is asked: farther apart is more than anybody wants to see


def draw_separation(axes: Axes, near: NearestTwo, certificate: FleetCertificate) -> None:
    """Draw it.

    Args:
        axes: Empty ones, from whose left to whose right it goes [s].
        near: How far apart the nearest two are.
        certificate: What is proven.
    """
    name_panel(axes, "Free space between the nearest two [m]")
    axes.set_xlabel("time [s]", labelpad=2)
    required = certificate.required
    seen = near.gaps[np.isfinite(near.gaps)]
    least = float(seen.min()) if seen.size else 0.0
    top = max(TOP_SHARE * required, 1.6 * least, 0.1)
    top = min(top, 1.15 * max(float(seen.max(initial=0.0)), 1.3 * required, 0.1))
    axes.set_ylim(min(0.0, least), top)
    axes.plot(near.times, near.gaps, color=style.PATH, linewidth=1.1)
    axes.fill_between(near.times, near.gaps, top, color=style.PATH, alpha=0.08, linewidth=0)
    axes.axhline(required, color=style.TIGHTEST, linewidth=1.0, linestyle=(0, (4, 2)))
    begin, end = axes.get_xlim()
    axes.annotate(
        f"{required:g} m asked", (end, required), (-3, -2), textcoords="offset points",
        size=style.SMALL_PT, color=style.TIGHTEST, ha="right", va="top",
    )  # fmt: skip
    if certificate.pair is None or not math.isfinite(certificate.separation):
        return
    axes.plot(
        min(max(certificate.at_s, begin), end), certificate.separation, marker="o", markersize=7,
        markerfacecolor="none", markeredgecolor=style.TIGHTEST, markeredgewidth=1.5,
        linestyle="none", zorder=5, clip_on=False,
    )  # fmt: skip
    first, second = (style.short(name, 14) for name in certificate.pair)
    proven = f"{down(certificate.separation)} proven: {first}, {second} at {certificate.at_s:.1f} s"
    axes.set_title(
        proven, size=style.SMALL_PT, color=style.TIGHTEST, loc="right", pad=5, parse_math=False
    )
