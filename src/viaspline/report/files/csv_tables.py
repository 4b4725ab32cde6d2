"""``path.csv`` and ``run.csv``."""

from __future__ import annotations

from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from viaspline.planner import Plan
from viaspline.presentable.named_columns import Table
from viaspline.report.units import nice
from viaspline.robot.run import Run

LENGTH_DECIMALS = 6
DECIMALS = MappingProxyType({"heading_rad": 9, "curvature_1pm": 9, "agl_m": 3})
CsvColumn = tuple[str, NDArray[np.float64], int]  # header, values, decimals


def spacing(length: float) -> float:
    """How far apart the points of ``path.csv`` are [m], by the path's length [m].

    A 1, 2 or 5 times a power of ten: 0.1 m up to 200 m, 1 m from 1 km on; finer for a path of a
    few metres and coarser beyond 50 km, so that a file has 50 to 50,000 lines.

    Example:
        >>> spacing(3.0), spacing(80.0), spacing(640.0), spacing(7000.0), spacing(2e6)
        (0.05, 0.1, 0.5, 1.0, 50.0)
    """
    usual = min(max(length / 2000, 0.1), 1.0)
    if length > 50_000:
        usual = length / 50_000
    if length < 5:
        usual = max(length, 1e-9) / 100
    return nice(usual)


def path_csv(plan: Plan) -> str:
    """Points of the planned path, equally far apart; the last one is the path's end."""
    return table_csv(plan.samples(spacing(plan.path.length)))


def run_csv(run: Run) -> str:
    """What was driven, over time."""
    return table_csv(run.samples())


def table_csv(table: Table) -> str:
    """A table as comma-separated text, each column with the decimals that suit its unit."""
    assert table.dtype.names is not None
    names = table.dtype.names
    return csv_text([(name, table[name], DECIMALS.get(name, LENGTH_DECIMALS)) for name in names])


def csv_text(columns: list[CsvColumn]) -> str:
    """Comma-separated text; a cell that is not finite is empty."""
    cells = []
    for _, values, decimals in columns:
        rounded = np.round(values, decimals) + 0.0
        cells.append([f"{x:.{decimals}f}" if np.isfinite(x) else "" for x in rounded.tolist()])
    lines = [",".join(name for name, _, _ in columns)]
    lines.extend(",".join(row) for row in zip(*cells, strict=True))
    return "\n".join(lines) + "\n"
