"""What a robot does about something new: goes on, goes round it, or stops."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.detour import replan
from viaspline.detour.detoured import Detoured
from viaspline.detour.fit import CLEAR, too_close
from viaspline.errors import NoPathError
from viaspline.mission.parts import Obstacle
from viaspline.robot.journey import SLIP, Journey, time_law
from viaspline.robot.run import Event, Mode, Replan
from viaspline.trajectory.retime import braking
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World


@dataclass(frozen=True)
class _Choice:
    """A way on: how it was found, where the robot turns on the spot, and when it is where."""

    mode: Mode
    found: Detoured
    turns: tuple[float, ...]
    law: Trajectory


@dataclass(frozen=True)
class _Scene:
    """A robot under way, and what it has just seen.

    Attributes:
        journey: With the new obstacles in its world already.
        new: The new obstacles alone.
        names: What they are called.
        free_until: Up to this distance along the path it is certainly clear of them [m].
        speed: At this moment [m/s].
        stop: Where the robot stands if it brakes now, as a distance along the path [m].
        leaves: Where a new path may leave this one without a stop, the nearest place first [m].
    """

    journey: Journey
    new: World
    names: tuple[str, ...]
    free_until: float
    speed: float
    stop: float
    leaves: tuple[float, ...]

    def is_clear(self, place: float) -> bool:
        """Whether the path keeps its clearance from what is new up to a place."""
        path, required = self.journey.path, self.journey.brief.required
        if place < self.free_until:
            return True
        if place - self.free_until <= SLIP:
            point = np.asarray(path.at_distance(place))
            return float(self.new.distance(point)) >= required - SLIP
        first, last = np.asarray(path.parameter(np.array([self.free_until, place]))).tolist()
        return _first_conflict(path.section(first, last), self.new, required) is None

    def may_leave(self, place: float) -> bool:
        """Whether a new path can leave this one at a place while the robot rolls on."""
        turning = any(abs(turn - place) <= SLIP for turn in self.journey.turns)
        return not turning and self.is_clear(place)


def notice(journey: Journey, obstacles: Sequence[Obstacle]) -> Journey:
    """The journey of a robot that has just seen these obstacles for the first time."""
    old = len(journey.world)
    world = journey.world.with_obstacles(obstacles)
    names = tuple(world.name(old + i) for i in range(len(obstacles)))
    here = journey.place(journey.distance)
    new = World(obstacles)
    gaps = [float(new.distances_to(i, here)) for i in range(len(obstacles))]
    journey = replace(journey, world=world, seen=journey.seen.union(obstacles)).noted(
        *(
            Event("detected", journey.time, here, f"sees '{name}' {gap:.1f} m away", {"name": name})
            for name, gap in zip(names, gaps, strict=True)
        )
    )
    if journey.finished or journey.giving_up is not None:
        return journey
    free_until = _free_until(journey, new)
    if free_until is None:
        return journey
    began = clock.perf_counter()
    journey = _answer(_scene(journey, new, names, free_until))
    spent = clock.perf_counter() - began
    return replace(journey, compute_times=(*journey.compute_times, spent))


def _free_until(journey: Journey, new: World) -> float | None:
    """Start of the first span ahead that is not clear of what is new [m]; None if all are."""
    path = journey.path
    if journey.distance >= path.length - SLIP:
        return None
    u = float(path.parameter(journey.distance))
    ahead = path.section(u, path.domain[1])
    first = _first_conflict(ahead, new, journey.brief.required)
    if first is None:
        return None
    if first == 0:
        return journey.distance
    return float(path.distance(float(math.floor(u) + first)))


def _first_conflict(curve: PiecewiseCubic, world: World, required: float) -> int | None:
    """Index of the first span that comes nearer to a world than required, if one does."""
    blocked = np.flatnonzero(too_close(world, curve.spans, required) != CLEAR)
    return int(blocked[0]) if blocked.size else None


def _scene(journey: Journey, new: World, names: tuple[str, ...], free_until: float) -> _Scene:
    here = journey.distance
    speed = 0.0 if journey.dwell is not None else float(journey.law.state_at(journey.time)[1])
    rest = here if journey.dwell is not None else journey.law.next_rest(here + SLIP)
    stop = min(here + speed * speed / (2.0 * journey.limits.max_accel), rest)
    wait = speed * journey.reaction
    leaves = {min(here + wait, rest): None}
    if journey.limits.max_lateral_accel is not None:
        leaves[min(stop + wait, rest)] = None  # there it may be slow enough for a sharper bend
    return _Scene(journey, new, names, free_until, speed, stop, tuple(leaves))


def _answer(scene: _Scene) -> Journey:
    """A new path if there is one; otherwise the robot brakes and stays where it comes to stand."""
    if not scene.is_clear(scene.stop):
        return _give_up(scene, _too_late(scene))
    skip, reason = _covered(scene)
    if reason is not None:
        return _give_up(scene, reason)
    while True:
        try:
            return _take(scene, _find(scene, frozenset(skip)), skip)
        except NoPathError as error:
            lost = _lost(scene, skip, error)
            if lost is None:
                return _give_up(scene, str(error))
            skip[lost] = error.reason


def _too_late(scene: _Scene) -> str:
    distance, nearest = scene.new.nearest(scene.journey.path.at_distance(scene.stop))
    name, brief = scene.names[int(nearest)], scene.journey.brief
    gap = f"{float(distance) - brief.radius:.2f} m"
    inside = f"inside the clearance of {brief.clearance:g} m that it has to keep"
    if scene.speed == 0.0:
        return f"the robot stands {gap} from '{name}', {inside}"
    return (
        f"'{name}' appeared inside the braking distance; the robot comes to stand {gap} from it, "
        f"{inside}"
    )


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


def _lost(scene: _Scene, skip: Mapping[int, str], error: NoPathError) -> int | None:
    """Index of the point that an error says can't be reached, if the robot may go on without."""
    path = scene.journey.path
    for via, at in scene.journey.ahead:
        is_goal = via.u >= path.domain[1] - 1e-9
        if via.name == error.via and at > scene.stop + SLIP and not is_goal:
            return via.index if via.index not in skip else None
    return None


