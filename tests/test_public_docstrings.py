"""What a docstring says of everything that ``import viaspline`` gives."""

import dataclasses
import inspect
import re
from collections.abc import Iterator
from typing import Any

import pytest

import viaspline as vs

UNIT = re.compile(
    r"\[[^\]]+\]|\bshare\b|\bpart of\b|\bparameter\b|\btension|\b0 to \d|\bhow often\b"
    r"|\bwith their units\b|\bwho has more\b",
    re.IGNORECASE,
)
"""A unit in brackets, or words of a number that has none."""
MADE_BY_VERBS = {
    "Certificate", "Command", "Exported", "FleetCommand", "FleetMember", "FleetPlan", "FleetRun",
    "MovingCertificate", "Plan", "ProgressReport", "Run", "SpatialPlan", "SpatialRun",
    "TensionAdvice", "Trajectory",
}  # fmt: skip
"""Results: the example is that of the verb that gives them."""
VALUES = {name: getattr(vs, name) for name in vs.__all__ if name != "__version__"}
FUNCTIONS = [name for name, value in VALUES.items() if inspect.isfunction(value)]
CLASSES = [
    name for name, value in VALUES.items()
    if inspect.isclass(value) and not issubclass(value, Exception)
]  # fmt: skip


def described(doc: str, section: str) -> dict[str, str]:
    """What a section of a docstring says, by name; several names may share a line."""
    found = re.search(rf"^{section}:\n((?:[ ]+.*\n|\n)*)", f"{doc}\n", re.MULTILINE)
    words: dict[str, str] = {}
    names: list[str] = []
    for line in found[1].splitlines() if found else ():
        begun = re.match(r" {4}(\*{0,2}\w+(?:, \*{0,2}\w+)*): (.*)", line)
        if begun is not None:
            names = [name.lstrip("*") for name in begun[1].split(", ")]
        for name in names:
            words[name] = f"{words.get(name, '')} {line.strip()}"
    return words


def is_quantity(annotation: object) -> bool:
    return re.search(r"\bfloat\b|Floats", str(annotation)) is not None


def fields_of(kind: Any) -> Iterator[tuple[str, object]]:
    """The values that somebody reads or gives, with their types."""
    if dataclasses.is_dataclass(kind):
        for one in dataclasses.fields(kind):
            if one.init and not one.name.startswith("_"):
                yield one.name, one.type


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_says_what_it_takes_in_which_unit_what_it_raises_and_shows_it(name: str) -> None:
    doc = inspect.getdoc(VALUES[name]) or ""
    said = described(doc, "Args")
    for given in inspect.signature(VALUES[name]).parameters.values():
        assert given.name in said, f"{name} doesn't say what {given.name} is"
        if is_quantity(given.annotation):
            assert UNIT.search(said[given.name]), f"{name} has no unit for {given.name}"
    assert "Raises:\n" in doc, f"{name} doesn't say what it raises"
    assert ">>> " in doc, f"{name} has no example"


@pytest.mark.parametrize("name", CLASSES)
def test_a_class_says_what_its_values_are_in_which_unit_and_is_shown(name: str) -> None:
    doc = inspect.getdoc(VALUES[name]) or ""
    said = described(doc, "Attributes") | described(doc, "Args")
    for field, annotation in fields_of(VALUES[name]):
        assert field in said, f"{name} doesn't say what {field} is"
        if is_quantity(annotation):
            assert UNIT.search(said[field]), f"{name} has no unit for {field}"
    assert name in MADE_BY_VERBS or ">>> " in doc, f"{name} has no example"


@pytest.mark.parametrize("name", CLASSES)
def test_every_public_method_has_a_docstring(name: str) -> None:
    for method, value in inspect.getmembers(VALUES[name], inspect.isroutine):
        if not method.startswith("_") and (value.__module__ or "").startswith("viaspline"):
            assert inspect.getdoc(value), f"{name}.{method} has no docstring"


def test_a_section_that_says_nothing_of_a_value_is_noticed() -> None:
    doc = "A thing.\n\nAttributes:\n    one, two: Lengths\n        [m].\n    three: A number.\n"
    assert described(doc, "Attributes").keys() == {"one", "two", "three"}
    assert UNIT.search(described(doc, "Attributes")["two"])
    assert not UNIT.search(described(doc, "Attributes")["three"])
