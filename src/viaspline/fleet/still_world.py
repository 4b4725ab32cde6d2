"""A fleet as if nothing in its world moved.

Tested through ``fleet/test_among_moving``.
"""

from __future__ import annotations

from viaspline.errors import GeometryError
from viaspline.mission.fleet.fleet import Fleet


def without_motion(fleet: Fleet) -> Fleet:
    """The fleet in a world in which nothing moves; the very fleet if nothing does.

    Args:
        fleet: What is asked for.
    """
    if not fleet.world.moving:
        return fleet
    still = tuple(one for one in fleet.world.known if one.motion is None)
    found = fleet.model_copy(update={"world": fleet.world.model_copy(update={"known": still})})
    found.__dict__.pop("members", None)  # they have the world
    return found


def check_still(fleet: Fleet) -> None:
    """Refuse a fleet among things that move where robots drive by their orders, not by the clock.

    Raises:
        GeometryError: Something moves.
    """
    if fleet.world.moving:
        name = fleet.world.moving[0].name or "what moves"
        raise GeometryError(
            f"'{name}' waits for nobody: a robot that is delayed isn't proven clear of it; drive "
            "the plan by the clock, or plan anew when a robot is late, or leave the motion out"
        )