def _find(scene: _Scene, skip: frozenset[int]) -> _Choice:
    """The first of: reflex, planned, from rest.

    Raises:
        NoPathError: If there is no way to the goal.
    """
    path, world, brief = scene.journey.path, scene.journey.world, scene.journey.brief
    leaves = [leave for leave in scene.leaves if scene.may_leave(leave)]
    modes: tuple[Mode, ...] = ("planned",) if skip else ("reflex", "planned")
    for mode in modes:
        for leave in leaves:
            try:
                if mode == "reflex":
                    found = replan.reflex(path, leave, world, brief)
                else:
                    found = replan.planned(path, leave, world, brief, skip=skip)
            except NoPathError:
                continue  # a robot that leaves later, or that stands, may find a way
            choice = _timed(scene, mode, found)
            if choice.law.over_limit_until is None:
                return choice
    return _timed(scene, "from_rest", replan.from_rest(path, scene.stop, world, brief, skip=skip))


def _timed(scene: _Scene, mode: Mode, found: Detoured) -> _Choice:
    journey = scene.journey
    turns = tuple(turn for turn in journey.turns if turn <= found.changed_from + SLIP)
    if mode == "from_rest":
        turns = (*turns, scene.stop)
    law = time_law(
        journey, found.path, turns,
        distance=journey.distance, speed=scene.speed, time=journey.time,
    )  # fmt: skip
    return _Choice(mode, found, turns, law)


def _take(scene: _Scene, choice: _Choice, skip: Mapping[int, str]) -> Journey:
    """Go over to a new path."""
    journey, path = scene.journey, choice.found.path
    if path is journey.path:
        return journey
    now = journey.place(journey.distance)
    names = {via.index: via.name for via, _ in journey.ahead}
    events = [
        Event("skipped", journey.time, now, f"gives up '{names[index]}': {why}")
        for index, why in sorted(skip.items())
    ]
    if choice.mode == "from_rest" and scene.speed > 0.0:
        events.append(Event("braked", journey.time, now, "brakes, to leave from rest"))
    message = f"goes round {_list(scene.names)} on a {choice.mode.replace('_', ' ')} path"
    events.append(Event("replanned", journey.time, now, message, {"mode": choice.mode}))
    return replace(
        journey.noted(*events),
        path=path,
        law=choice.law,
        turns=choice.turns,
        skipped=journey.skipped + tuple(sorted(skip.items())),
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
    """How far two paths are apart where one leaves the other: in place, heading and curvature.

    The new one is compared with the old one as that would have gone on. So a jump that the
    old one has at a via point anyway doesn't count.

    Returns:
        [m], [rad], [1/m].
    """
    before, after = _going_on(old, at), _going_on(new, at)
    gap = float(np.linalg.norm(np.asarray(after[0]) - np.asarray(before[0])))
    return gap, abs(math.remainder(after[1] - before[1], math.tau)), abs(after[2] - before[2])


def _going_on(path: Path, at: float) -> tuple[object, float, float]:
    """Position, heading and curvature just after a place."""
    u, end = float(path.parameter(at)), path.domain[1]
    nearest = round(u)
    if abs(u - nearest) < 1e-9 and nearest < end:
        u = float(nearest)  # the side after the joint, whatever the rounding says
    return path.evaluate(u), float(path.heading(u)), float(path.curvature(u))


def _list(names: Sequence[str]) -> str:
    return ", ".join(f"'{name}'" for name in names)
