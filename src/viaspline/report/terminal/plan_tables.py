"""Tables of a plan for the terminal: its path in figures, and its ledger.

Tested through ``report/terminal/test_terminal_tables``.
"""

from __future__ import annotations

from types import MappingProxyType
from typing import Final

from rich import box
from rich.console import Group, RenderableType
from rich.table import Table

from viaspline.curve.path import GUIDE
from viaspline.machine.drivability import Drivability
from viaspline.planner import Plan
from viaspline.planning.problem.ledger import Candidate, LedgerEntry
from viaspline.planning.problem.preferred_clearance import PreferredClearance
from viaspline.report.summary import map_words
from viaspline.report.terminal.terminal_tables import MAX_LIST_LINES, Rows, facts_table, few_names
from viaspline.report.units import asked_words, curvature, down, metres, place, seconds
from viaspline.trajectory.trajectory import Trajectory

LEAST_ROOM_M = 0.005  # by which two ways on one side are told apart
MAX_REASONS = 4  # why a path drives roughly, before the rest is only counted
_OTHER: Final = MappingProxyType({"left": "right", "right": "left"})
_COMPARED_FIGURES: Final = ("time", "length", "clearance", "curvature")


def plan_tables(plan: Plan, name: str) -> RenderableType:
    """The path in figures, and its ledger."""
    facts = facts_table(f"Plan · {name}", plan_rows(plan))
    return Group(facts, ledger_table(plan.ledger)) if plan.ledger else facts


def plan_rows(plan: Plan) -> Rows:
    """The path in figures: names, and what they are."""
    path, certificate = plan.path, plan.certificate
    rows: Rows = []
    users = [via for via in path.vias if via.kind == "user"]
    detours = sum(via.kind == "detour" and via.name != GUIDE for via in path.vias)
    for obstacle in plan.world.obstacles:
        if obstacle.grid is not None:
            rows.append(("map", map_words(obstacle.grid).removeprefix("map").lstrip(" :")))
    rows.append(("length", metres(path.length, 1)))
    rows.append(("duration", seconds(plan.trajectory.duration)))
    rows.append(("points of the route", f"{len(users)}, and {detours} of detours"))
    asked = asked_words(certificate.required, plan.tracking_error)
    rows.append(("clearance, proven", f"{down(certificate.clearance)} (asked {asked})"))
    if plan.preferred_clearance is not None:
        rows.append(("clearance, preferred", preferred_words(plan.preferred_clearance)))
    if certificate.obstacle is not None:
        rows.append(
            (
                "tightest place",
                f"{place(certificate.tightest_at)} at {metres(certificate.tightest_distance, 1)}, "
                f"beside {certificate.obstacle}",
            )
        )
    rows.append(("largest curvature", curvature(1.0 / plan.drivability.sharpest_radius)))
    rows += drivability_rows(plan.drivability)
    rows += moving_rows(plan)
    rows += station_rows(plan.trajectory)
    return rows


def preferred_words(weighed: PreferredClearance) -> str:
    """How much more than required is kept, and what the rest would have cost."""
    words = []
    for one in weighed.tried:
        if one.duration is None:
            cost = "no path found"
        else:
            cost = f"{one.duration - weighed.duration:+.1f} s{', taken' if one.taken else ''}"
        words.append(f"{one.clearance:.2f} m more: {cost}")
    return "; ".join(words)


def station_rows(law: Trajectory) -> Rows:
    """Where a robot stands by a time law, and for how long; nothing if it stops nowhere."""
    stations = [station for station in law.stations if station.dwell > 0]
    words = ", ".join(f"{one.name} {one.dwell:g} s" for one in stations[:MAX_LIST_LINES])
    return [("stations", words)] if stations else []


