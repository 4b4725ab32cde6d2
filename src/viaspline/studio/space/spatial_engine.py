"""What the studio's engine does for missions in space; all of it in the planner's thread.

Tested through ``studio/space/test_spatial_server``.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Final

from viaspline.studio.document import Document
from viaspline.studio.map_cache import MapCache
from viaspline.studio.page_messages import encoded
from viaspline.studio.space import profile_message, spatial_page_messages
from viaspline.studio.space.planned_spatial import (
    PlannedSpatial,
    planned_in_space,
    wholly_planned_in_space,
)
from viaspline.studio.space.scene_data import Scenes
from viaspline.studio.space.solid_files import SolidFiles

CHEAP_AROUND_S: Final = 0.008  # an elevation that takes less is drawn up for every plan [s]


class SpatialEngine:
    """Plans missions in space, and tells what is round their paths.

    Args:
        maps: The maps of the studio's folder.

    Attributes:
        scenes: What stands in the worlds of the plans.
    """

    def __init__(self, maps: MapCache) -> None:
        self._files = SolidFiles(maps)
        self._around_cost = 0.0
        self.scenes = Scenes()

    def planned(
        self, document: Document, base: Path, revision: int, before: object
    ) -> tuple[PlannedSpatial, str]:
        """Plan a document soon; what came of it, and the answer as text.

        Args:
            document: What is planned.
            base: The folder of its file.
            revision: What the page calls it.
            before: What was planned last, of whatever kind.
        """
        known = before if isinstance(before, PlannedSpatial) else None
        return self._told(planned_in_space(document, self._files, base, known), revision)

    def whole(self, planned: PlannedSpatial, revision: int) -> tuple[PlannedSpatial, str]:
        """A plan for which all ways were weighed, and the answer as text.

        Args:
            planned: What was planned soon.
            revision: What the page calls it.
        """
        return self._told(wholly_planned_in_space(planned), revision)

    def _told(self, planned: PlannedSpatial, revision: int) -> tuple[PlannedSpatial, str]:
        scene = None if planned.world is None else self.scenes.name_of(planned.world)
        answer = spatial_page_messages.spatial_answer(planned, revision, scene)
        return planned, encoded(answer)

    def around(self, planned: PlannedSpatial, revision: int) -> list[str]:
        """The elevation and the ledger of a plan, each as text."""
        assert planned.plan is not None
        start = time.perf_counter()
        texts = [
            encoded(profile_message.elevation_profile(planned.plan, revision)),
            encoded(spatial_page_messages.spatial_ledger(planned, revision)),
        ]
        self._around_cost = time.perf_counter() - start
        return texts

    @property
    def around_is_cheap(self) -> bool:
        """Whether the page can have that with every plan while something is dragged."""
        return self._around_cost < CHEAP_AROUND_S
