"""Figures 6, 7 and 8: missions planned, and one driven, by the package itself.

Tested through ``report/test_figures``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from viaspline.curve.path import PathVia
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.planning.problem.requirements import Requirements
from viaspline.report import style
from viaspline.report.canvas import png, polyline
from viaspline.report.figures.missions import OBSTACLES, PATROL, SURVEY
from viaspline.report.labels import Labels
from viaspline.report.path_marks import draw_arrows, draw_path
from viaspline.report.plan_picture import draw_losers, losing, proof
from viaspline.report.scene import Scene
from viaspline.report.sheet import Sheet, new_sheet, view_of
from viaspline.report.side_column import SideColumn
from viaspline.report.units import metres, seconds
from viaspline.report.via_marks import draw_vias
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate


def fig6() -> bytes:
    """The zigzag survey."""
    planned = plan(Mission.model_validate(SURVEY))
    lines = (
        "The path is the spline through the via points from (50, 250) to (350, 250); slack 0.5.",
        f"{metres(planned.path.length, 1)}, {seconds(planned.trajectory.duration)}; "
        f"{proof(planned.certificate)}.",
    )
    return _picture(planned, "Fig. 6  A zigzag survey", lines)


def fig7() -> bytes:
    """A group of obstacles, both ways past it."""
    planned = plan(Mission.model_validate(OBSTACLES))
    entry = next(entry for entry in planned.ledger if entry.chosen is not None)
    lengths = [
        f"by the {c.side} {metres(c.length, 1)}" for c in entry.candidates if c.length is not None
    ]
    lines = (
        "Obstacles that stand together count as one. The spline is laid past either side of the "
        "group, and the shorter way is taken.",
        f"The way {' and '.join(lengths)}; {proof(planned.certificate)}.",
    )
    return _picture(planned, "Fig. 7  A group of obstacles is passed by the shorter side", lines)


def fig8() -> bytes:
    """Via points and obstacles together, driven."""
    run = simulate(Mission.model_validate(PATROL))
    planned = run.plan
    lines = (
        "Via points, stations, obstacles on the map and obstacles that only the sensor finds "
        "(hatched).",
        f"Planned {metres(planned.path.length, 1)} (dashed), driven {metres(run.path.length, 1)} "
        f"in {seconds(run.duration)} with {len(run.replans)} new paths under way; "
        f"{proof(run.certificate)}.",
    )
    return _picture(planned, "Fig. 8  Via points and obstacles together", lines, run)


def _picture(planned: Plan, title: str, lines: Sequence[str], run: Run | None = None) -> bytes:
    mission = planned.mission
    unseen = mission.world.unseen_standing if run is not None else ()
    scene = Scene.of(planned.world, Requirements.of(mission).required, unseen)
    points = polyline(np.asarray(planned.path.spans))
    losers = losing(planned) if run is None else []
    view = view_of(np.vstack([points, *losers]), scene.corners, scene.box, scene.required)
    sheet = new_sheet(view, (), title, lines)
    labels = Labels(sheet.map)
    handles = scene.draw(sheet.map, sheet.pixels_per_metre)
    scene.name(labels)
    if run is None:
        handles += draw_losers(sheet, labels, planned)
        handles.append(draw_path(sheet.map, points))
        lines_drawn, vias = [points, *losers], planned.path.vias
    else:
        lines_drawn, vias = _draw_both(sheet, run, points)
        handles += [line for line in sheet.map.lines if not str(line.get_label()).startswith("_")]
    more, places = draw_vias(sheet.map, labels, vias, mission)
    draw_arrows(sheet.map, lines_drawn[0], style.PATH, avoid=places)
    labels.place(np.vstack(lines_drawn), places)
    SideColumn(sheet).legend([*handles, *more])
    return png(sheet.figure)


def _draw_both(sheet: Sheet, run: Run, planned: Floats) -> tuple[list[Floats], tuple[PathVia, ...]]:
    sheet.map.plot(
        *planned.T, color=style.OLD_PATH, linewidth=1.2, linestyle=(0, (6, 2)), zorder=7,
        label="path planned before", scalex=False, scaley=False,
    )  # fmt: skip
    driven = run.positions[:, :2]
    draw_path(sheet.map, driven, label="driven path")
    return [driven, planned], run.path.vias
