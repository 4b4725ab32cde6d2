"""Maps to read: written by hand, by Pillow, and real ones."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

DATA = Path(__file__).parent / "data"

SOUND = {
    "image": "a.pgm", "resolution": 0.5, "origin": [0, 0, 0], "negate": 0,
    "occupied_thresh": 0.65, "free_thresh": 0.25,
}  # fmt: skip


@pytest.fixture
def data() -> Path:
    """The folder of real maps."""
    return DATA


@pytest.fixture
def described(tmp_path: Path) -> Callable[..., Path]:
    """Writes a map's YAML file, sound but for what is given; None leaves a key out."""

    def write(**keys: Any) -> Path:
        file = tmp_path / "map.yaml"
        lines = (f"{key}: {value}" for key, value in {**SOUND, **keys}.items() if value is not None)
        file.write_text("\n".join(lines) + "\n")
        return file

    return write
