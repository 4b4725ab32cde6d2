"""What each key of a mission expects, in words, and which key a mistyped one was meant to be.

The words are made of what stands beside the fields: `viaspline.mission.annotations.Expects` or, for
a model, its ``expected``; else of the type, its unit and its limits.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Sequence
from typing import Any, Literal, get_args, get_origin

from viaspline.mission.annotations import Expects, Unit
from viaspline.mission.fields import MAX_LENGTH_M
from viaspline.mission.key_places import Model, Option, keys_of, models_below, options_at
from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.unplaced_faults import LIMIT_DECIMALS, Path, number

UNIT_ENDING = re.compile(r"_(m|cm|mm|km|s|deg|rad|mps[23]?|degps2?|dps|radps)$")
"""The units that keys end in, and others that people write."""


def field_of(path: Path) -> str:
    """The last key of a path, without indices; empty for the mission itself."""
    return next((part for part in reversed(path) if isinstance(part, str)), "")


def expectation(path: Path, root: Model = MissionParts) -> str:
    """What would be right at a path.

    Args:
        path: From the root down.
        root: What the file holds: a mission, if nothing else is said.

    >>> expectation(("robot", "radius_m"))
    'a number of metres, 0 or more'
    """
    found = options_at(path, root)
    return _expected(found[0]) if found else "something else"


def _expected(option: Option) -> str:
    words = [item.words for item in option.said if isinstance(item, Expects)]
    if words:
        return words[-1]
    if option.model is not None:
        keys = f"a mapping with the keys {_list(keys_of(option.model))}"
        return option.model.key_rules.get("expected", keys)
    if get_origin(option.kind) is Literal:
        return _list(get_args(option.kind), "or")
    if option.kind in (int, float):
        return _number_words(option)
    kinds = {bool: "true or false", str: "a text of at least one letter"}
    return kinds.get(option.kind, "a list")


def _number_words(option: Option) -> str:
    """A number with its unit and its limits.

    >>> from viaspline.mission.fields import Length
    >>> from viaspline.mission.key_places import options
    >>> _number_words(options(Length)[0])
    'a number of metres, 1e-06 or more'
    """
    unit = next((item.words for item in option.said if isinstance(item, Unit)), "")
    what = "a whole number" if option.kind is int else "a number"
    what += f" of {unit}" if unit else ""
    above, least = _limit(option, "gt", max), _limit(option, "ge", max)
    below, most = _limit(option, "lt", min), _limit(option, "le", min)
    upper = "" if most is None else number(most, LIMIT_DECIMALS)
    upper = upper if below is None else f"less than {number(below, LIMIT_DECIMALS)}"
    if above is not None:
        end = f", up to {upper}" if below is None else f", {upper}"
        return f"{what} greater than {number(above, LIMIT_DECIMALS)}{end if upper else ''}"
    if least is not None:
        return f"{what}, {number(least, LIMIT_DECIMALS)} {f'to {upper}' if upper else 'or more'}"
    return f"{what} up to {upper}" if upper else what


def _limit(option: Option, name: str, tightest: Any) -> float | None:
    """The tightest of an option's limits of a kind; those of all lengths need no words."""
    given = [getattr(item, name, None) for item in option.said]
    limits = [limit for limit in given if limit is not None and abs(limit) < MAX_LENGTH_M]
    return None if not limits else float(tightest(limits))


def _list(words: Iterable[str], last: str = "and") -> str:
    """Words in a row.

    >>> _list(["a", "b", "c"]), _list(["a"])
    ('a, b and c', 'a')
    """
    *most, final = words
    return f"{', '.join(most)} {last} {final}" if most else final


def keys_at(path: Path, root: Model = MissionParts) -> tuple[str, ...]:
    """The keys that the mapping at a path may have.

    >>> keys_at(("robot", "sensor"))
    ('range_m', 'lidar', 'velocity_noise_mps')
    """
    models = [option.model for option in options_at(path, root) if option.model is not None]
    return tuple(dict.fromkeys(key for model in models for key in keys_of(model)))


def suggestion(key: str, path: Path, root: Model = MissionParts) -> tuple[str, str | None]:
    """What to do about an unknown key in the mapping at ``path``, and the key that was meant.

    >>> suggestion("raduis", ("world", "known", 0, "circle"))
    ("did you mean 'radius'?", 'radius')
    """
    known = keys_at(path, root)
    folded = key.strip().lower().replace("-", "_").replace(" ", "_")
    foreign = _foreign(folded, path, root)
    if foreign:
        ours, says_more, _ = foreign.partition(":")
        return f"write {foreign}" if says_more else f"did you mean '{foreign}'?", ours
    same = [
        name for name in known if name != folded and _without_unit(name) == _without_unit(folded)
    ]
    if same:
        return f"did you mean '{same[0]}'?", same[0]
    home = "" if folded in known else _home(folded, root)
    if home:
        return f"'{folded}' belongs under {home}", None
    near: Sequence[str] = difflib.get_close_matches(folded, known, n=1, cutoff=0.6)
    if not near:
        near = [name for name in known if folded and name.startswith(folded)]
    if near:
        return f"did you mean '{near[0]}'?", near[0]
    return "the keys here are " + ", ".join(known), None


def _foreign(key: str, path: Path, root: Model) -> str:
    """What a key of another program's is here, by ``KeyRules.foreign``; empty if nobody says.

    >>> _foreign("waypoints", ("route",), MissionParts)
    'via'
    """
    models = [option.model for option in options_at(path, root) if option.model is not None]
    said = [model.key_rules.get("foreign", {}) for model in models]
    return next((words[key] for words in said if key in words), "")


def _without_unit(key: str) -> str:
    """A key without the unit that it ends in.

    >>> _without_unit("max_speed_mps"), _without_unit("radius")
    ('max_speed', 'radius')
    """
    return UNIT_ENDING.sub("", key)


def _home(key: str, root: Model) -> str:
    """The key under which a key stands; empty if there is none."""
    return next((home for home, model in models_below(root) if key in keys_of(model)), "")
