"""A plan in space in figures, for the terminal.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

import math

from rich.console import Group, RenderableType

from viaspline.report.space.heights_json import heights_rows
from viaspline.report.terminal_tables import MAX_LIST_LINES, facts_table, ledger_table
from viaspline.report.units import asked_words, down, metres, place, seconds
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.trajectory.moving_certificate import MovingCertificate


def spatial_plan_tables(plan: SpatialPlan, name: str) -> RenderableType:
    """The path in figures, and its ledger."""
    path, certificate = plan.path, plan.certificate
    facts = facts_table(f"Plan · {name}")
    users = sum(via.kind == "user" for via in path.vias)
    detours = len(path.vias) - users
    facts.add_row("length", metres(path.length, 1))
    facts.add_row("duration", seconds(plan.trajectory.duration))
    facts.add_row("points of the route", f"{users}, and {detours} of detours")
    asked = asked_words(certificate.required)
    facts.add_row("clearance, proven", f"{down(certificate.clearance)} (asked {asked})")
    if certificate.obstacle is not None:
        facts.add_row(
            "tightest place",
            f"{place(certificate.tightest_at)} at {metres(certificate.tightest_distance, 1)}, "
            f"beside {certificate.obstacle}",
        )
    if plan.moving is not None:
        facts.add_row(*_moving_row(plan.moving))
    for wait in plan.waits[:MAX_LIST_LINES]:
        words = f"{seconds(wait.lost)} for '{wait.obstacle}', from {metres(wait.start, 1)}"
        facts.add_row("waits or slows", words)
    for row in heights_rows(plan):
        facts.add_row(*row)
    radius = plan.sharpest_radius
    facts.add_row("sharpest radius", "straight" if math.isinf(radius) else metres(radius))
    stations = [s for s in plan.trajectory.stations if s.dwell > 0]
    if stations:
        facts.add_row(
            "stations", ", ".join(f"{s.name} {s.dwell:g} s" for s in stations[:MAX_LIST_LINES])
        )
    return Group(facts, ledger_table(plan.ledger)) if plan.ledger else facts


def _moving_row(proof: MovingCertificate) -> tuple[str, str]:
    """What is proven of the distance from what moves."""
    if proof.obstacle is None:
        return "from what moves", "nothing of it is there meanwhile"
    words = f"{down(proof.clearance)}, of '{proof.obstacle}' after {proof.tightest_at_s:.1f} s"
    return "from what moves, proven", words
