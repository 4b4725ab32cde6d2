"""Sides that are asked for, in the words of refusals, and the changes that would free them.

Tested through ``planning/routing/test_asked_sides``.
"""

from __future__ import annotations

from collections.abc import Iterable

from viaspline.errors import Change
from viaspline.world.world import World

SIDE_KEYS = ("pass_on", "never_pass_on")
MAX_NAMED = 4  # obstacles in one sentence


def sides_in_words(world: World, indices: Iterable[int]) -> str:
    """Obstacles with the sides on which they are to be passed."""
    named = [f"{world.name(i)!r} on the {world.obstacles[i].forced_side}" for i in indices]
    more = len(named) - MAX_NAMED
    if more > 0:
        named = [*named[:MAX_NAMED], f"{more} more as asked"]
    return " and ".join(named)


def freeing_in_words(world: World, indices: Iterable[int]) -> str:
    """What lets obstacles be passed on either side."""
    keys: dict[str, list[str]] = {}
    for i in indices:
        keys.setdefault(" and ".join(_keys_of(world, i)), []).append(repr(world.name(i)))
    return " and ".join(f"drop {key} of {', '.join(names)}" for key, names in keys.items())


def changes_freeing(world: World, indices: Iterable[int]) -> tuple[Change, ...]:
    """The changes of a mission that do so."""
    return tuple(
        Change(f"world.known[{world.listed_at(i)}].{key}", None)
        for i in indices
        for key in _keys_of(world, i)
    )


def _keys_of(world: World, index: int) -> list[str]:
    return [key for key in SIDE_KEYS if getattr(world.obstacles[index], key) is not None]
