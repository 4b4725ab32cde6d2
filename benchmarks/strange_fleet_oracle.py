"""What the written files of a fleet have to keep, told without the planner.

``fleet.json`` and the ``plan.json`` of each robot are held against the fleet as it was written:
curves are measured by Gauss's rule and sampled every 10 ms by their laws, bodies are circles about
a place, balls or upright cylinders. Nothing of the planner is imported. Each fault is a word for
its kind and a sentence.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from itertools import pairwise
from typing import Any

import numpy as np
from strange_flight_oracle import Upright
from strange_oracle import Faults

TICK_S = 0.01
PIECE_M = 0.02
SLACK_M = 1e-4
LOOSE_M = 0.05
GAUSS = np.polynomial.legendre.leggauss(4)


class Curve:
    """Exact cubics by how far along them something is.

    Args:
        spans: Bézier polygons, (n, 4, dim) [m].
    """

    def __init__(self, spans: np.ndarray) -> None:
        self.spans = spans
        of, begin, end, along, done = [], [], [], [], 0.0
        for k, polygon in enumerate(spans):
            reach = np.linalg.norm(np.diff(polygon, axis=0), axis=1).sum()
            u = np.linspace(0, 1, max(8, math.ceil(reach / PIECE_M)) + 1)
            mid, half = 0.5 * (u[1:] + u[:-1]), 0.5 * np.diff(u)
            at = mid[:, None] + half[:, None] * GAUSS[0]
            speed = np.linalg.norm(self._first(np.full(at.size, k), at.ravel()), axis=1)
            gone = half * (speed.reshape(at.shape) * GAUSS[1]).sum(axis=1)
            of.append(np.full(len(mid), k))
            begin.append(u[:-1])
            end.append(u[1:])
            along.append(done + np.concatenate([[0.0], np.cumsum(gone)[:-1]]))
            done += float(gone.sum())
        self.of, self.begin, self.end, self.along = map(np.concatenate, (of, begin, end, along))
        self.length = done

    def _first(self, of: np.ndarray, u: np.ndarray) -> np.ndarray:
        a, b, c, d = self.spans[of].transpose(1, 0, 2)
        u = u[:, None]
        return 3 * ((1 - u) ** 2 * (b - a) + 2 * (1 - u) * u * (c - b) + u**2 * (d - c))

    def at(self, along: np.ndarray) -> np.ndarray:
        """Places (n, 3) at distances [m]."""
        k = np.clip(np.searchsorted(self.along, along, side="right") - 1, 0, len(self.of) - 1)
        ends = np.append(self.along[1:], self.length)
        share = (along - self.along[k]) / np.maximum(ends[k] - self.along[k], 1e-12)
        u = (self.begin[k] + np.clip(share, 0, 1) * (self.end[k] - self.begin[k]))[:, None]
        a, b, c, d = self.spans[self.of[k]].transpose(1, 0, 2)
        v = 1 - u
        places = v**3 * a + 3 * v**2 * u * b + 3 * v * u**2 * c + u**3 * d
        return np.column_stack([places, np.zeros((len(places), 3 - places.shape[1]))])


@dataclass(frozen=True)
class Robot:
    """One robot of a fleet by its files.

    Attributes:
        name: Its name.
        data: Its mission as it would stand in a file.
        plan: Its ``plan.json``; None if it isn't served.
        leaves: Whether it leaves at its goal.
        flies: Whether it is in space.
        stands: Where it stands if it isn't served (3,) [m].
    """

    name: str
    data: dict[str, Any]
    plan: dict[str, Any] | None
    leaves: bool
    flies: bool
    stands: np.ndarray

    @property
    def body(self) -> Upright:
        """What counts as its body beside others."""
        robot = self.data["robot"]
        if self.flies:
            return Upright.of(robot)
        corners = robot.get("footprint")
        radius = robot.get("radius_m", 0.5)
        return Upright(max((math.hypot(*at) for at in corners), default=0.0)
                       if corners else radius, 0.0, 0.0)  # fmt: skip

    @cached_property
    def curve(self) -> Curve:
        assert self.plan is not None
        return Curve(np.array(self.plan["path"]["spans"], float))

    @property
    def law(self) -> dict[str, Any]:
        assert self.plan is not None
        return self.plan["trajectory"]["law"]

    @property
    def has_even_law(self) -> bool:
        """Whether its law goes evenly between its nodes."""
        return not any(self.law.get("changes_1ps2", ())) and not any(self.law.get("jerks_mps3", ()))

    def comes_to(self, place: float) -> float:
        """When it comes to a place along its path [m], or a little sooner [s]."""
        along = np.array(self.law["distances_m"], float)
        return float(self.law["times_s"][max(int(np.searchsorted(along, place)) - 1, 0)])

    def goes_from(self, place: float) -> float:
        """When it goes on from a place along its path [m], or a little later [s]."""
        along = np.array(self.law["distances_m"], float)
        k = min(int(np.searchsorted(along, place, side="right")), len(along) - 1)
        return float(self.law["times_s"][k])

    def along(self, times: np.ndarray) -> np.ndarray:
        """How far it has come by its law [m]."""
        t, s, v, a = (np.array(self.law[key], float) for key in (
            "times_s", "distances_m", "speeds_mps", "accelerations_mps2"))  # fmt: skip
        k = np.clip(np.searchsorted(t, times, side="right") - 1, 0, len(a) - 1)
        since = np.clip(times, t[0], t[-1]) - t[k]
        return np.where(times >= t[-1], s[-1], s[k] + v[k] * since + 0.5 * a[k] * since**2)

    def places(self, times: np.ndarray, along: np.ndarray | None = None,
               gone: float | None = None) -> np.ndarray:  # fmt: skip
        """Where it is at times, (n, 3); nan where it has left."""
        if self.plan is None:
            return np.broadcast_to(self.stands, (len(times), 3))
        found = self.curve.at(self.along(times) if along is None else along)
        if self.leaves:
            ends = self.law["times_s"][-1] if gone is None else gone
            found[times > ends + 1e-9] = np.nan
        return found


def gaps(one: Robot, other: Robot, offset: np.ndarray) -> np.ndarray:
    """Free space between two bodies that are so far off each other [m]."""
    a, b = one.body, other.body
    both = Upright(a.radius + b.radius, a.half + b.half, a.margin + b.margin)
    return both.free(np.hypot(offset[:, 0], offset[:, 1]), np.abs(offset[:, 2]))


def nearest(
    robots: list[Robot], places: dict[str, np.ndarray], times: np.ndarray
) -> tuple[float, str, str, float]:
    """The least gap of two robots one of which has a plan, who they are, and when [m, s]."""
    found = (math.inf, "", "", 0.0)
    for k, one in enumerate(robots):
        for other in robots[:k]:
            if one.plan is None and other.plan is None:
                continue
            gap = gaps(one, other, places[one.name] - places[other.name])
            gap = np.where(np.isnan(gap), np.inf, gap)
            i = int(gap.argmin())
            if gap[i] < found[0]:
                found = (float(gap[i]), one.name, other.name, float(times[i]))
    return found


def fleet_faults(data: dict[str, Any], robots: list[Robot], told: dict[str, Any]) -> Faults:
    """What a written fleet doesn't keep, or says otherwise than it is."""
    yield from listed_faults(data, robots, told)
    yield from proof_faults(data, robots, told)
    yield from order_faults({one.name: one for one in robots}, told)


