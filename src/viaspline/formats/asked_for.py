"""What a verb is asked to do: a mission or a fleet at hand, or the file that it stands in.

Tested through ``formats/test_asked_for``.
"""

from __future__ import annotations

from pathlib import Path
from typing import TypeAlias

from viaspline.errors import GeometryError
from viaspline.formats.load import load
from viaspline.handed_in import check_kind
from viaspline.mission.fleet.fleet import Fleet
from viaspline.mission.model import Mission

AskedMission: TypeAlias = Mission | str | Path
"""A mission, or the file that it is read from."""
AskedFleet: TypeAlias = Fleet | str | Path
"""A fleet, or the file that it is read from."""

_MISSION_EXAMPLE = "give Mission.model_validate({...}), or the path of its file"
_FLEET_EXAMPLE = "give Fleet.model_validate({...}), or the path of its file"


def asked_mission(mission: AskedMission) -> Mission:
    """A mission; one that is named by its file is read.

    Raises:
        MissionError: The file can't be read, or what it asks for has faults.
        GeometryError: It is something else, or a file with a fleet.

    >>> asked_mission("patrol.yaml")
    Traceback (most recent call last):
    viaspline.errors.MissionError: patrol.yaml: there is no such file; give the path of ...
    """
    asked: object = load(mission) if isinstance(mission, str | Path) else mission
    if isinstance(asked, Fleet):
        where = f"{mission} holds" if isinstance(mission, str | Path) else "mission is"
        problem = f"{where} a fleet, not a mission"
        raise GeometryError(f"{problem}; hand it to plan_fleet or simulate_fleet")
    check_kind("mission", asked, Mission, _MISSION_EXAMPLE)
    assert isinstance(asked, Mission)
    return asked


def asked_fleet(fleet: AskedFleet) -> Fleet:
    """A fleet; one that is named by its file is read.

    Raises:
        MissionError: The file can't be read, or what it asks for has faults.
        GeometryError: It is something else, or a file with a single mission.

    >>> asked_fleet(5)
    Traceback (most recent call last):
    viaspline.errors.GeometryError: fleet is of the class int, not Fleet; give Fleet.model_valid...
    """
    asked: object = load(fleet) if isinstance(fleet, str | Path) else fleet
    if isinstance(asked, Mission):
        where = f"{fleet} holds" if isinstance(fleet, str | Path) else "fleet is"
        problem = f"{where} a mission of one robot, not a fleet"
        raise GeometryError(f"{problem}; hand it to plan or simulate")
    check_kind("fleet", asked, Fleet, _FLEET_EXAMPLE)
    assert isinstance(asked, Fleet)
    return asked
