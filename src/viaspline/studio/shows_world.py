"""What the page's pictures of a world are made from: a mission's document, or a fleet's.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

from typing import Protocol

from viaspline.mission.world_spec import WorldSpec
from viaspline.studio.document import Document
from viaspline.studio.map_cache import ExpandedDocument


class ShowsWorld(Protocol):
    """What came of a document with a world."""

    @property
    def document(self) -> Document:
        """The document."""
        ...

    @property
    def unfolded(self) -> ExpandedDocument | None:
        """The document with the obstacles of its maps in their places, if they could be read."""
        ...

    @property
    def world(self) -> WorldSpec | None:
        """Its world, if that is sound."""
        ...
