"""The curvature of paths that two checkouts laid, side by side.

    python benchmarks/driven_pictures.py OLD NEW OUT.png NAME...

OLD and NEW hold a folder for each NAME, as ``viaspline plan NAME.yaml --out OLD/NAME`` writes it.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np


def curvature(folder: Path) -> tuple[np.ndarray, np.ndarray, str]:
    """Distances [m], curvature there [1/m], and what the path takes."""
    table = np.genfromtxt(folder / "path.csv", delimiter=",", names=True)
    plan = json.loads((folder / "plan.json").read_text())
    detours = sum(via["kind"] == "detour" for via in plan["path"]["vias"])
    words = f"{plan['path']['length_m']:.1f} m in {plan['trajectory']['duration_s']:.1f} s"
    words += f", {detours} detour via points"
    return table["distance_m"], table["curvature_1pm"], words


def main(old: str, new: str, out: str, *names: str) -> None:
    figure, axes = plt.subplots(len(names), 2, figsize=(11, 2.6 * len(names)), squeeze=False)
    for row, name in zip(axes, names, strict=True):
        found = [curvature(Path(folder) / name) for folder in (old, new)]
        most = max(float(np.abs(values).max()) for _, values, _ in found)
        for axis, (along, values, words), when in zip(row, found, ("before", "now"), strict=True):
            axis.plot(along, values, linewidth=0.8)
            axis.axhline(0.0, linewidth=0.5, color="0.6")
            axis.set_ylim(-1.05 * most, 1.05 * most)
            axis.set_title(f"{name}, {when}: {words}", fontsize=9, loc="left")
            axis.set_xlabel("distance along the path [m]", fontsize=8)
            axis.set_ylabel("curvature [1/m]", fontsize=8)
            axis.tick_params(labelsize=8)
    figure.tight_layout()
    figure.savefig(out, dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
