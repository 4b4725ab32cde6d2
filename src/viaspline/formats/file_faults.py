"""Faults in other people's files.

Tested through ``formats/test_mission_yaml``.
"""

from __future__ import annotations

from viaspline.errors import Fault, MissionError
from viaspline.formats.items import Place


def fault_at(source: str, place: Place, problem: str, remedy: str) -> Fault:
    """A fault with the place where it stands."""
    return Fault(place.key, problem, remedy, source, place.line, place.column)


def refusal(source: str, place: Place, problem: str, remedy: str) -> MissionError:
    """An error with a single fault."""
    return MissionError([fault_at(source, place, problem, remedy)])
