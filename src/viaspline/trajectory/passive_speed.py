"""How fast a robot gets that stands before anything can touch it that may come unseen.

What it doesn't see may come towards it from the rim of what it sees as soon as it has looked. From
a speed v it stands after v / b and v² / 2b, b being its deceleration; until then what comes has
gone on by V v / b, V being its speed. Both have to fit between the robot's body and that rim:

    v² / 2b + V v / b <= room.
"""

from __future__ import annotations

import math


def passive_speed(room: float, top_speed: float, brake: float) -> float:
    """The greatest speed on a straight line from which the robot stands in time [m/s].

    Args:
        room: How far it sees beyond its body [m]; less than 0 is none.
        top_speed: Nothing that comes is faster [m/s].
        brake: Its deceleration [m/s²].

    Example:
        >>> passive_speed(room=2.0, top_speed=1.5, brake=1.0)
        1.0
    """
    return math.sqrt(top_speed * top_speed + 2.0 * brake * max(room, 0.0)) - top_speed


def room_for(speed: float, top_speed: float, brake: float, reaction: float) -> float:
    """How far a robot has to see beyond its body to keep up a speed [m].

    Args:
        speed: On a straight line [m/s].
        top_speed: Nothing that comes is faster [m/s].
        brake: Its deceleration [m/s²].
        reaction: Time from one look to the next, in which both go on [s].

    Example:
        >>> room_for(speed=1.0, top_speed=1.5, brake=1.0, reaction=0.1)
        2.25
    """
    return speed * (0.5 * speed + top_speed) / brake + (speed + top_speed) * reaction
