"""A page's comparison of variants: one after the other planned and told, until it is stopped."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any, Final

from viaspline.studio.document import Document, changed, is_fleet
from viaspline.studio.open_mission import OpenMission
from viaspline.studio.page_messages import Message, count_of, encoded
from viaspline.studio.refused_error import RefusedError
from viaspline.studio.stoppable_calls import Stoppable
from viaspline.studio.variant_plans import VariantPlans

MAX_VARIANTS: Final = 16
STOP_RETRY_S: Final = 0.02
"""Between two attempts to break a plan off [s]."""


class VariantComparison:
    """Compares variants of the document that is open, one comparison at a time.

    Args:
        variants: Plans them.
        current: Of whose document they are variants.
        send: Hears each as text as soon as it is planned.
    """

    def __init__(
        self, variants: VariantPlans, current: OpenMission, send: Callable[[str], Awaitable[None]]
    ) -> None:
        self._variants = variants
        self._current = current
        self._send = send
        self._number = 0
        self._running = Stoppable()

    async def compare(self, message: Message) -> dict[str, Any]:
        """Plan what is asked for and tell it row by row.

        Args:
            message: With a ``number`` that the rows carry, and ``variants``: the changes that make
                each of them of the document, as in an edit.

        Returns:
            What is answered at the end: how many there were, and whether it was stopped.

        Raises:
            RefusedError: The variants make no sense, or it is a fleet.
        """
        number = count_of(message, "number")
        documents = _variants_of(self._current.document, message.get("variants"))
        base = self._current.base
        self.stop()
        self._number = mine = self._number + 1
        done = 0
        for index, document in enumerate(documents):
            self._running = running = Stoppable()
            row = await self._planned(document, base, running, mine)
            if row is None or self._number != mine:
                break
            done += 1
            await self._send(encoded({"type": "variant", "number": number, "index": index, **row}))
        return {"type": "compared", "done": done, "stopped": done < len(documents)}

    def stop(self) -> None:
        """Break off what is compared."""
        self._number += 1
        self._running.stop()

    async def _planned(
        self, document: Document, base: Any, running: Stoppable, mine: int
    ) -> dict[str, Any] | None:
        planning = asyncio.ensure_future(self._variants.row(document, base, running))
        while not planning.done():
            await asyncio.wait({planning}, timeout=STOP_RETRY_S)
            if self._number != mine:
                running.stop()
        return planning.result()


def _variants_of(document: Document, variants: object) -> list[Document]:
    if is_fleet(document):
        raise RefusedError("variants are compared of one robot's mission: this is a fleet")
    if not isinstance(variants, list) or not 1 <= len(variants) <= MAX_VARIANTS:
        raise RefusedError(f"variants are a list of 1 to {MAX_VARIANTS} lists of changes")
    return [changed(document, changes) for changes in variants]
