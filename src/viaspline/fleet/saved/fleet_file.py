"""``fleet.json`` as it is read again."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any, Final, TypeVar

from viaspline.bounded_file import FileKind
from viaspline.fleet.not_served import NotServed, Outcome
from viaspline.fleet.patrols.fleet_patrols import FleetPatrols
from viaspline.fleet.precedences import Precedence
from viaspline.mission.fleet.fleet import Fleet
from viaspline.saved_plans.plan_file import PlanFile

FLEET_FILE: Final = FileKind("fleet.json", 400_000_000, "plan the fleet again")
OUTCOMES: Final[Mapping[str, Outcome]] = {"refused": "refused", "gave up": "gave up"}

_Told = TypeVar("_Told")


@dataclass(frozen=True)
class FleetFile:
    """What a ``fleet.json`` says.

    Attributes:
        file: All of it.
        robots: What it says of each robot, by name, in the order of the fleet.
    """

    file: PlanFile
    robots: Mapping[str, Mapping[str, Any]]

    @classmethod
    def read(cls, path: Path, fleet: Fleet) -> FleetFile:
        """Read that of a fleet.

        Raises:
            MissionError: There is no such file, or it can't be read.
            SavedPlanError: It is of another fleet.
        """
        file = PlanFile.read(path, FLEET_FILE)
        listed = _listed(file, "robots", lambda one: (str(one["name"]), one))
        names = [name for name, _ in listed]
        asked = [one.name for one in fleet.members]
        if names != asked:
            odd = sorted(set(names) ^ set(asked)) or asked
            raise file.wrong(f"has other robots than the fleet: '{odd[0]}'")
        apart = file.number("fleet", "separation_m")
        file.check("separation_m", apart, fleet.separation_m, 0.0)
        return cls(file, dict(listed))

    def plan_of(self, name: str) -> Path | None:
        """Where the plan of a robot stands; None if it has none.

        Raises:
            SavedPlanError: That is no place in the folder of the fleet.
        """
        said = self.robots[name].get("plan", ...)
        if said is None:
            return None
        parts = PurePosixPath(said).parts if isinstance(said, str) else ()
        plain = len(parts) == 2 and parts[0] not in ("..", "/") and parts[1] == "plan.json"
        if not plain or "\\" in str(said) or "\0" in str(said):
            raise self.file.wrong(f"robots: the plan of '{name}' has to be FOLDER/plan.json")
        return self.file.file.parent.joinpath(*parts)

    def check_robot(self, name: str, **found: float) -> None:
        """Hold what it says of a robot against what was found again.

        Raises:
            SavedPlanError: It says something else.
        """
        said = PlanFile(self.file.file, self.robots[name])
        for key, value in found.items():
            off = 1e-6 * (1.0 + abs(value))
            said.check(f"{key} of '{name}'", said.number(key), value, off)

    def not_served(self, served: Collection[str]) -> tuple[NotServed, ...]:
        """The robots that have no plan, and why: a record, nothing of which is proven again.

        Args:
            served: The robots that have one.

        Raises:
            SavedPlanError: It doesn't say so of each robot without a plan.
        """
        found = _listed(self.file, "refused", _not_served)
        if sorted(one.name for one in found) != sorted(self.robots.keys() - set(served)):
            raise self.file.wrong("refused doesn't name the robots that have no plan")
        return found

    def precedences(self) -> tuple[Precedence, ...]:
        """Who passes first, as it says.

        Raises:
            SavedPlanError: It doesn't say.
        """
        return _listed(self.file, "precedences", _precedence)

    def patrols(self) -> FleetPatrols | None:
        """What never ends; None where all do.

        Raises:
            SavedPlanError: That isn't told.
        """
        if "patrols" not in self.file.data:
            return None
        told = self._patrols
        period, since, until = (
            told.number(key) for key in ("period_s", "repeats_from_s", "planned_until_s")
        )
        begins = dict(
            _listed(told, "robots", lambda one: (str(one["name"]), float(one["begins_s"])))
        )
        return FleetPatrols(period, self._counts("laps_a_period"), begins, since, until)

    def laps(self, name: str) -> int:
        """How many laps are planned of a patrol.

        Raises:
            SavedPlanError: It says none.
        """
        laps = self._counts("laps_planned").get(name, 0)
        if laps < 1:
            raise self.file.wrong(f"patrols has no laps of '{name}', which is one")
        return laps

    @property
    def _patrols(self) -> PlanFile:
        return PlanFile(self.file.file, self.file.part("patrols"))

    def _counts(self, key: str) -> dict[str, int]:
        return dict(_listed(self._patrols, "robots", lambda one: (str(one["name"]), int(one[key]))))


def _listed(
    file: PlanFile, key: str, read: Callable[[Mapping[str, Any]], _Told]
) -> tuple[_Told, ...]:
    """What is read of each item of a list."""
    listed = file.part(key)
    try:
        return tuple(read(one) for one in listed)
    except (KeyError, TypeError, ValueError, OverflowError, AttributeError):
        raise file.wrong(f"{key} isn't what it has to be") from None


def _not_served(one: Mapping[str, Any]) -> NotServed:
    where = None if one["at"] is None else tuple(float(value) for value in one["at"])
    return NotServed(
        str(one["name"]), OUTCOMES[one["outcome"]], str(one["reason"]), str(one["remedy"]),
        tuple(str(name) for name in one["in_the_way"]), where,
    )  # fmt: skip


def _precedence(one: Mapping[str, Any]) -> Precedence:
    left, entered, waited = (float(one[k]) for k in ("leaves_at_m", "enters_at_m", "waits_s"))
    return Precedence(str(one["first"]), str(one["second"]), left, entered, waited)
