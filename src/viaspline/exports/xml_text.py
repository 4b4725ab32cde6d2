"""Texts as XML can hold them."""

from __future__ import annotations

import re
from typing import Final
from xml.etree.ElementTree import Element, indent, tostring

_FORBIDDEN: Final = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def xml_words(text: str) -> str:
    r"""A text without the characters that XML forbids.

    >>> xml_words("quay\x00 <1>")
    'quay <1>'
    """
    return _FORBIDDEN.sub("", text)


def xml_file(root: Element) -> bytes:
    r"""A document, indented; carriage returns as references, for readers drop bare ones.

    >>> name = Element("name")
    >>> name.text = "quay\r1"
    >>> xml_file(name).splitlines()[1]
    b'<name>quay&#13;1</name>'
    """
    indent(root)
    text = bytes(tostring(root, encoding="utf-8", xml_declaration=True))
    return text.replace(b"\r", b"&#13;") + b"\n"
