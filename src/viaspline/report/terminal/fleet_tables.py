"""The plan of a fleet in figures, for the terminal.

Tested through ``report/files/test_fleet_results``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from typing import Final

from rich.console import RenderableType

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.not_served import NotServed
from viaspline.report.proven_reference import with_meaning
from viaspline.report.terminal.terminal_tables import Rows, facts_table
from viaspline.report.units import asked_words, down, metres, place, seconds

MAX_WAITS_TOLD: Final = 8
"""How many waits are told one by one, the longest first."""
MAX_UNSERVED_TOLD: Final = 20
"""How many robots that aren't served are told one by one."""


def fleet_tables(plan: FleetPlan, name: str) -> RenderableType:
    """Who is served and when all are home, what is proven, and who waits for whom."""
    return facts_table(f"Fleet · {name}", fleet_rows(plan))


def fleet_rows(plan: FleetPlan) -> Rows:
    """Who is served and when all are home, what is proven, and who waits for whom."""
    members = plan.fleet.members
    rows: Rows = []
    rows.append(("served", f"{len(plan.plans)} of {len(members)}"))
    if plan.plans:
        lengths = [one.path.length for one in plan.plans.values()]
        patrols = {} if plan.patrols is None else plan.patrols.begins
        ends = [one.trajectory.end_time for n, one in plan.plans.items() if n not in patrols]
        rows.append(("driven", f"{metres(sum(lengths), 1)} in all"))
        if ends:
            rows.append(("all are home", f"after {seconds(max(ends))}"))
        if plan.patrols is not None:
            words = f"{len(patrols)} that never end, again every {seconds(plan.patrols.period)}"
            rows.append(("patrols", f"{words}, proven for all time"))
        rows.append(("later than alone", _late_words(plan)))
    rows += _apart(plan.certificate)
    rows.append(("crossings in order", str(len(plan.precedences))))
    waits = sorted(
        (one for one in plan.precedences if one.waits_s > 0.0), key=lambda one: -one.waits_s
    )
    for i, one in enumerate(waits[:MAX_WAITS_TOLD]):
        words = f"'{one.second}' for '{one.first}', {seconds(one.waits_s)}"
        rows.append(("longest waits" if i == 0 else "", words))
    if len(waits) > MAX_WAITS_TOLD:
        rows.append(("", f"… and {len(waits) - MAX_WAITS_TOLD} more in fleet.json"))
    return rows


def _apart(certificate: FleetCertificate) -> Iterator[tuple[str, str]]:
    """How far apart robots are proven to be, and which two are nearest, where and when."""
    asked = asked_words(certificate.required)
    yield "separation, proven", f"{down(certificate.separation)} (asked {asked})"
    if certificate.pair is not None and certificate.at is not None:
        (first, second), (where, there) = certificate.pair, certificate.at
        when = f"after {certificate.at_s:.1f} s"
        yield "nearest", f"'{first}' at {place(where)} and '{second}' at {place(there)}, {when}"


def fleet_run_table(run: FleetRun, name: str) -> RenderableType:
    """Who arrived and how late, and how near any two robots came.

    Args:
        run: What was driven.
        name: The fleet's name.
    """
    return facts_table(f"Run · {name}", fleet_run_rows(run))


def fleet_run_rows(run: FleetRun) -> Rows:
    """Who arrived and how late, and how near any two robots came."""
    rows: Rows = []
    rows.append(("arrived", f"{len(run.arrivals)} of {len(run.names)}"))
    rows.append(("ended", f"after {seconds(run.end_s)}"))
    rows.append(("later than planned", f"{seconds(run.mean_delay)} in the mean"))
    rows += _apart(run.certificate)
    kinds = Counter(event.kind for event in run.events if event.kind != "arrived")
    for kind, many in kinds.items():
        rows.append((kind, f"{many} {'time' if many == 1 else 'times'}"))
    return rows


def too_near_words(certificate: FleetCertificate) -> str | None:
    """That robots drove nearer to each other than is asked; None where they didn't."""
    if certificate.holds or certificate.pair is None:
        return None
    one, two = certificate.pair
    when = f"after {seconds(certificate.at_s)}"
    found, asked = down(certificate.separation), metres(certificate.required)
    return f"'{one}' and '{two}' drove as near as {found} {when}, {asked} are asked"


def _late_words(plan: FleetPlan) -> str:
    """How much later than alone the robots that are served arrive, all together."""
    late = alone = 0.0
    for member in plan.fleet.members:
        if member.name in plan.plans:
            end = plan.plans[member.name].trajectory.end_time
            late += max(end - member.mission.route.depart_s - plan.alone[member.name], 0.0)
            alone += plan.alone[member.name]
    share = f", {100 * late / alone:.1f} %" if alone > 0.0 else ""
    return f"{seconds(late / len(plan.plans))} in the mean{share}"


def unserved_lines(plan: FleetPlan) -> list[str]:
    """Which robots have no plan, why, and what would help: on lines."""
    missing = plan.not_served
    if not missing:
        found, asked = plan.certificate.separation, plan.certificate.required
        words = f"gave up: {down(found)} between the robots are proven, {metres(asked)} are asked"
        return [*with_meaning(words)]
    many = f"{len(missing)} of {len(plan.fleet.members)} robots"
    lines = [f"{many} {'is' if len(missing) == 1 else 'are'} not served"]
    for one in missing[:MAX_UNSERVED_TOLD]:
        lines += [f"  {_outcome(one)}: {one.reason}", f"    remedy: {one.remedy}"]
    if len(missing) > MAX_UNSERVED_TOLD:
        lines.append(f"  … and {len(missing) - MAX_UNSERVED_TOLD} more in fleet.json")
    return lines


def _outcome(one: NotServed) -> str:
    how = "there is no plan for" if one.outcome == "refused" else "gave up on"
    return f"{how} '{one.name}'"
