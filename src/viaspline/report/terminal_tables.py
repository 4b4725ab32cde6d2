"""Tables for the terminal."""

from __future__ import annotations

from rich import box
from rich.console import Console, Group, RenderableType
from rich.table import Table

from viaspline.curve.path import GUIDE
from viaspline.machine.drivability import Drivability
from viaspline.planner import Plan
from viaspline.planning.problem.ledger import Candidate, LedgerEntry
from viaspline.planning.problem.preferred_clearance import PreferredClearance
from viaspline.report.proven_reference import PROVEN_WORDS, says_proven
from viaspline.report.style import without_folder
from viaspline.report.summary import map_words
from viaspline.report.terminal_lines import writing_output
from viaspline.report.units import asked_words, curvature, down, metres, place, seconds
from viaspline.robot.run import MODES, Run, Shortfall
from viaspline.tracks.encountered import Encounters

Rows = list[tuple[str, str]]  # names, and what they are
LEAST_ROOM_M = 0.005  # by which two ways on one side are told apart
MAX_REASONS = 4  # why a path drives roughly, before the rest is only counted
MAX_LIST_LINES = 12  # of a long list, before the rest is only counted


class _Console(Console):
    """A console that leaves it to us what happens when nobody is listening any more."""

    def on_broken_pipe(self) -> None:
        raise BrokenPipeError


def console() -> Console:
    """A console that takes names as they are, and hardly wraps when it is not a terminal."""
    plain = _Console(markup=False, highlight=False, emoji=False)
    if not plain.is_terminal:
        plain = _Console(markup=False, highlight=False, emoji=False, width=160)
    return plain


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
    stations = [s for s in plan.trajectory.stations if s.dwell > 0]
    if stations:
        rows.append(
            ("stations", ", ".join(f"{s.name} {s.dwell:g} s" for s in stations[:MAX_LIST_LINES]))
        )
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


_OTHER = {"left": "right", "right": "left"}


def ledger_table(ledger: tuple[LedgerEntry, ...]) -> RenderableType:
    """Every group met and every side tried."""
    table = Table(title="Detours", title_justify="left", box=box.SIMPLE_HEAD)
    for column in ("leg", "past", "side", "time", "length", "clearance", "curvature", ""):
        table.add_column(column, justify="right" if column in _COMPARED_FIGURES else "left")
    for entry in ledger[:MAX_LIST_LINES]:
        leg, past = " → ".join(entry.leg), _members(entry.members)
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


_COMPARED_FIGURES = ("time", "length", "clearance", "curvature")


def _members(members: tuple[str, ...]) -> str:
    more = f" and {len(members) - 3} more" if len(members) > 3 else ""
    return ", ".join(_short(name) for name in members[:3]) + more


def _short(name: str) -> str:
    return without_folder(name).removeprefix("what is ")


def _candidate(candidate: Candidate) -> tuple[str, str, str, str, str]:
    if candidate.impossible is not None:
        return "–", "–", "–", "–", f"impossible: {candidate.impossible}"
    clearance = "–" if candidate.clearance is None else down(candidate.clearance)
    bend = "–" if candidate.max_curvature is None else f"{candidate.max_curvature:.3g} 1/m"
    time, length = seconds(candidate.duration), metres(candidate.length, 1)
    verdict = "taken" if candidate.chosen else candidate.passed_over or ""
    return time, length, clearance, bend, verdict


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
            seconds(replan.time), place(replan.at), _members(replan.obstacles), replan.mode,
            metres(replan.old_path.length, 1), metres(replan.path.length, 1),
            f"{replan.heading_jump:.1g} rad",
        )  # fmt: skip
    if len(run.replans) > MAX_LIST_LINES:
        table.add_row(f"… and {len(run.replans) - MAX_LIST_LINES} more in run.json")
    used = {replan.mode for replan in run.replans}
    modes = [f"{mode}: {words}" for mode, words in MODES.items() if mode in used]
    return Group(facts, table, *modes)


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


def facts_table(title: str, rows: Rows) -> Table:
    """A table of names and what they are, without lines between."""
    table = Table(title=title, title_justify="left", show_header=False, box=box.SIMPLE_HEAD)
    table.add_column(style="dim", no_wrap=True)
    table.add_column()
    for row in rows:
        table.add_row(*row)
    if says_proven(word for row in rows for word in row):
        table.caption, table.caption_justify = PROVEN_WORDS, "left"
    return table


def show(*tables: RenderableType) -> None:
    """Print tables on the output stream; nobody listening any more is no error.

    Raises:
        OutputError: They can't be written.
    """
    with writing_output():
        screen = console()
        for table in tables:
            screen.print(table)


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
