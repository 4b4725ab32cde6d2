"""How a plan drives: what a good driver would look at before saying that it is good."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from viaspline.presentable.told_in_lines import told_in_lines


@dataclass(frozen=True)
class PathPlace:
    """A place on a path.

    Attributes:
        distance: Along it [m].
        at: [m], shape (d,).
        near: The point of the route or the obstacle that it is near.
    """

    distance: float
    at: tuple[float, ...]
    near: str


@dataclass(frozen=True)
class NearCusp:
    """A stretch that bends more than the body's own circle, and turns by 120° or more.

    Attributes:
        turn: By how much it turns [rad].
        length: Of the stretch [m]; at most the turn times the body's radius.
        radius: Where it is sharpest [m].
        place: There.
    """

    turn: float
    length: float
    radius: float
    place: PathPlace


@dataclass(frozen=True)
class SpotTurn:
    """A corner or a cusp, where the robot stands and turns.

    Attributes:
        turn: By how much it turns, left is positive [rad].
        time: How long it stands [s].
        speed: With which it passes where no limit asks it to stand [m/s], else 0.
        asked: Whether ``robot.turn_on_spot`` says that it may turn there.
        place: Where.
    """

    turn: float
    time: float
    speed: float
    asked: bool
    place: PathPlace


@dataclass(frozen=True)
class Roughness:
    """A reason why a path does not drive well.

    Attributes:
        text: What is wrong.
        place: Where; None if it is so everywhere.
    """

    text: str
    place: PathPlace | None


@told_in_lines
@dataclass(frozen=True)
class Drivability:
    """How a path drives with its time law.

    Curvature is that of the exact curve, at every place where it is largest; accelerations are
    those of the time law on it, exact to a ten-thousandth.

    Attributes:
        sharpest_radius: Of the tightest bend [m]; inf if all is straight. Corners have none.
        sharpest: Where; None if all is straight.
        least_radius: What is round enough for the robot: its turning circle, else the radius of
            the smallest disc about its reference point that contains the body [m].
        max_lateral_accel: v² times curvature at its largest [m/s²].
        max_lateral_at: Where; None if it is 0.
        curvature_jumps: How often the curvature jumps by more than ``BENT_1PM`` while driving.
        largest_jump: The largest of these jumps [1/m]; 0 without any.
        largest_jump_at: Where; None without any.
        sign_changes: How often the path bends to one side by more than ``BENT_1PM`` and then to the
            other; of paths in the plane.
        near_cusps: In order.
        turns_on_spot: In order.
        reasons: Why it isn't good; none if it is.
    """

    sharpest_radius: float
    sharpest: PathPlace | None
    least_radius: float
    max_lateral_accel: float
    max_lateral_at: PathPlace | None
    curvature_jumps: int
    largest_jump: float
    largest_jump_at: PathPlace | None
    sign_changes: int
    near_cusps: tuple[NearCusp, ...]
    turns_on_spot: tuple[SpotTurn, ...]
    reasons: tuple[Roughness, ...]

    @property
    def verdict(self) -> Literal["good", "rough"]:
        """Good only if there is no reason against it.

        Good is a path that is nowhere sharper than the body, has no cusp and no turn on the spot
        that nobody asked for, and keeps every limit.

        >>> Drivability(math.inf, None, 0.5, 0.0, None, 0, 0.0, None, 0, (), (), ()).verdict
        'good'
        """
        return "rough" if self.reasons else "good"


BENT_1PM = 0.02
"""Curvature below which a path is as good as straight, and jumps that nobody feels [1/m]."""

STRAIGHT_1PM = 1e-7
"""Curvature that is rounding: a circle of that is larger than the earth [1/m]."""

NEAR_CUSP_RAD = math.radians(120)
"""A stretch that is sharper than the body's own circle is nearly a cusp if it turns so far."""
