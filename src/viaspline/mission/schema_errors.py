"""The structural errors that pydantic finds, said in the user's words.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final, Literal, get_args, get_origin

from pydantic import ValidationError

from viaspline.mission.fields import Point2
from viaspline.mission.key_places import Model, is_union, keys_of, options_at, path_of_error
from viaspline.mission.key_words import expectation, field_of, keys_at, suggestion
from viaspline.mission.map_spec import MapSpec
from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.unplaced_faults import (
    LIMIT_DECIMALS,
    Path,
    UnplacedFault,
    describe,
    is_number,
    number,
)

if TYPE_CHECKING:
    from pydantic_core import ErrorDetails

PAIR: Final = get_args(Point2)[0]
"""The type of a place in the plane."""

_LIMITS: Final = {
    "greater_than": ("gt", "greater than"),
    "greater_than_equal": ("ge", "not less than"),
    "less_than": ("lt", "less than"),
    "less_than_equal": ("le", "not greater than"),
}

MAX_LISTED: Final = 10
"""Length of a list up to which its items are a row of numbers, each with a meaning."""


def schema_faults(
    error: ValidationError, at: Path = (), root: Model = MissionParts
) -> list[UnplacedFault]:
    """Every error of pydantic's as a fault; one for each place and mistake.

    Args:
        error: What pydantic says.
        at: Where in the file what it was about stands.
        root: What the file holds: a mission, if nothing else is said.
    """
    details = error.errors(include_url=False)
    for detail in details:
        detail["loc"] = path_of_error((*at, *detail["loc"]), root)
    meant = {key for detail in details if (key := _meant(detail, root)) is not None}
    faults: dict[Path, UnplacedFault] = {}
    short: set[Path] = set()
    for detail in details:
        path = detail["loc"]
        if detail["type"] == "missing" and path in meant:
            continue  # The mistyped key beside it says it all.
        if _is_other_branch(detail, path, root):
            continue
        fault = _fault(detail, path, root)
        faults.setdefault(fault.path, fault)
        if detail["type"] == "too_short":
            short.add(path)
    # A list that lost its faulty items is called too short as well; it isn't.
    around = {path[:i] for path in faults for i in range(len(path))}
    return [fault for path, fault in faults.items() if path not in short or path not in around]


def _is_other_branch(detail: ErrorDetails, path: Path, root: Model) -> bool:
    """Whether this is the error of the branch of "a number or a list" that wasn't meant."""
    allowed = options_at(path, root)
    if not is_union(allowed):
        return False
    found = detail["input"]
    if detail["type"] == "literal_error":
        return not isinstance(found, str)
    if isinstance(found, str):
        has_words = any(get_origin(option.kind) is Literal for option in allowed)
        return detail["type"] == "tuple_type" or has_words
    found_list = isinstance(found, list | tuple) or hasattr(found, "tolist")
    return detail["type"] == ("float_type" if found_list else "tuple_type")


def _meant(detail: ErrorDetails, root: Model) -> Path | None:
    """The path that an unknown key was meant to be."""
    if detail["type"] != "extra_forbidden":
        return None
    *parent, key = detail["loc"]
    meant = suggestion(str(key), tuple(parent), root)[1]
    return None if meant is None else (*parent, meant)


def _fault(detail: ErrorDetails, path: Path, root: Model) -> UnplacedFault:
    kind, found = detail["type"], detail["input"]
    if kind == "value_error":  # an array that makes no map
        problem, _, remedy = str(detail["ctx"]["error"]).partition("; ")
        return UnplacedFault(path, problem, remedy or f"it should be {expectation(path, root)}")
    if kind == "extra_forbidden" or _is_hidden(path, root):
        return _unknown_key(path, root)
    if kind == "invalid_key":
        key = path[-1] if path else ""
        problem = f"the key {describe(key)} is not a text"
        return UnplacedFault(
            (*path[:-1], str(key)), problem, "keys are words such as route", at_key=True
        )
    if kind == "missing":
        return _missing(path, found, root)
    if kind in ("none_of", "two_of"):
        return _one_of(path, kind, detail["ctx"]["keys"], root)
    if kind == "finite_number":
        problem = f"{describe(found)} is not a place or a size"
        return UnplacedFault(path, problem, f"it should be {expectation(path, root)}")
    if kind in _LIMITS:
        name, words = _LIMITS[kind]
        limit = number(float(detail["ctx"][name]), LIMIT_DECIMALS)
        problem = f"{describe(found)} is out of range"
        if kind.startswith("greater") and found < 0:
            problem = f"{describe(found)} is negative"
        return UnplacedFault(path, problem, f"it should be a number {words} {limit}")
    if kind == "item_out_of_range":
        item = detail["ctx"]
        limit = number(item["limit"], LIMIT_DECIMALS)
        problem = f"{describe(item['found'])} is out of range"
        remedy = f"it should be a number between -{limit} and {limit}"
        return UnplacedFault((*path, item["place"]), problem, remedy)
    if kind == "too_long" and (most := detail["ctx"]["max_length"]) > MAX_LISTED:
        problem = f"has more than the {most} items that are taken"
        return UnplacedFault(path, problem, "take fewer, or make it several missions", at_key=True)
    if kind in ("too_short", "too_long"):
        return _wrong_length(path, found, root)
    return UnplacedFault(path, f"found {describe(found)}", _remedy(path, found, root))


