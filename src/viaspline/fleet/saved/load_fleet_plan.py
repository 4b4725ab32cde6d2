"""The plan of a fleet that was saved, read again and proven again."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Final

from viaspline.bounded_file import is_folder
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.precedences import Precedence, precedences_of
from viaspline.fleet.robots_at_home import certify_all
from viaspline.fleet.saved.fleet_file import FleetFile
from viaspline.fleet.saved.saved_laws import SavedLaws
from viaspline.fleet.saved.saved_patrols import checked_patrols, for_ever
from viaspline.fleet.saved.saved_robot import SavedRobots, fleet_beside
from viaspline.formats.asked_for import AskedFleet, asked_fleet
from viaspline.handed_in import check_kind
from viaspline.saved_plans.law_within_limits import PROVEN_OFF_M, TIMED_OFF
from viaspline.saved_plans.load_plan import FLEET_NAME

PLANNED_FLEET_NAME: Final = "planned-fleet.yaml"
COURSES_NAME: Final = "courses.npz"


def load_fleet_plan(folder: str | Path, fleet: AskedFleet | None = None) -> FleetPlan:
    """The plan of a fleet that ``plan.save(folder)`` or ``viaspline plan`` wrote there.

    What can be proven isn't believed. Each robot's path and law are taken and proven as
    ``load_plan`` does it, and all robots are proven apart again, over continuous time: courses and
    laws at their nodes are held against the paths and laws of the robots' plans, crossings and who
    passes first are found again, and that patrols come again. So it equals what was saved, or is
    refused. Why a robot isn't served is a record, and taken as it stands.

    Args:
        folder: With ``fleet.json``, or that file itself.
        fleet: What was planned; not needed where ``planned-fleet.yaml`` stands beside it.

    Raises:
        MissionError: A file isn't there or can't be read, or the fleet has faults.
        SavedPlanError: The files are no plan of the fleet, or say what isn't so: somebody changed
            one of them, or a map.

    Example:
        >>> from tempfile import TemporaryDirectory
        >>> import viaspline as vs
        >>> made = vs.plan_fleet(vs.Fleet.model_validate({"separation_m": 1, "fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
        ...     {"name": "b", "route": {"start": [20, -20], "goal": [20, 20]}},
        ... ]}))
        >>> with TemporaryDirectory() as folder:
        ...     files = made.save(folder)
        ...     again = load_fleet_plan(folder)
        >>> again == made, again.certificate.holds
        (True, True)
    """
    check_kind("folder", folder, (str, Path), "give the path of a folder with fleet.json")
    file = Path(folder)
    if file.name != FLEET_NAME or is_folder(file):
        file = file / FLEET_NAME
    asked = asked_fleet(fleet_beside(file, PLANNED_FLEET_NAME) if fleet is None else fleet)
    told = FleetFile.read(file, asked)
    plans = SavedRobots(asked, told).plans()
    laws = SavedLaws.read(file.with_name(COURSES_NAME))
    laws.check(asked, plans)
    record = laws.record
    patrols = checked_patrols(told, asked, plans)
    certificate = certify_all(asked, record.courses, record.laws)
    certificate = replace(certificate, repeats=for_ever(patrols))
    _check_proof(told, certificate)
    crossings = crossings_of(record.courses)
    crossings = ordered_crossings(record.courses, crossings, record.laws)
    precedences = precedences_of(record.courses, crossings, record.laws, record.rides.laws)
    _check_precedences(told, precedences)
    alone = dict(zip(record.courses.names, record.rides.alone.tolist(), strict=True))
    for name in plans:
        told.check_robot(name, alone_s=alone[name])
    return FleetPlan(
        fleet=asked,
        plans=plans,
        not_served=told.not_served(plans),
        certificate=certificate,
        precedences=precedences,
        alone=alone,
        courses=record.courses,
        crossings=crossings,
        laws=record.laws,
        rides=record.rides,
        patrols=patrols,
    )


def _check_proof(told: FleetFile, found: FleetCertificate) -> None:
    """Hold the proof that was made again against what the file says of it.

    Raises:
        SavedPlanError: It says something else, or the robots come too near each other.
    """
    said = told.file.number("certificate", "separation_m")
    told.file.check("separation [m]", said, found.separation, PROVEN_OFF_M)
    pair = told.file.part("certificate", "pair")
    if (None if pair is None else tuple(pair)) != found.pair:
        raise told.file.wrong(f"says that {pair} are nearest, and it is {found.pair}")
    if told.file.part("certificate", "holds") is not found.holds:
        raise told.file.wrong("certificate.holds isn't what is found again")


def _check_precedences(told: FleetFile, found: tuple[Precedence, ...]) -> None:
    """Hold who passes first against what the file says.

    Raises:
        SavedPlanError: It says something else.
    """
    said = told.precedences()
    if len(said) != len(found):
        raise told.file.wrong(f"says {len(said)} precedences, and {len(found)} are found again")
    for one, other in zip(said, found, strict=True):
        numbers = [
            (abs(getattr(one, key) - getattr(other, key)), abs(getattr(other, key)))
            for key in ("leaves_at", "enters_at", "waits_s")
        ]
        far = any(off > TIMED_OFF * (1.0 + size) for off, size in numbers)
        if far or (one.first, one.second) != (other.first, other.second):
            raise told.file.wrong(
                f"says that '{one.first}' passes before '{one.second}' at {one.leaves_at:.6g} m, "
                f"and '{other.first}' before '{other.second}' at {other.leaves_at:.6g} m is found "
                "again"
            )
