"""Plans of other missions than the one on the screen, made in a thread of their own.

What is on the screen is planned meanwhile.

Tested through ``studio/test_variant_comparison``.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from viaspline.studio.document import Document, is_spatial
from viaspline.studio.folder import Folder
from viaspline.studio.stoppable_calls import Stoppable, StoppedCallError
from viaspline.studio.worker import Worker

if TYPE_CHECKING:
    from viaspline.studio.map_cache import MapCache
    from viaspline.studio.space.solid_files import SolidFiles


class VariantPlans:
    """Plans documents whole, one after the other.

    Args:
        folder: Where maps are read.
    """

    def __init__(self, folder: Folder) -> None:
        self._folder = folder
        self._worker = Worker("variants")
        self._maps: MapCache | None = None
        self._solids: SolidFiles | None = None

    async def row(
        self, document: Document, base: Path, running: Stoppable
    ) -> dict[str, Any] | None:
        """What a table says of a document's plan, or why there is none; None where it is stopped.

        Args:
            document: What is planned: a mission.
            base: The folder of its file.
            running: Stops it.
        """

        def work() -> dict[str, Any] | None:
            try:
                return running.run(lambda: self._planned(document, base))
            except StoppedCallError:
                return None

        return await self._worker.run(work)

    def _planned(self, document: Document, base: Path) -> dict[str, Any]:
        from viaspline.studio import plan_document, variant_row
        from viaspline.studio.map_cache import MapCache
        from viaspline.studio.space import planned_spatial
        from viaspline.studio.space.solid_files import SolidFiles

        if self._maps is None:
            self._maps = MapCache(self._folder)
        if self._solids is None:
            self._solids = SolidFiles(self._maps)
        if not is_spatial(document):
            return variant_row.variant_row(plan_document.planned(document, self._maps, base))
        soon = planned_spatial.planned_in_space(document, self._solids, base)
        if soon.plan is not None and not soon.is_whole:
            soon = planned_spatial.wholly_planned_in_space(soon)
        return variant_row.variant_row(soon)
