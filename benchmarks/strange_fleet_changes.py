"""The least change that a fleet's files name for a robot that isn't served, done as it is told."""

from __future__ import annotations

import copy
import re
from collections.abc import Callable
from typing import Any

Change = Callable[[dict[str, Any], "re.Match[str]"], None]


def _member(data: dict[str, Any], name: str) -> dict[str, Any]:
    return next(one for one in data["fleet"] if one["name"] == name)


def _priority(data: dict[str, Any], words: re.Match[str]) -> None:
    _member(data, words[1])["priority"] = float(words[2])


def _depart(data: dict[str, Any], words: re.Match[str]) -> None:
    _member(data, words[1])["depart_s"] = float(words[2])


def _leave(data: dict[str, Any], words: re.Match[str]) -> None:
    _member(data, words[1])["rest"] = "leave"


def _move(data: dict[str, Any], words: re.Match[str]) -> None:
    _member(data, words[2])["route"][words[1]]["at"] = [float(words[3]), float(words[4])]


def _separation(data: dict[str, Any], words: re.Match[str]) -> None:
    data["separation_m"] = float(words[1])


def _without(data: dict[str, Any], words: re.Match[str]) -> None:
    data["fleet"] = [one for one in data["fleet"] if one["name"] != words[1]]


CHANGES: dict[str, Change] = {
    r"give '(.*)' priority (\S+)": _priority,
    r"let '(.*)' depart at (\S+) s \(depart_s\)": _depart,
    r"let '(.*)' leave \(rest: leave\)": _leave,
    r"move the (start|goal) of '(.*)' to \((\S+), (\S+)\)": _move,
    r"ask for a separation of (\S+) m \(separation_m\)": _separation,
    r"leave '(.*)' out": _without,
}


def changed(data: dict[str, Any], remedy: str) -> dict[str, Any] | None:
    """The fleet as a remedy wants it; None where that names no change that can be told apart."""
    for words, change in CHANGES.items():
        if found := re.fullmatch(words, remedy):
            other = copy.deepcopy(data)
            change(other, found)
            return other
    return None
