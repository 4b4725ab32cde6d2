"""``plan.png``: the planned path in its world, what it was chosen from, and its time law.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

import textwrap
from functools import partial

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.machine.drivability import Drivability
from viaspline.mission.model import Mission
from viaspline.planner import Plan
from viaspline.planning.problem.requirements import Requirements
from viaspline.report import style
from viaspline.report.body_marks import draw_swept, draw_zones
from viaspline.report.canvas import any_name, png, polyline
from viaspline.report.close_up import close_up
from viaspline.report.labels import Labels
from viaspline.report.moving_marks import Moment, body_at, draw_moving
from viaspline.report.path_marks import (
    draw_arrows,
    draw_path,
    draw_sharpest,
    draw_tightest,
)
from viaspline.report.profile_strips import (
    draw_curvature_limit,
    fill_strips,
    mark_clipped,
    strip_names,
)
from viaspline.report.scene import Scene
from viaspline.report.sheet import Box, Sheet, new_sheet, view_of
from viaspline.report.side_column import SideColumn
from viaspline.report.space_time_column import plan_space_time
from viaspline.report.summary import body_words, spline_words
from viaspline.report.units import asked_words, down, metres, seconds
from viaspline.report.via_marks import draw_plain_vias, draw_vias
from viaspline.world.moving_obstacles import MovingObstacles

PER_SPAN = 24  # places of a span at which its curvature is drawn
MAX_REASONS = 3  # why a path drives roughly, before the rest is only counted
NOTE_WIDTH = 44  # letters of a line of the column at the right
MAX_GROUPS_MEASURED = 6  # groups; the lengths of their ways are on the picture if they are no more


@any_name()
def plan_picture(plan: Plan, name: str) -> bytes:
    """The picture as PNG.

    Args:
        plan: What was planned.
        name: The mission's name.
    """
    scene, view = plan_scene(plan)
    trajectory = plan.trajectory
    title = (
        f"{style.short(name, 48)}: {metres(plan.path.length, 1)} in {seconds(trajectory.duration)}"
    )
    among = plan.moving_certificate
    moving = None if among is None else among.clearance
    proven = proof(plan.certificate, plan.tracking_error, moving)
    lines = (proven, subtitle(plan.mission))
    sheet = new_sheet(view, strip_names(plan.path.spans[:, 0]), title, lines)
    handles = draw_plan_map(sheet, scene, plan)
    _fill_strips(sheet, plan)
    column = SideColumn(sheet)
    column.legend(handles)
    plan_space_time(column, plan)
    column.notes(*drive_notes(plan.drivability))
    layers = partial(_draw_close, plan=plan)
    close_up(column, scene, plan.path, plan.certificate, plan.mission.robot, layers)
    return png(sheet.figure)


def plan_scene(plan: Plan) -> tuple[Scene, Box]:
    """The world of a plan, and the part of it that pictures show."""
    required = Requirements.of(plan.mission, plan.tracking_error).required
    scene = Scene.of(plan.world, required)
    seen = np.vstack([polyline(plan.path.spans), *losing(plan)])
    margin = max(required, plan.mission.robot.outer_radius)
    return scene, view_of(seen, scene.corners, scene.box, margin)


def draw_plan_map(sheet: Sheet, scene: Scene, plan: Plan) -> list[Artist]:
    """Draw a plan on the map of a sheet.

    Args:
        sheet: Its map shows the part of the world that is to be seen.
        scene: The world.
        plan: What was planned.

    Returns:
        What belongs in a legend.
    """
    points = polyline(plan.path.spans)
    labels = Labels(sheet.map)
    handles = scene.draw(sheet.map, sheet.pixels_per_metre)
    scene.name(labels)
    handles += draw_zones(sheet.map, labels, plan.mission.world.speed_zones)
    handles += draw_swept(sheet.map, plan.path, plan.mission.robot, sheet.pixels_per_metre)
    handles += draw_losers(sheet, labels, plan)
    handles.append(draw_path(sheet.map, points))
    vias, places = draw_vias(sheet.map, labels, plan.path.vias, plan.mission)
    draw_arrows(sheet.map, points, style.PATH, avoid=places)
    handles += vias + draw_tightest(sheet.map, labels, plan.certificate)
    handles += draw_sharpest(sheet.map, labels, plan.drivability)
    handles += draw_moving(sheet.map, labels, moment_of(plan))
    labels.place(np.vstack([points, *losing(plan)]), places)
    return handles


def _draw_close(axes: Axes, pixels_per_metre: float, *, plan: Plan) -> None:
    """What the map shows of a plan, for axes that show a part of it larger."""
    draw_zones(axes, Labels(axes), plan.mission.world.speed_zones)
    draw_swept(axes, plan.path, plan.mission.robot, pixels_per_metre)
    for line in losing(plan):
        _draw_loser(axes, line, "way not taken")
    draw_path(axes, polyline(plan.path.spans))
    draw_plain_vias(axes, plan.path.vias, plan.mission)


def moment_of(plan: Plan) -> Moment:
    """What moves, at the plan's tightest instant."""
    law, certificate = plan.trajectory, plan.moving_certificate
    now = law.start_time if certificate is None else certificate.tightest_at_s
    moving = MovingObstacles.known(plan.mission)
    at = body_at(plan, now)
    return Moment(moving, law.start_time, law.end_time, now, plan.mission.robot, at)


def subtitle(mission: Mission) -> str:
    """How the curve was asked to be, and by whom it is driven."""
    robot = mission.robot
    return f"{spline_words(mission)}; {body_words(robot)}, at most {robot.max_speed_mps:g} m/s"