def drivability_rows(drive: Drivability) -> list[tuple[str, str]]:
    """How a path drives, and every reason why that isn't well."""
    rows = [("across the path", f"at most {drive.max_lateral_accel:.3g} m/s²")]
    if not drive.reasons:
        return [*rows, ("drives", "good")]
    shown = [why.text for why in drive.reasons[:MAX_REASONS]]
    if len(drive.reasons) > MAX_REASONS:
        shown.append(f"… and {len(drive.reasons) - MAX_REASONS} more in plan.json")
    return [*rows, ("drives", f"rough: {shown[0]}"), *(("", words) for words in shown[1:])]


def moving_rows(plan: Plan) -> list[tuple[str, str]]:
    """How near what moves comes, what the path passes, and where it waits; nothing without."""
    if plan.timed is None:
        return []
    proof = plan.timed.certificate
    words = "nothing comes near"
    if proof.obstacle is not None:
        words = f"{down(proof.clearance)}, to '{proof.obstacle}' at {proof.tightest_at_s:.1f} s"
    rows = [("to what moves, proven", words)]
    taken = next((one for one in plan.timed.candidates if one.chosen), None)
    rows += [
        ("", f"leaves '{passing.obstacle}' on its {_OTHER[passing.side]}")
        for passing in (() if taken is None else taken.passings)
    ]
    for wait in plan.timed.waits[:MAX_LIST_LINES]:
        how = f"waits {seconds(wait.stood)}" if wait.stood > 0.0 else "slows"
        what = f"{how} for '{wait.obstacle}', {seconds(wait.lost)} later by {metres(wait.end, 1)}"
        rows.append(("", what))
    return rows


def ledger_table(ledger: tuple[LedgerEntry, ...]) -> RenderableType:
    """Every group met and every side tried."""
    table = Table(title="Detours", title_justify="left", box=box.SIMPLE_HEAD)
    for column in ("leg", "past", "side", "time", "length", "clearance", "curvature", ""):
        table.add_column(column, justify="right" if column in _COMPARED_FIGURES else "left")
    for entry in ledger[:MAX_LIST_LINES]:
        leg, past = " → ".join(entry.leg), few_names(entry.members)
        for side, candidate in zip(ways_told_apart(entry), entry.candidates, strict=True):
            table.add_row(leg, past, side, *_candidate(candidate))
            leg = past = ""
    if len(ledger) > MAX_LIST_LINES:
        table.add_row(f"… and {len(ledger) - MAX_LIST_LINES} more in plan.json")
    return table


def ways_told_apart(entry: LedgerEntry) -> list[str]:
    """The sides of an entry's candidates; what keeps more room on a side than another says so.

    >>> import numpy as np
    >>> nothing = np.empty((0, 3))
    >>> near, far = (Candidate("left", nothing, nothing, clearance=kept) for kept in (0.5, 1.25))
    >>> ways_told_apart(LedgerEntry(("mast",), ("A", "B"), (near, far)))
    ['left', 'left, 0.75 m roomier']
    """
    first: dict[str, Candidate] = {}
    words = []
    for candidate in entry.candidates:
        other = first.setdefault(candidate.side, candidate)
        words.append(candidate.side if other is candidate else _beside(candidate, other))
    return words


def _beside(candidate: Candidate, other: Candidate) -> str:
    """A side on which another way passes as well, told by what this one has more of."""
    if candidate.clearance is None or other.clearance is None:
        return f"{candidate.side}, another way"
    more = candidate.clearance - other.clearance
    if abs(more) < LEAST_ROOM_M:
        return f"{candidate.side}, another way"
    return f"{candidate.side}, {metres(abs(more))} {'roomier' if more > 0.0 else 'closer'}"


def _candidate(candidate: Candidate) -> tuple[str, str, str, str, str]:
    if candidate.impossible is not None:
        return "–", "–", "–", "–", candidate.impossible
    clearance = "–" if candidate.clearance is None else down(candidate.clearance)
    bend = "–" if candidate.max_curvature is None else f"{candidate.max_curvature:.3g} 1/m"
    time, length = seconds(candidate.duration), metres(candidate.length, 1)
    verdict = "taken" if candidate.chosen else candidate.passed_over or ""
    return time, length, clearance, bend, verdict
