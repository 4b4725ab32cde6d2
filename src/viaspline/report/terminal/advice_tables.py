"""What is advised about tension, in tables for the terminal.

Tested through ``test_advice``.
"""

from __future__ import annotations

import numpy as np
from rich import box
from rich.console import Group, RenderableType
from rich.table import Table

from viaspline.advice import TensionAdvice
from viaspline.compared_tensions import TensionTrial
from viaspline.report.advice_words import advice_words, tension_words
from viaspline.report.units import curvature, down, metres, seconds
from viaspline.span_tensions import SpanTensions

MAX_SPANS = 12  # in the table, before the rest is only counted


def advice_tables(advice: TensionAdvice, name: str) -> RenderableType:
    """What every tension comes to, what to take, and what the spans allow."""
    parts: list[RenderableType] = [_trials(advice, name)]
    if advice.effects is not None and advice.matters:
        parts.append(_spans(advice, advice.effects))
    return Group(*parts, advice_words(advice))


def _trials(advice: TensionAdvice, name: str) -> Table:
    table = Table(title=f"Tension · {name}", title_justify="left", box=box.SIMPLE_HEAD)
    for column in ("tension", "drive", "peak curvature", "length", "clearance", ""):
        table.add_column(column, justify="right" if column else "left")
    others = [trial for trial in advice.trials if np.isnan(trial.level)]
    for trial in (*advice.common, *others):
        table.add_row(tension_words(trial.tension), *_figures(trial), _note(advice, trial))
    return table


def _figures(trial: TensionTrial) -> tuple[str, str, str, str]:
    if trial.plan is None:
        return "–", "–", "–", "–"
    (time, peak), plan = trial.cost, trial.plan
    clearance = plan.certificate.clearance
    gap = down(clearance) if np.isfinite(clearance) else "–"
    return seconds(time), curvature(peak), metres(plan.path.length, 1), gap


def _note(advice: TensionAdvice, trial: TensionTrial) -> str:
    if trial.error is not None:
        reason = getattr(trial.error, "reason", str(trial.error))
        return f"no plan: {reason}"
    notes = [
        words
        for words, holds in (
            ("suggested", trial is advice.chosen and advice.matters),
            ("stands in the mission", trial is advice.stands),
            ("drives roughly", not trial.drives_well),
        )
        if holds
    ]
    return ", ".join(notes)


def _spans(advice: TensionAdvice, effects: SpanTensions) -> Table:
    """What the spline's spans allow and cost."""
    table = Table(
        title="Span by span, the spline itself", title_justify="left", box=box.SIMPLE_HEAD
    )
    for column in ("span", "suggested", "peak curvature", "can be driven with", "costs at most"):
        table.add_column(column, justify="left" if column == "span" else "right")
    taken = effects.nearest(np.nan_to_num(advice.by_span))
    lost = effects.lost(taken)
    for k, names in enumerate(advice.spans[:MAX_SPANS]):
        fits = effects.allowed[k]
        tension = advice.by_span[k]
        table.add_row(
            " → ".join(names),
            "–" if np.isnan(tension) else f"{tension:g}",
            curvature(float(effects.curvatures[k, taken[k]])),
            _ranges(effects, k),
            f"{float(lost[k][fits].max()):.2g} s" if fits.any() else "–",
        )
    if len(advice.spans) > MAX_SPANS:
        table.add_row(f"… and {len(advice.spans) - MAX_SPANS} more spans")
    return table


def _ranges(effects: SpanTensions, span: int) -> str:
    """The tensions with which a span keeps clear and is round enough."""
    fits = effects.allowed[span]
    if not fits.any():
        return "none: lines and turns"
    edges = np.flatnonzero(np.diff(np.concatenate(([False], fits, [False])).astype(np.int8)))
    ends = [effects.tensions[[first, last - 1]].tolist() for first, last in edges.reshape(-1, 2)]
    return ", ".join(f"{low:g}" if low == high else f"{low:g} to {high:g}" for low, high in ends)
