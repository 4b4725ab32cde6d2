"""A place of a route in space, with where it is said in the mission, and how to change it.

Tested through ``mission/space/test_place_checks``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.errors import Change
from viaspline.mission.shapes.solids import Place
from viaspline.mission.unplaced_faults import Path, number, spell


@dataclass(frozen=True)
class FlownPlace:
    """A place at which the robot has to be able to be.

    Attributes:
        label: What it is called in a message.
        place: x, y, z of the reference point [m].
        path: Where its height is said.
        plan_path: Where its place in plan is said.
        on_ground: Whether the robot stands there; then it touches the ground, and may be lower than
            the altitude band.
        top: z of the reference point up to which it climbs straight up there [m]; None: it doesn't.
    """

    label: str
    place: Place
    path: Path
    plan_path: Path
    on_ground: bool = False
    top: float | None = None

    @property
    def is_over_ground(self) -> bool:
        """Whether its height is said as one above the ground."""
        return self.path[-1] in ("agl_m", "to_agl_m")

    def raised_to(self, height: float, ground: float) -> tuple[str, tuple[Change, ...]]:
        """The remedy that gives it another height, in words and for programs.

        Args:
            height: Its z [m].
            ground: How high the ground is there [m]; NaN if nobody knows.
        """
        key = self.path[-1]
        if self.is_over_ground:
            if math.isnan(ground):
                return "give its z in place of agl_m", ()
            value = round(height - ground, 3)
            return f"set {key} to {number(value)}", (Change(spell(self.path), value),)
        change = Change(spell(self.path), (*self.place[:2], height))
        words = f"set its z to {number(height)}"
        if 0 < self.place[2] < ground and "gate" not in self.path:
            words += f", or give agl_m: {number(self.place[2])} if that is meant above the ground"
        return words, (change,)