def proof(
    certificate: Certificate, tracking_error: float = 0.0, moving: float | None = None
) -> str:
    """The proven clearance in a few words.

    Args:
        certificate: Of what stands.
        tracking_error: What is kept for it is said apart [m].
        moving: The proven clearance to what moves [m]; None where nothing does.
    """
    stands = (
        f"{down(certificate.clearance)} to anything "
        f"({asked_words(certificate.required, tracking_error)} asked)"
    )
    near = [stands] if np.isfinite(certificate.clearance) else []
    if moving is not None and np.isfinite(moving):
        near.append(f"{down(moving)} to what moves")
    if not near:
        return "nothing to keep clear of"
    return f"proven: nowhere closer than {', nor than '.join(near)}"


def drive_notes(drive: Drivability) -> tuple[str, list[str]]:
    """The verdict of how a path drives, and why, in short lines."""
    across = f"at most {drive.max_lateral_accel:.2g} m/s² across the path"
    if not drive.reasons:
        return "Drives well", [across]
    shown = [why.text for why in drive.reasons[:MAX_REASONS]]
    if len(drive.reasons) > MAX_REASONS:
        shown.append(f"and {len(drive.reasons) - MAX_REASONS} more in plan.json")
    whole = [text.replace(" m ", "\u00a0m ") for text in shown]  # a number keeps its unit
    lines = [line for text in whole for line in textwrap.wrap(text, NOTE_WIDTH)]
    return "Drives roughly", [*lines, across]


def via_ticks(path: Path, mission: Mission) -> list[tuple[float, str]]:
    """Where the points of the route lie along a path, and their numbers."""
    last = len(mission.route.via) + 1
    names = {0: "S", last: "G"}
    lap = last if mission.route.closed else last + 1
    return [
        (float(distance), names.get(via.index % lap, str(via.index % lap)))
        for via, distance in zip(path.vias, path.via_distances, strict=True)
        if via.index is not None
    ]


def losing(plan: Plan) -> list[Floats]:
    """The ways that were possible and not taken, as points [m]."""
    return [
        polyline(candidate.spans)
        for entry in plan.ledger
        for candidate in entry.candidates
        if not candidate.chosen and len(candidate.spans)
    ]


def draw_losers(sheet: Sheet, labels: Labels, plan: Plan) -> list[Artist]:
    """The ways that were not taken, with what they would have cost.

    Returns:
        What belongs in a legend.
    """
    handles: list[Artist] = []
    lines = losing(plan)
    label = f"{len(lines)} ways not taken" if len(lines) > MAX_GROUPS_MEASURED else "way not taken"
    for line in lines:
        handles = [_draw_loser(sheet.map, line, label)]
    legs: set[tuple[str, str]] = set()
    said: set[tuple[tuple[str, str], str]] = set()  # one way may lose against several groups
    for entry in plan.ledger if len(plan.ledger) <= MAX_GROUPS_MEASURED else ():
        taken = entry.chosen
        if taken is None or taken.length is None or len(entry.candidates) < 2:
            continue
        losers = [c for c in entry.candidates if not c.chosen and c.length is not None]
        for candidate in losers:
            assert candidate.length is not None
            more = round(candidate.length - taken.length, 1) + 0.0  # no minus nought
            later = round((candidate.duration or 0.0) - (taken.duration or 0.0), 1) + 0.0
            text = (
                f"{candidate.side}: {metres(candidate.length, 1)} ({more:+.1f} m, {later:+.1f} s)"
            )
            if (entry.leg, text) not in said:
                said.add((entry.leg, text))
                at = _far_from(candidate.spans, taken.spans)
                labels.add(text, at, rank=4, colour=style.LOSER)
        if losers and entry.leg not in legs:
            legs.add(entry.leg)
            at = _far_from(taken.spans, losers[0].spans)
            text = f"{taken.side}: {metres(taken.length, 1)}"
            labels.add(text, at, rank=6, colour=style.PATH)
    return handles


def _draw_loser(axes: Axes, line: Floats, label: str) -> Artist:
    (handle,) = axes.plot(
        *line.T, color=style.LOSER, linewidth=1.1, linestyle=(0, (5, 3)), alpha=0.75,
        zorder=6, scalex=False, scaley=False, label=label,
    )  # fmt: skip
    return handle


def _far_from(spans: Floats, others: Floats) -> tuple[float, float]:
    """The point of a curve that is farthest from another one."""
    line, other = polyline(spans, 20), polyline(others, 20)
    apart = np.hypot(*(line[:, None] - other[None]).transpose(2, 0, 1)).min(axis=1)
    x, y = line[int(np.argmax(apart))]
    return float(x), float(y)


def _fill_strips(sheet: Sheet, plan: Plan) -> None:
    path, trajectory = plan.path, plan.trajectory
    joints = np.asarray(path.distance(np.linspace(*path.domain, len(path.spans) + 1)))
    even = np.linspace(0, path.length, 1500)
    within = min(PER_SPAN, max(20_000 // len(path.spans), 1))  # where a short span may be sharp
    inside = np.linspace(*path.domain, within * len(path.spans) + 1)
    near = np.concatenate(
        [trajectory.distances, joints, np.maximum(joints - 1e-7 * path.length, 0)]
    )
    inner = np.asarray(path.distance(inside))
    distances = np.unique(np.concatenate([even, inner, near[:20_000]]))
    u = np.asarray(path.parameter(distances))
    values = [np.asarray(trajectory.speed_at(distances)), np.asarray(path.curvature(u))]
    if len(sheet.strips) == 3:
        values.append(np.asarray(path.evaluate(u))[:, 2])
    fill_strips(sheet.strips, distances, values, via_ticks(path, plan.mission), style.PATH)
    draw_curvature_limit(sheet.strips[1], plan.mission.robot.turn_radius)
    mark_clipped(sheet.strips[1], distances, values[1], path.max_curvature()[0])
