"""The world of a fleet in space, as its pictures show it: from above, and in perspective.

Tested through ``report/fleet/test_flying_fleet_picture``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import shapely
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.maps.terrain import Terrain
from viaspline.mission.fleet.fleet import Fleet
from viaspline.mission.shapes.solids import RoundedSegment
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.report import style
from viaspline.report.labels import Labels
from viaspline.report.space.solid_marks import draw_solids, name_roofs
from viaspline.report.space.space_view import draw_space_of_many
from viaspline.report.space.spatial_scene import NamedSolid, SpatialScene


@dataclass(frozen=True)
class FlownScene:
    """What stands in the world of a fleet in space.

    Attributes:
        stands: It.
        widest: How far the widest robot reaches from its reference point with its clearance [m].
    """

    stands: SpatialScene
    widest: float

    @classmethod
    def of(cls, plan: FleetPlan) -> FlownScene:
        """Of a fleet's plan."""
        robots = [one.mission.robot for one in plan.fleet.members]
        widest = max(FlyingBody.of(one).beside + one.clearance_m for one in robots)
        return cls(stands_in(plan.fleet), widest)

    def draw(self, axes: Axes, pixels_per_metre: float) -> list[Artist]:
        """Draw it from above, at any scale; returns handles for the legend."""
        return draw_solids(axes, self.stands)

    def name(self, labels: Labels) -> None:
        """Ask for the names of what has one, but of cables, masts and balls, and for heights."""
        name_roofs(labels, self.stands)
        for one in self.stands.solids:
            if one.name and not isinstance(one.solid, RoundedSegment):
                x, y = shapely.get_coordinates(shapely.point_on_surface(one.shadow))[0].tolist()
                labels.add(style.short(one.name), (x, y), rank=7, colour=style.OBSTACLE_EDGE)


def stands_in(fleet: Fleet) -> SpatialScene:
    """What stands in the world of a fleet."""
    world = fleet.world
    solids: Sequence[NamedSolid] = [
        NamedSolid(obstacle.solid(), obstacle.name or "") for obstacle in world.standing
    ]
    ground = world.ground
    terrain: Terrain | None = None if ground is None else ground.terrain
    flat = None if ground is None or terrain is not None else ground.flat_m
    return SpatialScene(solids, terrain, flat, world.bounds)


def draw_flown(
    figure: Figure, panel: Axes, scene: FlownScene, plan: FleetPlan, colours: Mapping[str, str]
) -> None:
    """Draw all paths in perspective, in place of an empty panel.

    Args:
        figure: Of the page.
        panel: It is taken away.
        scene: What stands in the world.
        plan: Whose paths are drawn.
        colours: Of the robots by name.
    """
    left, bottom, width, height = panel.get_position().bounds
    panel.remove()
    paths = [(one.path, colours[name]) for name, one in plan.plans.items()]
    if paths:
        draw_space_of_many(figure, (left, bottom, width, 1.12 * height), paths, scene.stands)
