"""What was flown in space.

Tested through ``space/online/test_fly``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.presentable.compared_by_value import ComparedByValue
from viaspline.presentable.moving_value import MovingValue
from viaspline.presentable.named_columns import Table, coordinates, named_columns
from viaspline.presentable.saved_value import SavedValue
from viaspline.presentable.shown_value import ShownValue
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.tracks.encountered import Encounters, told_in_short


@dataclass(frozen=True, eq=False)
class SpatialReplan(ComparedByValue):
    """Another path under way.

    Attributes:
        seen_at: When something was seen in the way [s].
        time: When the new path began [s]; when the robot stopped, if there was none.
        obstacles: What was seen.
        path: The new path; None where none was found.
        stopped: Whether the robot stopped first.
    """

    seen_at: float
    time: float
    obstacles: tuple[str, ...]
    path: Path | None
    stopped: bool


@dataclass(frozen=True, eq=False)
class SpatialRun(ShownValue, MovingValue, SavedValue, ComparedByValue):
    """What was flown: exactly along the path, by a point that follows its time law.

    Attributes:
        plan: What it began with.
        times: [s], shape (n,).
        positions: Of the reference point [m], shape (n, 3).
        headings: Of the body [rad], shape (n,).
        speeds: Along the path [m/s], shape (n,).
        climbs: Upward [m/s], shape (n,).
        replans: Where the path was changed.
        clearance: Proven free space between the body and everything that stands, seen or not, or
            moves as the map says, on all that was flown; while it takes off and lands, the ground
            doesn't count [m].
        reached: Whether it came to its goal.
        reason: Why not; empty if it did.
        encounters: How near it came to all that moves; None where what moves is on the map, and
            nothing else is reckoned with.
        broken_premises: What was seen to be faster than the mission says, or to jump, in words.
    """

    plan: SpatialPlan
    times: Floats
    positions: Floats
    headings: Floats
    speeds: Floats
    climbs: Floats
    replans: tuple[SpatialReplan, ...]
    clearance: float
    reached: bool
    reason: str = ""
    encounters: Encounters | None = None
    broken_premises: tuple[str, ...] = ()

    def __repr__(self) -> str:
        end = told_in_short(self.reached, self.reason, self.encounters)
        return (
            f"<SpatialRun: {self.duration:.1f} s, {self.least_clearance:.2f} m clear, "
            f"{len(self.replans)} re-plans, {end}>"
        )

    def samples(self) -> Table:
        """What was flown as a table over time, which pandas and polars take as it is.

        Returns:
            A structured array, (n,), of ``time_s``, ``x_m``, ``y_m``, ``z_m``, ``heading_rad`` of
            the body, ``speed_mps`` and ``climb_mps``.
        """
        return named_columns(
            {
                "time_s": self.times,
                **coordinates(self.positions),
                "heading_rad": self.headings,
                "speed_mps": self.speeds,
                "climb_mps": self.climbs,
            }
        )

    @property
    def least_clearance(self) -> float:
        """Proven free space to everything, moving or not [m]; below 0 where something touched."""
        met = self.encounters
        return self.clearance if met is None else min(self.clearance, met.clearance)

    @property
    def duration(self) -> float:
        """[s]."""
        return float(self.times[-1] - self.times[0])
