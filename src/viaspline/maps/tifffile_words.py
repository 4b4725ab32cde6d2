"""What tifffile says of a file, heard instead of printed.

Tested through ``maps/test_geotiff``.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field


@dataclass
class TifffileWords:
    """What was logged while a file was read.

    Attributes:
        said: Each message.
    """

    said: list[str] = field(default_factory=list)

    def filter(self, record: logging.LogRecord) -> bool:
        """Keep a message, and have nobody else get it."""
        self.said.append(record.getMessage())
        return False

    def unread(self, codes: Collection[int]) -> str | None:
        """The first message that says that one of some tags can't be read; None: all can."""
        for words in self.said:
            found = re.search(r"TiffTag (\d+) ", words)
            if found is not None and int(found[1]) in codes:
                return words
        return None


@contextmanager
def tifffile_words() -> Iterator[TifffileWords]:
    """Hear what tifffile logs, which otherwise stands on the terminal beside our own words.

    >>> with tifffile_words() as words:
    ...     logging.getLogger("tifffile").error("TiffTag 256 @10 is spoiled")
    >>> words.unread([257]), words.unread([256])
    (None, 'TiffTag 256 @10 is spoiled')
    """
    logger, words = logging.getLogger("tifffile"), TifffileWords()
    logger.addFilter(words)
    try:
        yield words
    finally:
        logger.removeFilter(words)
