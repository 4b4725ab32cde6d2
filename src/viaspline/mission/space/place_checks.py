"""Can a robot in space be at every place of its route, and at what height if not?"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from viaspline.errors import Change
from viaspline.mission.partial_mission import PartialMission, obstacle_label
from viaspline.mission.route_spec import ViaPoint
from viaspline.mission.space.flight_places import ground_height
from viaspline.mission.space.flown_place import FlownPlace
from viaspline.mission.space.solid_space import ROUND_OFF_M, SolidSpace
from viaspline.mission.space.spatial_parts import SpatialParts
from viaspline.mission.space.upright_body import SpatialSize
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number, spell


@dataclass(frozen=True)
class PlaceChecks:
    """What is asked of every place.

    Attributes:
        space: What stands about it.
        labels: What solids are called.
        fences: Paths of the fences.
    """

    space: SolidSpace
    labels: Sequence[str]
    fences: Sequence[Path]

    @classmethod
    def of(
        cls, partial: PartialMission, parts: SpatialParts, misshapen: Collection[Path], home: float
    ) -> PlaceChecks:
        """Those of a mission, as far as it is sound.

        Args:
            partial: The parts of the mission that are sound.
            parts: Those that there are in space only.
            misshapen: Paths of obstacles and fences that have no usable shape.
            home: How high the ground is under the start [m]; NaN if nobody knows.
        """
        about = partial.standing(misshapen)
        altitude = parts.altitude
        if altitude is not None and altitude.is_upside_down:
            altitude = None
        space = SolidSpace.of(
            SpatialSize.of(partial.robot_or_point),
            [obstacle for _, obstacle in about.known],
            (about.bounds, [(ring,) for _, ring in about.fences]),
            parts.ground,
            altitude,
            home,
        )
        labels = [obstacle_label(path, obstacle) for path, obstacle in about.known]
        return cls(space, labels, [path for path, _ in about.fences])

    def faults(self, visit: FlownPlace) -> Iterator[UnplacedFault]:
        """What is wrong with a place."""
        problems = [*self._upright(visit)]
        if problems:
            remedy, changes = self._remedy(visit)
            for problem in problems:
                yield UnplacedFault(visit.path, problem, remedy, changes=changes)
        yield from self._of_walls(visit)

    def _upright(self, visit: FlownPlace) -> Iterator[str]:
        """What of it another height may mend."""
        space, name, z = self.space, visit.label, visit.place[2]
        if not visit.on_ground:
            yield from self._of_ground(visit)
            low, high = space.band(*visit.place[:2])
            above = "" if space.altitude is None else _BAND_WORDS[space.altitude.above]
            if z < low - ROUND_OFF_M:
                yield f"{name} lies {_metres(low - z)} below the altitude band{above}"
            if z > high + ROUND_OFF_M:
                yield f"{name} lies {_metres(z - high)} above the altitude band{above}"
        body = space.size.at(visit.place, visit.top)
        for i, distance in space.near_solids(body):
            if distance < 0:
                meets = "inside" if visit.top is None else "through"
                yield f"{name} {'goes' if visit.top else 'lies'} {meets} {self.labels[i]}"
            else:
                lacking = _metres(space.size.margin - distance)
                yield f"{name} comes {lacking} inside the clearance of {self.labels[i]}"

    def _of_ground(self, visit: FlownPlace) -> Iterator[str]:
        space = self.space
        x, y, z = visit.place
        if space.ground is None:
            return
        height = ground_height(space.ground, x, y)
        if math.isnan(height):
            if space.ground.nodata == "blocked":
                yield f"{visit.label} lies where the height of the ground isn't known"
            return
        if z < height:
            yield f"{visit.label} lies {_metres(height - z)} under the ground"
            return
        body = space.size.at(visit.place)
        distance = space.above_ground(body, only_known=True)
        if space.above_ground(body) < space.size.margin - ROUND_OFF_M <= distance:
            yield f"{visit.label} lies too near to where the height of the ground isn't known"
        if distance < space.size.margin - ROUND_OFF_M:
            lacking = _metres(min(space.size.margin - distance, space.size.upwards))
            yield f"{visit.label} lies {lacking} inside the clearance of the ground"

    def _of_walls(self, visit: FlownPlace) -> Iterator[UnplacedFault]:
        walls, place = self.space.walls, visit.place[:2]
        found = [("the bounds", distance) for _, distance in walls.near_bounds([place])]
        found += (
            (f"fence {spell(self.fences[j])}", distance)
            for _, j, distance in walls.near_fences([place])
        )
        for thing, distance in found:
            if distance >= walls.margin - ROUND_OFF_M:
                continue
            problem = f"{visit.label} lies {_metres(-distance)} outside {thing}"
            if distance >= 0:
                lacking = _metres(walls.margin - distance)
                problem = f"{visit.label} lies {lacking} inside the clearance of {thing}"
            yield UnplacedFault(visit.plan_path, problem, "move it inwards")

    def _remedy(self, visit: FlownPlace) -> tuple[str, tuple[Change, ...]]:
        """Another height, if there is one."""
        x, y, _ = visit.place
        if visit.on_ground:
            return "begin or end where the sky is free, or leave it out", ()
        ground = ground_height(self.space.ground, x, y)
        zero = ground if visit.is_over_ground and not math.isnan(ground) else 0.0
        height = self.space.free_height(visit.place, zero)
        if height is None:
            return "move it: there is no height near by at which the robot may be there", ()
        return visit.raised_to(height, ground)


_BAND_WORDS = {"home": " above home", "ground": " above ground", "amsl": ""}


def _metres(length: float) -> str:
    return f"{number(length)} m" if length >= 5e-4 else "less than 1 mm"


def point_label(path: Path, point: ViaPoint) -> str:
    """What a point of the route is called in a message."""
    kind = next(part for part in reversed(path) if isinstance(part, str))
    if point.name is not None:
        return f"{kind} '{point.name}'"
    if point.gate is not None:
        return "the gate"
    return "the via point" if kind == "via" else kind
