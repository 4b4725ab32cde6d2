"""Reading other people's JSON: every value by its key, every fault noted, none fatal at once.

Tested through ``formats/test_qgc_plan``.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from viaspline.errors import Fault
from viaspline.formats.file_faults import fault_at, refusal
from viaspline.formats.items import Place
from viaspline.mission.unplaced_faults import describe


@dataclass
class JsonFaults:
    """Faults of one file, as they are found."""

    source: str
    found: list[Fault] = field(default_factory=list)

    def note(self, key: str, problem: str, remedy: str) -> None:
        """Note one fault."""
        self.found.append(fault_at(self.source, Place(key), problem, remedy))


@dataclass(frozen=True)
class Tree:
    """A value in a JSON file, with its key and the list where its faults are noted.

    Attributes:
        key: The key, e.g. ``mission.items[3].params[4]``.
        value: What stands there; None for nothing.
        faults: Where to note what is wrong.
    """

    key: str
    value: Any
    faults: JsonFaults

    def fault(self, problem: str, remedy: str) -> None:
        """Note that something is wrong here."""
        self.faults.note(self.key, problem, remedy)

    def __getitem__(self, name: str) -> Tree:
        """The value of a key; nothing if it isn't there or this is no mapping."""
        value = self.value.get(name) if isinstance(self.value, dict) else None
        return Tree(f"{self.key}.{name}" if self.key else name, value, self.faults)

    def __contains__(self, name: str) -> bool:
        return isinstance(self.value, dict) and self.value.get(name) is not None

    def items(self) -> Iterator[Tree]:
        """The items of a list; none, with a fault, if it is something else."""
        if self.value is None:
            return
        if not isinstance(self.value, list):
            self.fault(f"found {describe(self.value)}", "it should be a list")
            return
        for i, item in enumerate(self.value):
            yield Tree(f"{self.key}[{i}]", item, self.faults)

    def number(self, default: float = math.nan) -> float:
        """A number; the default for null, with a fault for anything else."""
        if self.value is None:
            return default
        if isinstance(self.value, bool) or not isinstance(self.value, int | float):
            self.fault(f"found {describe(self.value)}", "it should be a number")
            return math.nan
        try:
            return float(self.value)
        except OverflowError:
            self.fault("found a huge number", "it should be a number that can be meant")
            return math.nan

    def whole(self) -> int | None:
        """A whole number; None, with a fault, for anything else."""
        value = self.value
        if isinstance(value, bool) or not isinstance(value, int | float) or value % 1 != 0:
            self.fault(f"found {describe(value)}", "it should be a whole number")
            return None
        return int(value)

    def numbers(self, least: int, what: str) -> tuple[float, ...]:
        """A list of at least so many numbers; empty, with a fault, for anything else."""
        if not isinstance(self.value, list) or len(self.value) < least:
            self.fault(f"found {describe(self.value)}", f"it should be {what}")
            return ()
        return tuple(item.number() for item in self.items())


def json_tree(text: str, source: str) -> Tree:
    """The root of a JSON text.

    Raises:
        MissionError: It isn't JSON, or no mapping.
    """
    try:
        value = json.loads(text)
    except json.JSONDecodeError as error:
        place = Place("", error.lineno, error.colno)
        remedy = "check the commas, quotes and brackets before this place"
        raise refusal(source, place, f"is not JSON: {error.msg.lower()}", remedy) from None
    except (RecursionError, ValueError) as error:
        problem = "is nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise refusal(source, Place("", 1, 1), problem, "save the plan again") from None
    tree = Tree("", value, JsonFaults(source))
    if not isinstance(value, dict):
        problem = f"the file holds {describe(value)}"
        raise refusal(source, Place("", 1, 1), problem, "it should be a plan of QGroundControl")
    return tree
