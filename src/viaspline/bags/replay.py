"""Drives a navigator again on what a bag says that it was given, and compares what it decides."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from viaspline.bags.drive_recorder import (
    ABOUT,
    MISSION_FILE_NAME,
    PERIOD_KEY,
    REACTION_KEY,
    VERSION_KEY,
)
from viaspline.bags.mission_json import mission_from, obstacle_from
from viaspline.bags.own_messages import STEP, STEP_TOPIC, TOLD, TOLD_TOPIC, bag_book
from viaspline.bags.raw_message import BagExtent
from viaspline.bags.rosbag2_reader import read_bag
from viaspline.bags.step_message import decision_message, given_from
from viaspline.errors import BagError, MissionError, ViasplineError
from viaspline.handed_in import finite_from
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planner import plan
from viaspline.robot.navigator import Navigator

TOLERANCE: Final = 1e-9
"""What numbers may differ by, as a part of 1 and of themselves: processors round differently."""


@dataclass(frozen=True)
class Difference:
    """Where a navigator decides otherwise.

    Attributes:
        step: Which step, from 1.
        time: When [s].
        what: Of what it decides, such as ``command.speed``.
        recorded: What the bag has there.
        now: What it decides now.
    """

    step: int
    time: float
    what: str
    recorded: str
    now: str


@dataclass(frozen=True)
class Replayed:
    """A drive that was driven again.

    Attributes:
        steps: How many steps.
        until: The time of the last of them [s].
        difference: The first in which it decides otherwise; None: there is none.
        damage: Why the bag ends before its end; None: it doesn't.
        version: Of viaspline, which recorded it.
    """

    steps: int
    until: float
    difference: Difference | None
    damage: str | None
    version: str


def replay(
    path: str | Path,
    *,
    tolerance: float = TOLERANCE,
    tell: Callable[[int, float], None] | None = None,
) -> Replayed:
    """Drive again what a bag of viaspline's holds, up to the first step that is decided otherwise.

    A bag that is cut short is driven as far as it is whole.

    Args:
        path: The bag.
        tolerance: What numbers may differ by, as a part of 1 and of themselves.
        tell: Called after every step with its number and its time [s].

    Raises:
        BagError: It isn't a bag of viaspline's, holds no step, or its steps contradict each other.
        OutputError: The extra isn't installed.
        GeometryError: The tolerance isn't finite.
        PlanningError, MissionError: Its mission can't be planned any more.
    """
    path, tolerance = Path(path), finite_from("tolerance", tolerance)
    book, extent = bag_book(), BagExtent()
    obstacles: dict[int, Obstacle] = {}
    nav: Navigator | None = None
    steps, until, difference = 0, 0.0, None
    kinds = {STEP_TOPIC: STEP, TOLD_TOPIC: TOLD}
    for raw in read_bag(path, lambda topic, kind: kinds.get(topic) == kind, extent):
        try:
            message = book.decoded(kinds[raw.topic], raw.data)
            if raw.topic == TOLD_TOPIC:
                obstacles[message["number"]] = obstacle_from(message["obstacle"])
                continue
            nav = nav or _at_start(path, extent)
            until, steps = message["time"], steps + 1
            difference, nav = _again(nav, message, obstacles, steps, tolerance)
        except (KeyError, ValueError) as error:
            problem = f"its step {steps} makes no sense: {error}; record it again"
            raise BagError(path, problem) from error
        if difference is not None:
            break
        if tell is not None:
            tell(steps, until)
    if not steps:
        raise BagError(path, _nothing(extent))
    version = extent.notes[ABOUT].get(VERSION_KEY, "unknown")
    return Replayed(steps, until, difference, extent.damage, version)


def _at_start(path: Path, extent: BagExtent) -> Navigator:
    """The navigator before its first step."""
    if MISSION_FILE_NAME not in extent.attachments or ABOUT not in extent.notes:
        raise BagError(
            path, f"lacks {MISSION_FILE_NAME}, without which nothing can be driven again"
        )
    try:
        mission = mission_from(extent.attachments[MISSION_FILE_NAME].decode())
    except MissionError as error:
        problem = f"its mission is none for this version of viaspline: {error}"
        raise BagError(path, problem) from error
    about = extent.notes[ABOUT]
    planned = plan(mission)
    return Navigator(
        planned.mission, planned,
        reaction=float(about[REACTION_KEY]), period=float(about[PERIOD_KEY]),
    )  # fmt: skip


def _again(
    nav: Navigator,
    message: Mapping[str, Any],
    obstacles: Mapping[int, Obstacle],
    step: int,
    tolerance: float,
) -> tuple[Difference | None, Navigator]:
    """A step once more: how what is decided differs, and the navigator after it."""
    given = given_from(message, obstacles)
    try:
        command, nav = nav.step(given.state, given.sensed, given.time)
    except ViasplineError as error:
        return Difference(step, given.time, "the step", "a command", f"refused: {error}"), nav
    now = decision_message(command, nav)
    recorded = {name: message[name] for name in now}
    found = differs(recorded, now, tolerance)
    if found is None:
        return None, nav
    what, before, after = found
    return Difference(step, given.time, what, before, after), nav


def differs(recorded: Any, now: Any, tolerance: float) -> tuple[str, str, str] | None:
    """Where two values differ: its name, and both in words; None where they don't.

    Args:
        recorded: Mappings, sequences, texts and numbers.
        now: The same, to be compared with it.
        tolerance: What numbers may differ by, as a part of 1 and of themselves.

    >>> differs({"a": [1.0, 2.0]}, {"a": [1.0, 2.5]}, 1e-9)
    ('a[1]', '2.0', '2.5')
    >>> differs({"a": float("nan")}, {"a": float("nan")}, 1e-9) is None
    True
    """
    if isinstance(recorded, Mapping):
        for name, value in recorded.items():
            found = differs(value, now[name], tolerance)
            if found is not None:
                what, before, after = found
                dot = "" if not what or what.startswith("[") else "."
                return f"{name}{dot}{what}", before, after
        return None
    if isinstance(recorded, Sequence | np.ndarray) and not isinstance(recorded, str):
        if len(recorded) != len(now):
            return "", f"{len(recorded)} of them", f"{len(now)} of them"
        for i, (one, other) in enumerate(zip(recorded, now, strict=True)):
            found = differs(one, other, tolerance)
            if found is not None:
                what, before, after = found
                dot = "" if not what or what.startswith("[") else "."
                return f"[{i}]{dot}{what}", before, after
        return None
    return None if _same(recorded, now, tolerance) else ("", _words(recorded), _words(now))


def _same(recorded: Any, now: Any, tolerance: float) -> bool:
    if not isinstance(recorded, float | np.floating):
        return bool(recorded == now)
    before, after = float(recorded), float(now)
    if math.isnan(before) or math.isnan(after):
        return math.isnan(before) and math.isnan(after)
    return before == after or abs(before - after) <= tolerance * (1.0 + abs(before))


def _words(value: Any) -> str:
    return repr(value.item() if isinstance(value, np.generic) else value)


def _nothing(extent: BagExtent) -> str:
    """Why there is nothing to be driven again."""
    if extent.damage is not None:
        return f"is damaged before its first whole step ({extent.damage}); record it again"
    if STEP_TOPIC in extent.topics or ABOUT in extent.notes:
        return "holds no step; record it again with `viaspline run --bag`"
    known = ", ".join(sorted(extent.topics)[:8]) or "no topics"
    return (
        f"was not recorded by viaspline (it has {known}): what a navigator was given and what it "
        "decided isn't in it; `viaspline run --bag` records that"
    )
