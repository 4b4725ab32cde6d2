import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from viaspline.kernels import kernel_cache
from viaspline.kernels.kernel_cache import SOURCES
from viaspline.kernels.source_keys import SourceKeys
from viaspline.warming import first_run as module
from viaspline.warming.first_run import first_run, is_compiled, notice

KERNEL = "viaspline.kernels.routing.navmesh.dilate.grow_into"
OTHER = "viaspline.kernels.clearance.disc.conflicts"

compiled = pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="nothing is compiled with the JIT off"
)

ONE = """
import numpy as np
from viaspline.warming.first_run import first_run
with first_run(["curves"]) as words:
    from viaspline.kernels.routing.navmesh.dilate import grow_into
    told = words()
    grow_into(np.ones((1, 1), np.uint8), 1.0, 2, 2, 1, np.zeros((5, 5), np.uint8))
print(told)
"""


@pytest.fixture
def cold(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache with nothing in it."""
    (tmp_path / "version").mkdir()
    monkeypatch.setattr(kernel_cache, "CACHE_FOLDER", tmp_path / "version")
    monkeypatch.setattr(kernel_cache, "SHIPPED", None)
    return tmp_path / "version"


def keep(cold: Path, kernel: str) -> None:
    """As if a kernel had been compiled."""
    home, name = kernel.rsplit(".", 1)
    folder = cold / kernel_cache.folder_name(home)
    folder.mkdir(exist_ok=True)
    (folder / f"{home.rsplit('.', 1)[-1]}.{name}-27.py311.nbi").touch()


def test_only_what_has_to_be_compiled_again_counts(cold: Path) -> None:
    before = {KERNEL: 12.0, OTHER: 30.0}
    assert "2 kernels of paths, once: that took 42 s here" in notice(["curves"], before)
    keep(cold, OTHER)
    assert is_compiled(OTHER)
    assert not is_compiled(KERNEL)
    assert "1 kernel of paths, once: that took 12 s here" in notice(["curves"], before)
    keep(cold, KERNEL)
    assert "never compiled here" in notice(["curves"], before)
    assert " s " not in notice(["curves"], before)


def test_what_was_compiled_from_other_sources_is_not(
    cold: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    keep(cold, KERNEL)
    assert is_compiled(KERNEL)
    home = KERNEL.rsplit(".", 1)[0]
    edited = SourceKeys({**SOURCES.of, home: "0" * 16}, "")
    monkeypatch.setattr(kernel_cache, "SOURCES", edited)
    assert not is_compiled(KERNEL)
    assert is_compiled("viaspline.kernels.gone.kernel")


def test_where_nothing_was_measured_it_says_where_it_was() -> None:
    words = notice(["curves", "fleets", "fleet_drives"], {})
    assert words.startswith("compiling the kernels of paths, fleets, once per machine")
    assert "EPYC" in words
    assert "here it was never measured" in words


@pytest.mark.parametrize("text", ["", "[]", '{"x": 1}', '{"M": {"curves": 3}}', '{"M": []}'])
def test_times_that_cannot_be_read_are_as_if_there_were_none(cold: Path, text: str) -> None:
    (cold.parent / module.FILE_NAME).write_text(text.replace("M", module._machine()))
    with first_run(["curves"]) as words:
        assert "never measured" in words()


@compiled
def test_what_a_first_run_took_is_what_the_next_one_says(tmp_path: Path) -> None:
    def told(cache: str, **more: str) -> str:
        environment = os.environ | {"VIASPLINE_CACHE_DIR": str(tmp_path / cache)} | more
        command = [sys.executable, "-c", ONE]
        return subprocess.run(
            command, env=environment, text=True, capture_output=True, timeout=300, check=True
        ).stdout

    assert "never measured" in told("one")
    kept = json.loads((tmp_path / "one" / module.FILE_NAME).read_text())
    assert list(kept[module._machine()]["curves"]) == [KERNEL]
    assert 0.05 < kept[module._machine()]["curves"][KERNEL] < 200.0
    (tmp_path / "two").mkdir()
    (tmp_path / "one" / module.FILE_NAME).rename(tmp_path / "two" / module.FILE_NAME)
    assert "compiling 1 kernel of paths, once: that took" in told("two")