def _is_hidden(path: Path, root: Model) -> bool:
    """Whether a key isn't one of a file's, though the model has such a field."""
    return not options_at(path, root) and path[-1] not in keys_at(path[:-1], root)


def _one_of(path: Path, kind: str, keys: Sequence[str], root: Model) -> UnplacedFault:
    """None or several of keys of which one is to be given."""
    both = ", ".join(keys[:-1]) + " and " + keys[-1]
    if kind == "two_of":
        name = f"{field_of(path)} " if isinstance(path[-1], str) else ""
        problem = f"{name}has {both}, which exclude each other"
        return UnplacedFault((*path, keys[0]), problem, f"keep one of {both}", at_key=True)
    return UnplacedFault(path, f"has none of {both}", f"it should be {expectation(path, root)}")


def _remedy(path: Path, found: Any, root: Model) -> str:
    expected = expectation(path, root)
    if isinstance(found, str) and "number" in expected:
        if is_number(found):
            return f"it should be {expected}: write {found.strip()} without quotes"
        if len(numbers := found.split()) > 1 and all(map(is_number, numbers)):
            return f"it should be {expected}: write commas, [{', '.join(numbers)}]"
    return f"it should be {expected}"


def _unknown_key(path: Path, root: Model) -> UnplacedFault:
    parent, key = path[:-1], str(path[-1])
    if any(option.kind is MapSpec for option in options_at(parent, root)):
        if key in keys_of(MapSpec):
            remedy = "give map, or leave it out"
            return UnplacedFault(path, "goes with a map only", remedy, at_key=True)
        if key in keys_of(Obstacle):
            remedy = "keep one of the two, or make it two obstacles"
            return UnplacedFault(path, "doesn't go with a map", remedy, at_key=True)
    return UnplacedFault(path, "unknown key", suggestion(key, parent, root)[0], at_key=True)


def _missing(path: Path, found: Any, root: Model) -> UnplacedFault:
    if isinstance(path[-1], int):
        parent = path[:-1]
        return UnplacedFault(
            parent, f"found {describe(found)}", f"it should be {expectation(parent, root)}"
        )
    return UnplacedFault(path, "is missing", f"give {path[-1]}: {expectation(path, root)}")


def _wrong_length(path: Path, found: Any, root: Model) -> UnplacedFault:
    if found == "":
        return UnplacedFault(path, "is empty", f"it should be {expectation(path, root)}")
    remedy = f"it should be {expectation(path, root)}"
    is_flat = path[:2] in (("world", "known"), ("world", "unseen"))
    is_pair = any(option.kind == PAIR for option in options_at(path, root))
    if remedy.startswith("it should be [x, y]") and _is_of_decimal_commas(found):
        x, x_decimals, y, y_decimals = found
        remedy += f"; a decimal has a point: [{x}.{x_decimals}, {y}.{y_decimals}]"
    if is_flat and is_pair and isinstance(found, list | tuple) and len(found) == 3:
        remedy += "; this shape is flat: say its heights as height_m: [low, high]"
    return UnplacedFault(path, f"found {describe(found)}", remedy)


def _is_of_decimal_commas(found: Any) -> bool:
    """Whether a list may be a pair of decimals with commas: ``[30,5, 60,2]``."""
    return (
        isinstance(found, list | tuple)
        and len(found) == 4
        and all(type(part) is int for part in found)
        and min(found[1], found[3]) >= 0
    )
