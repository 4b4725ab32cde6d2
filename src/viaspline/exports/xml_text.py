"""Texts as XML can hold them."""

from __future__ import annotations

import re
from typing import Final

_FORBIDDEN: Final = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def xml_words(text: str) -> str:
    r"""A text without the characters that XML forbids.

    >>> xml_words("quay\x00 <1>")
    'quay <1>'
    """
    return _FORBIDDEN.sub("", text)
