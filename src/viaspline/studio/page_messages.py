"""Messages as they come from the page: JSON objects with a type, and nothing else."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, Final

from viaspline.studio.refused_error import RefusedError

MAX_MESSAGE_BYTES: Final = 4_000_000
"""Largest message [bytes]; the connection of a larger one is closed with code 1009."""

Message = Mapping[str, Any]


def decoded(text: str) -> Message:
    """A message from its text.

    Raises:
        RefusedError: It isn't a JSON object with a type, or has numbers that are none.

    >>> decoded('{"type": "files"}')
    {'type': 'files'}
    """
    try:
        message = json.loads(text, parse_constant=_no_number)
    except (ValueError, RecursionError) as error:
        raise RefusedError(f"a message is JSON: {error}") from None
    if not isinstance(message, dict) or not isinstance(message.get("type"), str):
        raise RefusedError('a message is a JSON object with a "type"')
    return message


def encoded(message: Message) -> str:
    """A message as short as it gets."""
    return json.dumps(message, separators=(",", ":"), allow_nan=False, ensure_ascii=False)


def text_of(message: Message, key: str, default: str | None = None) -> str:
    """A text in a message.

    Raises:
        RefusedError: There is none, or it is something else.
    """
    value = message.get(key, default)
    if not isinstance(value, str) or len(value) > 4096:
        raise RefusedError(f"{key} has to be a text")
    return value


def count_of(message: Message, key: str, default: int = 0) -> int:
    """A whole number, 0 or more, in a message.

    Raises:
        RefusedError: It is something else.
    """
    value = message.get(key, default)
    if not isinstance(value, int) or isinstance(value, bool) or not 0 <= value < 2**53:
        raise RefusedError(f"{key} has to be a whole number, 0 or more")
    return value


def _no_number(name: str) -> float:
    raise ValueError(f"{name} is not a number")
