"""Tables of a run for the terminal: what was driven in figures, and the re-plans.

Tested through ``report/terminal/test_terminal_tables``.
"""

from __future__ import annotations

from rich import box
from rich.console import Group, RenderableType
from rich.table import Table

from viaspline.report.terminal.terminal_tables import MAX_LIST_LINES, Rows, facts_table, few_names
from viaspline.report.units import asked_words, down, metres, place, seconds
from viaspline.robot.run import MODES, Run, Shortfall
from viaspline.tracks.encountered import Encounters


def run_tables(run: Run, name: str) -> RenderableType:
    """What was driven in figures, the via points and the re-plans."""
    facts = facts_table(f"Run · {name}", run_rows(run))
    if not run.replans:
        return facts
    table = Table(title="Re-plans", title_justify="left", box=box.SIMPLE_HEAD)
    for column in ("time", "at", "because of", "mode", "length before", "after", "jump of heading"):
        table.add_column(column)
    for replan in run.replans[:MAX_LIST_LINES]:
        table.add_row(
            seconds(replan.time), place(replan.at), few_names(replan.obstacles), replan.mode,
            metres(replan.old_path.length, 1), metres(replan.path.length, 1),
            f"{replan.heading_jump:.1g} rad",
        )  # fmt: skip
    if len(run.replans) > MAX_LIST_LINES:
        table.add_row(f"… and {len(run.replans) - MAX_LIST_LINES} more in run.json")
    used = {replan.mode for replan in run.replans}
    modes = [f"{mode}: {words}" for mode, words in MODES.items() if mode in used]
    return Group(facts, table, *modes)


def run_rows(run: Run) -> Rows:
    """What was driven in figures: names, and what they are."""
    rows: Rows = []
    rows.append(("reached its goal", "yes" if run.reached else f"NO: {run.reason}"))
    rows.append(("driven", f"{metres(run.path.length, 1)} in {seconds(run.duration)}"))
    planned = f"{metres(run.plan.path.length, 1)} in {seconds(run.plan.trajectory.duration)}"
    rows.append(("planned before", planned))
    if run.plan.drivability.reasons:
        rows.append(("  drives", f"rough: {run.plan.drivability.reasons[0].text}"))
    asked = asked_words(run.certificate.required)
    rows.append(("clearance, proven", f"{down(run.certificate.clearance)} (asked {asked})"))
    if run.certificate.obstacle is not None:
        rows.append(
            (
                "tightest place",
                f"{place(run.certificate.tightest_at)} beside {run.certificate.obstacle}",
            )
        )
    for shortfall in run.shortfalls[:MAX_LIST_LINES]:
        rows.append(("NEARER THAN ASKED", shortfall_words(shortfall)))
    rows += encounter_rows(run.encounters)
    if run.tracking is not None:
        cross = run.tracking.cross
        rows.append(
            (
                "beside its path",
                f"{metres(cross.p99, 3)} in 99 % of the time, at most {metres(cross.max, 3)} "
                f"(allowed {metres(run.plan.tracking_error, 3)})",
            )
        )
        if run.excesses:
            rows.append(("BEYOND WHAT IS KEPT", _beyond(run)))
    served = sum(visit.status == "served" for visit in run.visits)
    rows.append(("points served", f"{served} of {len(run.visits)}"))
    missed = [visit for visit in run.visits if visit.status != "served"]
    for visit in missed[:MAX_LIST_LINES]:
        rows.append((f"  {visit.name}", f"{visit.status}: {visit.reason or 'no reason given'}"))
    return rows


def shortfall_words(shortfall: Shortfall) -> str:
    """What the body came nearer to than was asked, and whether the sensor could have shown it."""
    near = (
        f"{shortfall.obstacle} by {metres(shortfall.required - shortfall.clearance, 3)}, at "
        f"{place(shortfall.at)} after {seconds(shortfall.time)}"
    )
    if shortfall.on_map:
        return f"{near}: it is on the map"
    if shortfall.needed_by is None:
        return f"{near}: it was that near from the start"
    asked = f"needed by {seconds(shortfall.needed_by)}"
    shown = "never" if shortfall.shown is None else f"from {seconds(shortfall.shown)} on"
    could = "could" if shortfall.seen_in_time else "could NOT"
    return f"{near}: its sensor {could} have shown it in time ({asked}, in view {shown})"


def _beyond(run: Run) -> str:
    """When, where and by how much a robot was farther beside its path than was kept."""
    found = run.excesses
    worst = max(found, key=lambda excess: excess.off)
    lasted = sum(excess.until - excess.since for excess in found)
    times = "once" if len(found) == 1 else f"{len(found)} times"
    return (
        f"{times}, {seconds(lasted)} in all, at most {metres(worst.off, 3)} where "
        f"{metres(worst.kept, 3)} are kept, at {place(run.place_at(worst.worst_at))} after "
        f"{seconds(worst.worst_at)}: there the clearance of its path says nothing of the robot"
    )


def encounter_rows(met: Encounters | None) -> Rows:
    """How near a robot came to what moves, and every contact."""
    if met is None or met.time is None:
        return []
    near = f"{down(met.clearance)}, to '{met.obstacle}' at {met.time:.1f} s"
    rows: Rows = [("to what moves, proven", near)]
    for contact in met.contacts[:MAX_LIST_LINES]:
        how = "while it stood" if contact.robot_speed == 0.0 else "under way"
        if contact.appeared_within_braking_time:
            how += ", too late to be seen in time"
        rows.append(("CONTACT", f"'{contact.obstacle}' at {contact.time:.1f} s, {how}"))
    return rows
