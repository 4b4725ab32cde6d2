"""What a robot does about something new: goes on, goes round it, or stops."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.certificate import certify
from viaspline.curve.path import Path
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.detour import replan
from viaspline.detour.detoured import Detoured
from viaspline.errors import NoPathError
from viaspline.mission.model import Obstacle
from viaspline.robot.journey import SLIP, Journey, time_law
from viaspline.robot.run import Event, Mode, Replan
from viaspline.trajectory.retime import braking
from viaspline.world.world import World


@dataclass(frozen=True)
class _Choice:
    """A way on: how it was found, and which points it leaves out."""

    mode: Mode
    found: Detoured
    skipped: tuple[tuple[int, str], ...]


@dataclass(frozen=True)
class _Scene:
    """A robot under way, and what it has just seen.

    Attributes:
        journey: With the new obstacles in its world already.
        new: The new obstacles alone.
        names: What they are called.
        speed: At this moment [m/s].
        stop: Where the robot stands if it brakes now, as a distance along the path [m].
        leave: Where a new path may leave this one at the earliest without a stop [m].
    """

    journey: Journey
    new: World
    names: tuple[str, ...]
    speed: float
    stop: float
    leave: float

    def is_clear(self, start: float, end: float) -> bool:
        """Whether a part of the path keeps its clearance from what is new."""
        path, brief = self.journey.path, self.journey.brief
        if end - start <= SLIP:
            place = np.asarray(path.at_distance(end))
            return bool(self.new.distance(place[None, :2])[0] >= brief.required - SLIP)
        first, last = (float(u) for u in np.asarray(path.parameter(np.array([start, end]))))
        section = path.section(first, last)
        return certify(section, self.new, brief.clearance, radius=brief.radius).holds


def notice(journey: Journey, obstacles: Sequence[Obstacle]) -> Journey:
    """The journey of a robot that has just seen these obstacles for the first time."""
    old = len(journey.world)
    world = journey.world.with_obstacles(obstacles)
    names = tuple(world.name(old + i) for i in range(len(obstacles)))
    here = journey.place(journey.distance)
    new = World(obstacles)
    gaps = [float(new.distances_to(i, [here[:2]])[0]) for i in range(len(obstacles))]
    journey = replace(journey, world=world, seen=journey.seen.union(obstacles)).noted(
        *(
            Event("detected", journey.time, here, f"sees '{name}' {gap:.1f} m away", {"name": name})
            for name, gap in zip(names, gaps, strict=True)
        )
    )
    if journey.finished or journey.giving_up is not None:
        return journey
    scene = _scene(journey, new, names)
    if scene.is_clear(journey.distance, journey.path.length):
        return journey
    began = clock.perf_counter()
    journey = _answer(scene)
    spent = clock.perf_counter() - began
    return replace(journey, compute_times=(*journey.compute_times, spent))


def _scene(journey: Journey, new: World, names: tuple[str, ...]) -> _Scene:
    here = journey.distance
    speed = 0.0 if journey.dwell is not None else float(journey.law.state_at(journey.time)[1])
    rest = here if journey.dwell is not None else journey.law.next_rest(here + SLIP)
    stop = min(here + speed * speed / (2.0 * journey.limits.max_accel), rest)
    leave = min(stop + speed * journey.reaction, rest)
    return _Scene(journey, new, names, speed, stop, leave)


def _answer(scene: _Scene) -> Journey:
    """A new path if there is one; otherwise the robot brakes and stays where it comes to stand."""
    journey = scene.journey
    if not scene.is_clear(journey.distance, scene.stop):
        gap = _gap(scene, scene.stop)
        return _give_up(
            scene,
            f"{_list(scene.names)} appeared inside the braking distance; the robot comes to stand "
            f"{gap:.2f} m from it, which is inside the clearance of {journey.brief.clearance:g} m",
        )
    covered, reason = _covered(scene)
    if reason is not None:
        return _give_up(scene, reason)
    try:
        choice = _find(scene, covered)
    except NoPathError as error:
        return _give_up(scene, str(error))
    return _take(scene, choice)


def _covered(scene: _Scene) -> tuple[dict[int, str], str | None]:
    """The points still to come that the new obstacles cover; a reason if the goal is one."""
    journey = scene.journey
    ahead = [(via, at) for via, at in journey.ahead if at > scene.stop + SLIP]
    if not ahead:
        return {}, None
    places = np.array([via.at[:2] for via, _ in ahead])
    distances, nearest = scene.new.nearest(places)
    covered: dict[int, str] = {}
    for k in np.flatnonzero(distances < journey.brief.required).tolist():
        via, name = ahead[k][0], scene.names[int(nearest[k])]
        free = float(distances[k]) - journey.brief.radius
        why = f"'{name}' leaves {free:.2f} m there, {journey.brief.clearance:g} m are needed"
        if free < 0.0:
            why = f"'{name}' covers it"
        if via.u >= journey.path.domain[1] - 1e-9:
            return {}, f"the goal '{via.name}' can't be reached any more: {why}"
        assert via.index is not None
        covered[via.index] = why
    return covered, None


def _find(scene: _Scene, covered: dict[int, str]) -> _Choice:
    """Reflex, planned, from rest; with ever fewer points if some can't be reached.

    Raises:
        NoPathError: If there is no way to the goal.
    """
    journey, skip = scene.journey, dict(covered)
    turning = any(abs(turn - scene.leave) <= SLIP for turn in journey.turns)
    rolling = not turning and scene.is_clear(journey.distance, scene.leave)
    while True:
        try:
            return _one_of_three(scene, skip, rolling)
        except NoPathError as error:
            lost = [
                via.index
                for via, at in journey.ahead
                if via.name == error.via and at > scene.stop + SLIP
                and via.index is not None and via.index not in skip
                and via.u < journey.path.domain[1] - 1e-9
            ]  # fmt: skip
            if not lost:
                raise
            skip[lost[0]] = error.reason


def _one_of_three(scene: _Scene, skip: dict[int, str], rolling: bool) -> _Choice:
    path, world, brief = scene.journey.path, scene.journey.world, scene.journey.brief
    left_out, skipped = frozenset(skip), tuple(sorted(skip.items()))
    if rolling and not skip:
        try:
            return _Choice("reflex", replan.reflex(path, scene.leave, world, brief), ())
        except NoPathError:
            pass  # the planned mode looks farther
    if rolling:
        try:
            found = replan.planned(path, scene.leave, world, brief, skip=left_out)
            return _Choice("planned", found, skipped)
        except NoPathError:
            pass  # a robot that stands can leave in any direction
    found = replan.from_rest(path, scene.stop, world, brief, skip=left_out)
    return _Choice("from_rest", found, skipped)


def _take(scene: _Scene, choice: _Choice) -> Journey:
    """Go over to a new path."""
    journey, path, at = scene.journey, choice.found.path, choice.found.changed_from
    if path is journey.path:
        return journey
    now = journey.place(journey.distance)
    turns = tuple(turn for turn in journey.turns if turn <= at + SLIP)
    skipped = dict(choice.skipped)
    names = {via.index: via.name for via, _ in journey.ahead}
    events = [
        Event("skipped", journey.time, now, f"gives up '{names[index]}': {why}")
        for index, why in choice.skipped
    ]
    if choice.mode == "from_rest":
        turns = (*turns, scene.stop)
        if scene.speed > 0.0:
            events.append(Event("braked", journey.time, now, "brakes, to leave from rest"))
    message = f"goes round {_list(scene.names)} on a {choice.mode.replace('_', ' ')} path"
    events.append(Event("replanned", journey.time, now, message, {"mode": choice.mode}))
    law = time_law(
        journey, path, turns, distance=journey.distance, speed=scene.speed, time=journey.time
    )
    return replace(
        journey.noted(*events),
        path=path,
        law=law,
        turns=turns,
        skipped=journey.skipped + tuple(skipped.items()),
        replans=(*journey.replans, _record(scene, choice)),
    )


def _give_up(scene: _Scene, reason: str) -> Journey:
    """Brake as hard as possible, and stand."""
    journey = scene.journey
    law = braking(journey.distance, scene.speed, journey.limits.max_accel, journey.time)
    if scene.speed > 0.0:
        here = journey.place(journey.distance)
        journey = journey.noted(Event("braked", journey.time, here, f"brakes: {reason}"))
    return replace(journey, law=law, dwell=None, giving_up=reason)


def _record(scene: _Scene, choice: _Choice) -> Replan:
    journey, found = scene.journey, choice.found
    at = found.changed_from
    position, heading, curvature = jumps(journey.path, found.path, at)
    return Replan(
        time=journey.time,
        at=journey.place(at),
        distance=at,
        mode=choice.mode,
        changed_from=at,
        rejoins_at=found.rejoins_at,
        obstacles=scene.names,
        position_jump=position,
        heading_jump=heading,
        curvature_jump=curvature,
        path=found.path,
        old_path=journey.path,
    )


def jumps(old: Path, new: Path, at: float) -> tuple[float, float, float]:
    """How far two paths are apart at a distance along both, in position, heading and curvature.

    The old one is taken as it comes to that place, the new one as it leaves it.

    Returns:
        [m], [rad], [1/m].
    """
    before, after = _side(old, at, arriving=True), _side(new, at, arriving=False)
    turn = math.remainder(after[1] - before[1], math.tau)
    gap = float(np.linalg.norm(np.asarray(after[0]) - np.asarray(before[0])))
    return gap, abs(turn), abs(after[2] - before[2])


def _side(path: Path, at: float, *, arriving: bool) -> tuple[object, float, float]:
    """Position, heading and curvature just before or just after a place."""
    u = float(path.parameter(at))
    first, last = path.domain
    part: PiecewiseCubic = path
    if arriving and u > first:
        part, u = path.section(first, u), math.inf
    elif not arriving and u < last:
        part, u = path.section(u, last), -math.inf
    u = min(max(u, part.domain[0]), part.domain[1])
    return part.evaluate(u), float(part.heading(u)), float(part.curvature(u))


def _gap(scene: _Scene, distance: float) -> float:
    """Free space between the body and what is new [m]."""
    place = np.asarray(scene.journey.path.at_distance(distance))
    return float(scene.new.distance(place[None, :2])[0]) - scene.journey.brief.radius


def _list(names: Sequence[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)
