"""What was driven: the result of a simulation.

Tested through ``robot/test_simulator``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from types import MappingProxyType
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from viaspline.curve.certificate import PROOF_SLACK_M, Certificate
from viaspline.curve.path import Path
from viaspline.machine.excess import Excess, excesses
from viaspline.machine.tracking import Tracking
from viaspline.planner import Plan
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.moving_value import MovingValue
from viaspline.presentable.named_columns import Table, coordinates, named_columns
from viaspline.presentable.rounded_number import rounded
from viaspline.presentable.saved_value import SavedValue
from viaspline.presentable.shown_value import ShownValue
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.tracks.encountered import Encounters, told_in_short
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

EventKind = Literal[
    "started", "detected", "replanned", "via", "arrived", "dwell", "skipped", "braked", "stopped",
    "reached", "contact", "premise", "deviation", "lag", "slip", "stale", "pose_jump", "clock",
]  # fmt: skip
Mode = Literal["reflex", "planned", "from_rest"]

MODES: Mapping[Mode, str] = MappingProxyType(
    {
        "reflex": "under way, only the blocked spans are laid anew",
        "planned": "under way, everything ahead is laid anew",
        "from_rest": "the robot stops, and what is ahead of it is laid anew from there",
    }
)
"""What the modes of a re-plan are; the first two are the words of the paper."""


@dataclass(frozen=True)
class Event:
    """Something that happened: what, when [s], where [m], and a sentence about it."""

    kind: EventKind
    time: float
    at: tuple[float, ...]
    message: str
    data: Mapping[str, object] = field(default_factory=dict)


@dataclass(frozen=True)
class Visit:
    """How a via point of the route was served.

    Attributes:
        name: The via point.
        at: Its place [m].
        status: ``served``, ``skipped`` (it could not be reached any more) or ``failed``.
        time: When the robot was there [s]; None if it never was.
        miss: How near the driven path came when it was served [m]; None if it was not.
        reason: Why it was skipped or failed.
    """

    name: str
    at: tuple[float, ...]
    status: Literal["served", "skipped", "failed"]
    time: float | None
    miss: float | None
    reason: str | None = None


@told_in_lines
@dataclass(frozen=True)
class Replan:
    """A path that took the place of another under way.

    The modes are tried in the order of how much they change. ``reflex`` leads only the blocked
    spans ahead round what is in their way; ``planned`` lays everything ahead anew while the robot
    rolls on; ``from_rest`` has it stop first, so that it may turn on the spot, and lays anew what
    is in its way, or everything ahead where that doesn't do. The first two are the words of the
    paper for what a robot does by reflex and what by plan.

    Attributes:
        time: When [s].
        at: Where the new path leaves the old one [m].
        distance: Where that is along all that was driven [m].
        mode: How it was found: ``reflex``, ``planned`` or ``from_rest``.
        changed_from: Distance [m] along the path from which it differs.
        rejoins_at: Distance along the new path from which it is the old one again; None if never.
        obstacles: What was seen that made it necessary.
        work: What was spent on the step that found it [s of the reference machine]; so long the
            robot went on as it had meant to.
        position_jump: Between old and new at the joint [m].
        heading_jump: [rad].
        curvature_jump: [1/m].
        path: The path from then on; it contains what was driven before, but for the beginning of a
            drive of many laps.
        old_path: The path that it replaces.
        driven: Distance that was driven before both paths begin [m].
    """

    time: float
    at: tuple[float, ...]
    distance: float
    mode: Mode
    changed_from: float
    rejoins_at: float | None
    obstacles: tuple[str, ...]
    position_jump: float
    heading_jump: float
    curvature_jump: float
    path: Path
    old_path: Path
    driven: float = 0.0
    work: float = 0.0


@dataclass(frozen=True)
class Shortfall:
    """Something that the driven body came nearer to than was asked.

    It could have been known of in time if, at a moment in which the robot could still have braked
    before it was too near, its sensor could have shown the place on the surface that the body came
    nearest to: within range, within the field of view, with nothing before it. What is on the map
    is known from the start.

    Attributes:
        obstacle: What it was.
        on_map: Whether it is on the map.
        clearance: What was left between it and the body [m]; below 0 if they overlapped.
        required: What was asked for [m].
        time: When that was [s].
        at: Where the robot was then [m], shape (2,).
        surface_at: The place on its surface that was nearest [m], shape (2,).
        shown: When the sensor first could show that place [s]; None if it never could.
        needed_by: Until when the robot had to know of it, to brake before it was too near [s]; None
            if it was so from the start.
        seen_in_time: Whether it could have been known of in time.
    """

    obstacle: str
    on_map: bool
    clearance: float
    required: float
    time: float
    at: tuple[float, float]
    surface_at: tuple[float, float]
    shown: float | None
    needed_by: float | None
    seen_in_time: bool


@dataclass(frozen=True, eq=False)
class Run(ShownValue, MovingValue, SavedValue, ComparedByValue):
    """A driven mission.

    What was spent on it by the wall clock (``compute_times``) doesn't count when two are compared.

    Attributes:
        plan: The plan before the robot set off.
        world: Everything that was there, unseen obstacles too.
        reached: Whether the robot came to its goal.
        reason: Why it did not; None if it did.
        duration: [s].
        path: The curve that was driven: exactly, or of a robot with a drive within a millimetre,
            which its certificate takes off.
        certificate: The proven clearance of the driven body against everything that was there.
        times: [s], shape (n,).
        positions: [m], shape (n, d).
        headings: [rad], shape (n,).
        speeds: [m/s], shape (n,).
        curvatures: [1/m], shape (n,).
        visits: How each point of the route was served, in order.
        events: Everything that happened, in order.
        replans: Every new path, in order.
        compute_times: Wall-clock time of every re-plan [s]; it differs from run to run.
        known: What the robot knew at the end: its map, then what its sensor had shown; None: just
            its map.
        tracking: How well a robot with a drive followed its path; None for others.
        moving: All that moved, known or not.
        encounters: How near the robot came to that; None where nothing moved.
        shortfalls: What the body came nearer to than was asked, the nearest first; nothing if the
            certificate holds.
    """

    plan: Plan
    world: World
    reached: bool
    reason: str | None
    duration: float
    path: Path
    certificate: Certificate
    times: NDArray[np.float64]
    positions: NDArray[np.float64]
    headings: NDArray[np.float64]
    speeds: NDArray[np.float64]
    curvatures: NDArray[np.float64]
    visits: tuple[Visit, ...]
    events: tuple[Event, ...]
    replans: tuple[Replan, ...]
    compute_times: tuple[float, ...] = ()
    known: World | None = None
    tracking: Tracking | None = None
    moving: MovingObstacles = field(default_factory=MovingObstacles)
    encounters: Encounters | None = None
    shortfalls: tuple[Shortfall, ...] = ()

    def _said(self) -> tuple[object, ...]:
        left_out = ("compute_times",)  # by the wall clock
        return tuple(getattr(self, one.name) for one in fields(self) if one.name not in left_out)

    def __repr__(self) -> str:
        end = told_in_short(self.reached, self.reason, self.encounters)
        clear = rounded(self.least_clearance + PROOF_SLACK_M, 2)
        return f"<Run: {self.duration:.1f} s, {clear} m clear, {len(self.replans)} re-plans, {end}>"

    @property
    def least_clearance(self) -> float:
        """Proven free space to everything, moving or not [m]; below 0 where something touched."""
        met, stands = self.encounters, self.certificate.clearance
        return stands if met is None else min(stands, met.clearance)

    @property
    def excesses(self) -> tuple[Excess, ...]:
        """When the robot was farther beside its path than was kept for that, in order.

        The premise of its paths' certificates didn't hold then; that of what was driven does.
        """
        if self.tracking is None:
            return ()
        robot = self.plan.mission.robot
        reach = 0.0 if robot.footprint is None else robot.outer_radius
        return excesses(self.tracking, self.plan.tracking_error, reach)

    def samples(self) -> Table:
        """What was driven as a table over time, which pandas and polars take as it is.

        Returns:
            A structured array, (n,), of ``time_s``, ``x_m``, ``y_m`` (``z_m`` with heights),
            ``heading_rad``, ``speed_mps`` and ``curvature_1pm``; of a robot with a drive
            ``cross_track_m`` and ``along_track_m`` as well, what it was off from its path.
        """
        off = {}
        if self.tracking is not None:
            track = self.tracking
            off = {
                "cross_track_m": np.interp(self.times, track.times, track.cross_track),
                "along_track_m": np.interp(self.times, track.times, track.along_track),
            }
        return named_columns(
            {
                "time_s": self.times,
                **coordinates(self.positions),
                "heading_rad": self.headings,
                "speed_mps": self.speeds,
                "curvature_1pm": self.curvatures,
                **off,
            }
        )

    def place_at(self, time: float) -> tuple[float, ...]:
        """Where the robot was at a time [s], shape (d,)."""
        return tuple(float(np.interp(time, self.times, axis)) for axis in self.positions.T)
