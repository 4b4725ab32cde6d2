"""A plan in space in figures, for the terminal.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

import math

from rich.console import Group, RenderableType

from viaspline.report.space.heights_json import heights_rows
from viaspline.report.terminal.plan_tables import drivability_rows, ledger_table, station_rows
from viaspline.report.terminal.run_tables import encounter_rows
from viaspline.report.terminal.terminal_tables import MAX_LIST_LINES, Rows, facts_table
from viaspline.report.units import asked_words, down, metres, place, seconds
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_run import SpatialRun
from viaspline.trajectory.moving_certificate import MovingCertificate


def spatial_plan_tables(plan: SpatialPlan, name: str) -> RenderableType:
    """The path in figures, and its ledger."""
    facts = facts_table(f"Plan · {name}", spatial_plan_rows(plan))
    return Group(facts, ledger_table(plan.ledger)) if plan.ledger else facts


def spatial_run_tables(run: SpatialRun, name: str) -> RenderableType:
    """What was flown in figures."""
    return facts_table(f"Run · {name}", spatial_run_rows(run))


def spatial_plan_rows(plan: SpatialPlan) -> Rows:
    """The path in figures: names, and what they are."""
    path, certificate = plan.path, plan.certificate
    rows: Rows = []
    users = sum(via.kind == "user" for via in path.vias)
    detours = len(path.vias) - users
    rows.append(("length", metres(path.length, 1)))
    rows.append(("duration", seconds(plan.trajectory.duration)))
    rows.append(("points of the route", f"{users}, and {detours} of detours"))
    asked = asked_words(certificate.required)
    rows.append(("clearance, proven", f"{down(certificate.clearance)} (asked {asked})"))
    if certificate.obstacle is not None:
        rows.append(
            (
                "tightest place",
                f"{place(certificate.tightest_at)} at {metres(certificate.tightest_distance, 1)}, "
                f"beside {certificate.obstacle}",
            )
        )
    if plan.moving is not None:
        rows.append(_moving_row(plan.moving))
    for wait in plan.waits[:MAX_LIST_LINES]:
        words = f"{seconds(wait.lost)} for '{wait.obstacle}', from {metres(wait.start, 1)}"
        rows.append(("waits or slows", words))
    rows += heights_rows(plan)
    radius = plan.sharpest_radius
    rows.append(("sharpest radius", "straight" if math.isinf(radius) else metres(radius)))
    rows += drivability_rows(plan.drivability)
    rows += station_rows(plan.trajectory)
    return rows


def spatial_run_rows(run: SpatialRun) -> Rows:
    """What was flown in figures: names, and what they are."""
    return [
        ("reached its goal", "yes" if run.reached else f"NO: {run.reason}"),
        ("flown", seconds(run.duration)),
        ("clearance, proven", down(run.clearance)),
        *encounter_rows(run.encounters),
        *(("PREMISE", words) for words in run.broken_premises[:MAX_LIST_LINES]),
        ("largest speed", f"{float(run.speeds.max()):.2f} m/s"),
        ("heights", f"{metres(run.positions[:, 2].min(), 1)} to {run.positions[:, 2].max():.1f} m"),
        ("other paths under way", str(len(run.replans))),
    ]


def _moving_row(proof: MovingCertificate) -> tuple[str, str]:
    """What is proven of the distance from what moves."""
    if proof.obstacle is None:
        return "from what moves", "nothing of it is there meanwhile"
    words = f"{down(proof.clearance)}, of '{proof.obstacle}' after {proof.tightest_at_s:.1f} s"
    return "from what moves, proven", words