def listed_faults(data: dict[str, Any], robots: list[Robot], told: dict[str, Any]) -> Faults:
    """Who is served and who isn't, and when they come."""
    names = [one["name"] for one in data["fleet"]]
    if [one["name"] for one in told["robots"]] != names:
        yield "listed", f"{[one['name'] for one in told['robots']]} instead of {names}"
    out = {one["name"] for one in told["robots"] if one["plan"] is None}
    refused = {one["name"] for one in told["refused"]}
    if out != refused or told["served"] != (not out):
        yield "listed", f"{out} have no plan, {refused} are told of; served {told['served']}"
    for one in told["refused"]:
        if not one["reason"] or not one["remedy"]:
            yield "reason", f"{one['name']} without a reason or a remedy: {one}"
        if one["in_the_way"] and one["at"] is None:
            yield "reason", f"{one['name']} isn't told where {one['in_the_way']} is: {one}"
    by_name = {one.name: one for one in robots}
    for one in told["robots"]:
        if one["plan"] is None:
            continue
        robot = by_name[one["name"]]
        law = robot.law
        asked = robot.data["route"].get("depart_s", 0.0)
        if abs(one["departs_s"] - law["times_s"][0]) > 1e-9 or one["departs_s"] < asked - 1e-9:
            yield "depart", f"{one['name']} at {one['departs_s']} s, {asked} asked"
        if abs(one["arrives_s"] - law["times_s"][-1]) > 1e-9:
            yield "arrive", f"{one['name']}: {one['arrives_s']} and {law['times_s'][-1]} s"
        late = one["arrives_s"] - asked - one["alone_s"]
        if abs(max(late, 0.0) - one["late_s"]) > 1e-6:
            yield "late", f"{one['name']}: {one['late_s']} s told, {late} reckoned"
        if late < -1e-3 and not told.get("patrols"):
            yield "late", f"{one['name']} comes {-late:.4f} s sooner than alone"
        if abs(robot.curve.length - one["length_m"]) > 1e-4 * (1 + one["length_m"]):
            yield "length", f"{one['name']}: {robot.curve.length} and {one['length_m']} m"


