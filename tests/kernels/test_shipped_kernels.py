import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import viaspline
from viaspline.kernels.shipped_kernels import NOTE_NAME, ShippedKernels, compiled_with, write_note

compiled = pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="nothing is compiled with the JIT off"
)

TARGET = ("x86_64-unknown-linux-gnu", "generic", "+avx2,+fma,-avx512f")

COMPILE = """
import sys
from pathlib import Path
import numpy as np
from viaspline.kernels.compile_events import compile_progress
from viaspline.kernels.loaded_kernels import loaded_kernels
from viaspline.kernels.routing.navmesh.dilate import grow_into
heard = []
with compile_progress(heard.append):
    cells = np.zeros((5, 5), np.uint8)
    grow_into(np.ones((1, 1), np.uint8), 1.5, 2, 2, 1, cells)
print(int(cells.sum()), len(heard))
if sys.argv[1:]:
    from viaspline.warming.pack_kernels import pack_kernels
    print(pack_kernels(Path(sys.argv[1]), loaded_kernels()))
"""


def test_kernels_fit_where_all_is_the_same_and_the_processor_can_do_it(tmp_path: Path) -> None:
    write_note(tmp_path, TARGET)
    assert ShippedKernels.found(tmp_path, {"avx2": True, "fma": True}) == ShippedKernels(
        tmp_path, TARGET
    )
    assert ShippedKernels.found(tmp_path, {"avx2": True, "fma": False}) is None
    assert ShippedKernels.found(tmp_path, {}) is None


@pytest.mark.parametrize("what", sorted(compiled_with()))
def test_kernels_of_another_version_of_anything_are_left_alone(tmp_path: Path, what: str) -> None:
    write_note(tmp_path, TARGET)
    note = json.loads((tmp_path / NOTE_NAME).read_text())
    note["with"][what] += ".1"
    (tmp_path / NOTE_NAME).write_text(json.dumps(note))
    assert ShippedKernels.found(tmp_path, {"avx2": True, "fma": True}) is None


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"features": 3}', '{"features": "", "target":'])
def test_a_note_that_is_none_is_as_if_there_were_no_kernels(tmp_path: Path, text: str) -> None:
    assert ShippedKernels.found(tmp_path) is None
    (tmp_path / NOTE_NAME).write_text(text)
    assert ShippedKernels.found(tmp_path) is None


def said(site: Path, cache: Path, *arguments: object, **more: str) -> list[str]:
    """What a process says that calls a kernel of the viaspline in a folder."""
    environment = os.environ | {"PYTHONPATH": str(site), "VIASPLINE_CACHE_DIR": str(cache), **more}
    command = [sys.executable, "-P", "-c", COMPILE, *map(str, arguments)]
    done = subprocess.run(
        command, env=environment, text=True, capture_output=True, timeout=300, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@compiled
def test_what_a_wheel_brings_along_is_loaded_and_not_compiled(tmp_path: Path) -> None:
    site, sources = tmp_path / "site", Path(viaspline.__file__).parent
    shutil.copytree(sources, site / "viaspline", ignore=shutil.ignore_patterns("__pycache__"))
    shipped = site / "viaspline" / "kernels" / "compiled"
    generic = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
    first = said(site, tmp_path / "build", shipped, **generic)
    assert int(first[1]) > 0
    assert first[2] == "1"  # the one that Python called; not what it calls
    assert said(site, tmp_path / "cold") == [first[0], "0"]
    assert not list((tmp_path / "cold").rglob("*.nbc"))
    (tmp_path / "file").write_text("in the way")
    assert said(site, tmp_path / "file" / "below", HOME=str(tmp_path / "file")) == [first[0], "0"]
    note = json.loads((shipped / NOTE_NAME).read_text())
    (shipped / NOTE_NAME).write_text(json.dumps(note | {"with": {}}))
    assert said(site, tmp_path / "cold") == first[:2]
