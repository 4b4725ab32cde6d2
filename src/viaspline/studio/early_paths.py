"""Paths that a page is shown before the plan is there, laid in a thread of their own.

They don't wait for a plan that is being broken off, which a kernel may hold up.

Tested through ``studio/test_early_paths``.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Final

from viaspline.studio.document import Document, is_fleet, is_spatial
from viaspline.studio.folder import Folder
from viaspline.studio.page_messages import encoded
from viaspline.studio.worker import Worker

if TYPE_CHECKING:
    from viaspline.mission.model import Mission
    from viaspline.studio.map_cache import MapCache

SLOW_PLAN_S: Final = 0.05
"""A plan that takes less is shown as it is [s]."""

SLOW_KEYS: Final = frozenset({"drive", "footprint", "localization", "min_turn_radius_m"})
"""What makes the plan of a robot take long."""


def is_wanted(document: Document, before: object) -> bool:
    """Whether the plan of a document will keep a page waiting.

    Args:
        document: What is going to be planned.
        before: What was planned last, of whatever kind.
    """
    from viaspline.studio.plan_document import PlannedDocument

    if is_fleet(document) or is_spatial(document):
        return False  # which have early answers of their own
    robot = document.get("robot")
    if not isinstance(robot, dict) or not SLOW_KEYS.intersection(robot):
        return False
    if isinstance(before, PlannedDocument) and before.plan is not None:
        return before.seconds > SLOW_PLAN_S
    return True


class EarlyPaths:
    """Lays provisional paths.

    Args:
        folder: Where maps are read.
    """

    def __init__(self, folder: Folder) -> None:
        self._folder = folder
        self._worker = Worker("early paths")
        self._maps: MapCache | None = None

    async def told(
        self, document: Document, base: Path, revision: int, before: object
    ) -> str | None:
        """The provisional path of a document as text; None where none is soon found.

        Args:
            document: What is going to be planned.
            base: The folder of its file.
            revision: What the page calls this state of the document.
            before: What was planned last: what its robot got beside its path is kept here as well.
        """

        def work() -> str | None:
            from viaspline.errors import ViasplineError
            from viaspline.mission.model import Mission
            from viaspline.studio.map_cache import MapCache
            from viaspline.studio.page_numbers import flat
            from viaspline.studio.provisional_path import provisional_path

            start = time.perf_counter()
            if self._maps is None:
                self._maps = MapCache(self._folder)
            try:
                mission = Mission.model_validate(self._maps.unfold(document, base).data)
            except ViasplineError:
                return None  # the plan will say what is wrong
            found = provisional_path(mission, _tracking_error(mission, before))
            if found is None:
                return None
            return encoded({
                "type": "provisional",
                "rev": revision,
                "ms": round(1e3 * (time.perf_counter() - start), 3),
                "spans": flat(found.spans),
                "leftOut": found.left_out,
            })  # fmt: skip

        return await self._worker.run(work)


def _tracking_error(mission: Mission, before: object) -> float:
    """How far beside its path the robot got in the plan before, if it is the same robot [m]."""
    from viaspline.studio.plan_document import PlannedDocument

    if not isinstance(before, PlannedDocument) or before.plan is None or before.mission is None:
        return 0.0
    return before.plan.tracking_error if before.mission.robot == mission.robot else 0.0