def proof_faults(data: dict[str, Any], robots: list[Robot], told: dict[str, Any]) -> Faults:
    """Robots nearer than is proven, or than is asked, by samples."""
    proof = told["certificate"]
    if not proof["holds"]:
        yield "holds", f"the proof doesn't: {proof}"
    driven = [one for one in robots if one.plan is not None and one.has_even_law]
    if len(driven) != sum(one.plan is not None for one in robots):
        return
    if abs(proof["required_separation_m"] - data["separation_m"]) > 1e-12:
        yield "required", f"{proof['required_separation_m']} m, {data['separation_m']} asked"
    end = max((one.law["times_s"][-1] for one in driven), default=0.0)
    times = np.arange(-0.5, end + 0.5, TICK_S)
    places = {one.name: one.places(times) for one in robots}
    least, one, other, when = nearest(robots, places, times)
    if least < data["separation_m"] - SLACK_M:
        yield "too near", f"{one} and {other} {least:.4f} m apart at {when:.2f} s"
    if not driven:
        return
    if proof["separation_m"] is None:
        if least < 1e3:
            yield "proof", f"says nothing; {one} and {other} come to {least:.4f} m"
        return
    if least < proof["separation_m"] - SLACK_M:
        yield "proof", (f"{proof['separation_m']:.5f} m proven, {one} and {other} {least:.5f} m "
                        f"apart at {when:.2f} s")  # fmt: skip
    exact = all(not {"drive", "localization", "tracking_error_m"} & one.data["robot"].keys()
                for one in robots)  # fmt: skip
    if exact and least > proof["separation_m"] + LOOSE_M:
        yield "loose", f"{least:.4f} m sampled, {proof['separation_m']:.4f} m proven: {proof}"


def order_faults(robots: dict[str, Robot], told: dict[str, Any]) -> Faults:
    """Orders of robots that have no plan, or that go round in a circle.

    Whether laws keep them is seen by how far apart robots are. A second that follows a first
    through a crossing, and enters it before that one has left it, is told of by its ends as well:
    between these it waits for it piece by piece.
    """
    marks: dict[str, set[float]] = {}
    after: dict[tuple[str, float], set[tuple[str, float]]] = {}
    for one in told["precedences"]:
        first, second = robots.get(one["first"]), robots.get(one["second"])
        if first is None or second is None or first.plan is None or second.plan is None:
            yield "order", f"of robots without plans: {one}"
            continue
        if second.comes_to(one["enters_at_m"]) < first.goes_from(one["leaves_at_m"]):
            continue  # it follows the first one through the crossing
        marks.setdefault(first.name, set()).add(one["leaves_at_m"])
        marks.setdefault(second.name, set()).add(one["enters_at_m"])
        entering, leaving = (second.name, one["enters_at_m"]), (first.name, one["leaves_at_m"])
        after.setdefault(entering, set()).add(leaving)
        if one["waits_s"] < 0:
            yield "order", f"waits less than nothing: {one}"
    for name, places in marks.items():
        for before, behind in pairwise(sorted(places)):
            after.setdefault((name, behind), set()).add((name, before))
    try:
        list(TopologicalSorter(after).static_order())
    except CycleError as error:
        yield "circle", f"{error.args[1]}"


def driven_faults(
    data: dict[str, Any], robots: list[Robot], run: dict[str, Any],
    distance_at: Callable[[str, np.ndarray], np.ndarray],
) -> Faults:  # fmt: skip
    """What a simulated drive doesn't keep: ``run.json``, and how far robots had come when."""
    served = [one for one in robots if one.plan is not None]
    if run["deadlock"] or not run["reached"]:
        yield "deadlock", f"of {run['deadlock']}, reached {run['reached']}"
    if not run["certificate"]["holds"]:
        yield "run holds", f"{run['certificate']}"
    arrived = {one["name"]: one["arrived_s"] for one in run["robots"]}
    times = np.arange(-0.5, run["duration_s"] + 0.5, TICK_S)
    places = {}
    for one in robots:
        if one.plan is None:
            places[one.name] = one.places(times)
            continue
        along = distance_at(one.name, times)
        asked = one.data["route"].get("depart_s", 0.0)
        if along[times < asked - TICK_S].max(initial=0.0) > 1e-6:
            yield "run depart", f"{one.name} sets out before {asked} s"
        speed = np.diff(along) / TICK_S
        if not one.has_even_law:  # told by its nodes there, between which it goes otherwise
            speed = np.zeros(1)
        if speed.min() < -1e-6:
            yield "run back", f"{one.name} goes back"
        if speed.max() > one.data["robot"]["max_speed_mps"] * (1 + 1e-3) + 1e-4:
            yield "run speed", f"{one.name} at {speed.max():.4f} m/s"
        places[one.name] = one.places(times, along, arrived.get(one.name) or math.inf)
    if not served:
        return
    home = {one["name"] for one in run["robots"]}
    robots = [one for one in robots if one.name in home]  # who has no path plays no part
    least, name, other, when = nearest(robots, places, times)
    if least < data["separation_m"] - SLACK_M:
        yield "contact", f"{name} and {other} {least:.4f} m apart at {when:.2f} s in a drive"
    told = run["certificate"]["separation_m"]
    if told is not None and least < told - SLACK_M:
        yield "run proof", f"{told:.5f} m proven, {name} and {other} {least:.5f} m at {when:.2f} s"
