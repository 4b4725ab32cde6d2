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

    @property
    def words(self) -> str:
        """What happened.

        >>> Contact(7.59, "dog", 0.0).words, Contact(7.59, "dog", 1.5).words
        ("touched by 'dog', which moves, while it stood", "touched 'dog', which moves, at 1.50 m/s")
        """
        if self.robot_speed == 0.0:
            return f"touched by '{self.obstacle}', which moves, while it stood"
        return f"touched '{self.obstacle}', which moves, at {self.robot_speed:.2f} m/s"


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

    @property
    def touched(self) -> str:
        """The first touch in words, and how many more there were; empty where nothing touched."""
        if not self.contacts:
            return ""
        first, more = self.contacts[0], len(self.contacts) - 1
        return f"{first.words}, at {first.time:.1f} s" + (
            f", and {more} times more" if more else ""
        )


def told_in_short(reached: bool, reason: str | None, met: Encounters | None) -> str:
    """How a drive ended, and whether something that moves touched the robot.

    >>> told_in_short(True, None, None)
    'reached'
    >>> told_in_short(True, None, Encounters(-0.1, 8.0, "dog", (Contact(7.59, "dog", 0.0),)))
    "reached, touched by 'dog', which moves, while it stood, at 7.6 s"
    """
    end = "reached" if reached else reason or ""
    touched = "" if met is None else met.touched
    if not touched or "touched" in end:  # one that was under way is the reason
        return end
    return f"{end}, {touched}"
