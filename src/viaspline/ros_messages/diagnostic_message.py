"""How something goes: ``diagnostic_msgs/DiagnosticArray``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from viaspline.ros_messages.stamps import header

OK: Final = 0
WARN: Final = 1
ERROR: Final = 2
NODE: Final = "viaspline"


def diagnostics(time: float, level: int, words: str, values: Mapping[str, str]) -> dict[str, Any]:
    """A state in words as a message.

    Args:
        time: [s].
        level: ``OK``, ``WARN`` or ``ERROR``.
        words: What it is.
        values: Figures by their names.

    >>> diagnostics(0.0, WARN, "stands", {"left_m": "3.0"})["status"][0]["message"]
    'stands'
    """
    pairs = [{"key": key, "value": value} for key, value in values.items()]
    status = {
        "level": level, "name": f"{NODE}: drive", "message": words, "hardware_id": "",
        "values": pairs,
    }  # fmt: skip
    return {"header": header(time, ""), "status": [status]}
