"""Capsules in the page: drawn, turned by their ends, widened, planned round."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

Visit = Callable[..., Any]


def near(a: list[float], b: list[float]) -> bool:
    return math.dist(a, b) < 2.5


def test_a_capsule_is_drawn_turned_widened_and_taken_out(visit: Visit, patrol: Path) -> None:
    page = visit(patrol)
    count = len(page.doc["world"]["known"])
    page.press("i")
    page.drag([40, 420], [120, 420])
    capsule = page.doc["world"]["known"][count]["capsule"]
    assert near(capsule["from"], [40, 420])
    assert near(capsule["to"], [120, 420])
    assert abs(capsule["radius"] - 8) < 1
    page.drag([120, 420], [120, 460])  # an end
    capsule = page.doc["world"]["known"][count]["capsule"]
    assert near(capsule["to"], [120, 460])
    across = [-40 / math.hypot(80, 40), 80 / math.hypot(80, 40)]
    handle = [80 + capsule["radius"] * across[0], 440 + capsule["radius"] * across[1]]
    page.drag(handle, [80 + 15 * across[0], 440 + 15 * across[1]])
    assert abs(page.doc["world"]["known"][count]["capsule"]["radius"] - 15) < 2
    page.press("u")
    assert page.doc["world"]["unseen"][-1]["capsule"]["to"] == capsule["to"]
    page.press("Delete")
    assert all("capsule" not in item for item in page.doc["world"].get("unseen", []))
