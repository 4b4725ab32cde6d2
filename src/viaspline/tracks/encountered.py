"""What moved and touched a robot, or came near it.

Tested through ``tracks/test_encounters``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.presentable.told_in_lines import told_in_lines


@dataclass(frozen=True)
class Contact:
    """A touch of something that moves.

    Attributes:
        time: When it began [s].
        obstacle: What touched the robot, or was touched.
        robot_speed: How fast the robot was then [m/s]; 0: it stood.
        appeared_within_braking_time: Whether it couldn't be seen until the robot couldn't stop in
            time any more.
    """

    time: float
    obstacle: str
    robot_speed: float
    appeared_within_braking_time: bool = False


@dataclass(frozen=True)
class Pass:
    """Something that moves and came near to the robot without touching it.

    Attributes:
        time: When it was nearest [s].
        obstacle: What it was.
        clearance: Proven lower bound of its distance from the body at every instant [m].
        robot_speed: How fast the robot was when it was nearest [m/s]; 0: it stood.
    """

    time: float
    obstacle: str
    clearance: float
    robot_speed: float


@told_in_lines
@dataclass(frozen=True)
class Encounters:
    """How near a drive came to what moves.

    Attributes:
        clearance: Proven lower bound of the distance between the body and all of it at every
            instant [m]; infinite where nothing moved.
        time: When it was tightest [s]; None where nothing moved.
        obstacle: What was nearest then.
        contacts: Every touch, in order.
        passes: What touched nothing though it came as near as the robot needs to stop from its
            greatest speed, in the order in which it was nearest.
    """

    clearance: float
    time: float | None
    obstacle: str | None
    contacts: tuple[Contact, ...]
    passes: tuple[Pass, ...] = ()
