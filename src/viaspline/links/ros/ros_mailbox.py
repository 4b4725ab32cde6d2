"""Messages that wait to be read: put there by a link's threads, taken by the one that drives.

Tested through ``links/ros/test_zenoh_link``.
"""

from __future__ import annotations

import queue
import time
from collections.abc import Iterator, Mapping
from typing import Any, Final

from viaspline.errors import MessageError
from viaspline.links.ros.ros_topics import NEWEST_COUNTS
from viaspline.ros_messages.message_book import MessageBook

MOST_WAITING: Final = 1000
"""Messages that wait to be read; beyond that the oldest is dropped."""

Waiting = tuple[float, str, bytes]
"""When it was heard [s], its topic, and its bytes."""


class RosMailbox:
    """Keeps bytes until they are read, and makes messages of those that still count.

    Args:
        hears: Topics with their types.
        book: The types.

    Attributes:
        unread: How many held no message of their topic's type.
    """

    def __init__(self, hears: Mapping[str, str], book: MessageBook) -> None:
        self._hears, self._book = dict(hears), book
        self._waiting: queue.Queue[Waiting] = queue.Queue(MOST_WAITING)
        self.unread = 0

    def put(self, topic: str, data: bytes) -> None:
        """Keep a message until it is read; any thread may."""
        one = time.monotonic(), topic, data
        while True:
            try:
                self._waiting.put_nowait(one)
                return
            except queue.Full:
                try:
                    self._waiting.get_nowait()
                except queue.Empty:
                    continue

    def messages(self, patience: float) -> Iterator[tuple[float, str, dict[str, Any]]]:
        """What was heard, and when [s]; if nothing was, the next that is, within so long [s].

        Times are by ``time.monotonic``. Of scans and maps only the newest of each topic is read.
        What holds no message of its topic's type is left out, and counted.
        """
        waiting = self._taken(patience)
        last = {topic: place for place, (_, topic, _) in enumerate(waiting)}
        for place, (at, topic, data) in enumerate(waiting):
            kind = self._hears[topic]
            if kind in NEWEST_COUNTS and place < last[topic]:
                continue
            try:
                yield at, topic, self._book.decoded(kind, data)
            except MessageError:
                self.unread += 1

    def _taken(self, patience: float) -> list[Waiting]:
        try:
            waiting = [self._waiting.get(timeout=max(patience, 0.0))]
        except queue.Empty:
            return []
        while True:
            try:
                waiting.append(self._waiting.get_nowait())
            except queue.Empty:
                return waiting
