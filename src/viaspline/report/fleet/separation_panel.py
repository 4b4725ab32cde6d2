"""How far apart the nearest two robots are over time, beside what is proven of that.

Tested through ``report/fleet/test_fleet_picture``.
"""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.report import style
from viaspline.report.fleet.fleet_motion import NearestTwo
from viaspline.report.fleet.fleet_page import name_panel
from viaspline.report.units import down

TOP_SHARE = 4.0  # of what is asked: farther apart is more than anybody wants to see


def draw_separation(
    axes: Axes, near: NearestTwo, certificate: FleetCertificate, colour: str = style.PATH
) -> None:
    """Draw it.

    Args:
        axes: Empty ones.
        near: How far apart the nearest two are.
        certificate: What is proven.
        colour: Of the line.
    """
    name_panel(axes, "Free space between the nearest two [m], over time [s]")
    required = certificate.required
    seen = near.gaps[np.isfinite(near.gaps)]
    top = max(TOP_SHARE * required, 1.6 * float(seen.min(initial=1.0)), 0.1)
    top = min(top, 1.15 * max(float(seen.max(initial=1.0)), 1.3 * required))
    axes.set_ylim(min(0.0, float(seen.min(initial=0.0))), top)
    axes.plot(near.times, near.gaps, color=colour, linewidth=1.1)
    axes.fill_between(near.times, near.gaps, top, color=colour, alpha=0.08, linewidth=0)
    axes.axhline(required, color=style.TIGHTEST, linewidth=1.0, linestyle=(0, (4, 2)))
    begin, end = axes.get_xlim()
    axes.annotate(
        f"{required:g} m asked", (end, required), (-3, -2), textcoords="offset points",
        size=style.SMALL_PT, color=style.TIGHTEST, ha="right", va="top",
    )  # fmt: skip
    if certificate.pair is None or not math.isfinite(certificate.separation):
        return
    at = min(max(certificate.at_s, begin), end)
    axes.plot(
        at, certificate.separation, marker="o", markersize=7, markerfacecolor="none",
        markeredgecolor=style.TIGHTEST, markeredgewidth=1.5, linestyle="none", zorder=5,
    )  # fmt: skip
    first, second = (style.short(name, 16) for name in certificate.pair)
    early = at < 0.55 * begin + 0.45 * end
    axes.annotate(
        f"proven: {down(certificate.separation)} or more,\n{first} and {second} at {at:.1f} s",
        (at, certificate.separation), (10 if early else -10, 10), textcoords="offset points",
        size=style.SMALL_PT, color=style.TIGHTEST, ha="left" if early else "right", va="bottom",
        parse_math=False, bbox={"boxstyle": "square,pad=0.15", "facecolor": "white",
                                "edgecolor": "none", "alpha": 0.85},
    )  # fmt: skip
