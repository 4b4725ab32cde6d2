import os
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from textwrap import indent

import numba
import numpy as np
import pytest

from viaspline.kernels import jit, kernel_cache
from viaspline.kernels.compile_events import compile_progress
from viaspline.kernels.routing.navmesh.dilate import grow_into

compiled = pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="nothing is compiled with the JIT off"
)


def test_the_chosen_folder_is_taken_and_named_after_the_sources(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VIASPLINE_CACHE_DIR", str(tmp_path / "mine"))
    folder = kernel_cache.cache_folder()
    assert folder is not None
    assert folder.parent == tmp_path / "mine"
    assert folder.is_dir()
    assert folder == kernel_cache.cache_folder()


def test_where_the_first_folder_cannot_be_made_the_next_is_taken(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("VIASPLINE_CACHE_DIR", str(tmp_path / "file"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    folder = kernel_cache.cache_folder()
    assert folder is not None
    assert folder.parent == tmp_path / "cache" / "viaspline"


def test_without_any_folder_there_is_no_cache(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def nowhere() -> Iterator[Path]:
        yield tmp_path / "file" / "below"

    (tmp_path / "file").write_text("in the way")
    monkeypatch.setattr(kernel_cache, "_candidates", nowhere)
    assert kernel_cache.cache_folder() is None


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="folders have no owner here")
def test_a_folder_of_somebody_else_is_not_trusted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stranger = tmp_path.stat().st_uid + 1
    monkeypatch.setattr(os, "getuid", lambda: stranger)
    monkeypatch.setattr(kernel_cache, "_candidates", lambda: iter([tmp_path / "planted"]))
    assert kernel_cache.cache_folder() is None


@compiled
def test_the_callers_own_cache_folder_stays_as_it_was() -> None:
    before = numba.config.CACHE_DIR
    jit.kernel(lambda x: x + 1)
    assert before == numba.config.CACHE_DIR


@compiled
@pytest.mark.parametrize("name", ["kernel", "inner", "uncounted", "inlined", "fused"])
def test_nothing_is_taken_over_from_the_caller_that_compiles_a_kernel_first(name: str) -> None:
    compiled = getattr(jit, name)(_twice)
    taken_over = {"error_model", "forceinline", "_nrt"}
    assert taken_over <= set(compiled.targetoptions)


def _twice(x: float) -> float:
    return 2.0 * x


@compiled
def test_what_is_compiled_of_ours_is_told_and_nothing_else(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def ours(x: float) -> float:
        return x + 1.0

    def theirs(x: float) -> float:
        return x - 1.0

    ours.__module__ = "viaspline.kernels.example"
    heard: list[str] = []
    with compile_progress(heard.append):
        numba.njit(ours)(1.0)
        numba.njit(theirs)(1.0)
    assert heard == ["example.ours"]


ONE_KERNEL = """
import numpy as np
from viaspline.kernels.routing.navmesh.dilate import grow_into
cells = np.zeros((5, 5), np.uint8)
grow_into(np.ones((1, 1), np.uint8), 1.0, 2, 2, 1, cells)
print(cells.sum())
"""


@compiled
def test_of_four_processes_on_one_cold_cache_one_compiles_each_kernel(tmp_path: Path) -> None:
    environment = os.environ | {"VIASPLINE_CACHE_DIR": str(tmp_path / "cold")}
    tell = "from viaspline.kernels.compile_events import compile_progress as heard\n"
    block = tell + "with heard(print):" + ONE_KERNEL.replace("\n", "\n    ")
    running = [
        subprocess.Popen(
            [sys.executable, "-c", block],
            env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )
        for _ in range(4)
    ]  # fmt: skip
    told = [process.communicate(timeout=120) for process in running]
    assert [process.returncode for process in running] == [0] * 4, told
    lines = [out.split() for out, _ in told]
    assert len({words[-1] for words in lines}) == 1
    compiled = [name for words in lines for name in words[:-1]]
    assert "dilate.grow_into" in compiled
    assert sorted(compiled) == sorted(set(compiled))
    assert [error for _, error in told] == [""] * 4
    assert list((tmp_path / "cold").rglob("*grow_into*.nbi"))


@compiled
def test_what_fails_to_compile_keeps_no_other_process_waiting(tmp_path: Path) -> None:
    environment = os.environ | {"VIASPLINE_CACHE_DIR": str(tmp_path / "cold")}
    fails = ONE_KERNEL.replace("np.uint8), 1.0", "np.uint8), 'wide'")
    waits = [sys.executable, "-c", f"try:\n{indent(fails, ' ')}\nexcept Exception:\n input()"]
    one = subprocess.Popen(
        waits, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    try:
        locks = tmp_path / "cold"
        while not [*locks.rglob("*.lock")]:
            time.sleep(0.01)
        other = [sys.executable, "-c", ONE_KERNEL]
        done = subprocess.run(
            other, env=environment, capture_output=True, text=True, timeout=100, check=False
        )
        assert done.returncode == 0, done.stderr
    finally:
        one.communicate("\n")


@compiled
def test_an_interrupt_that_a_callback_swallowed_is_raised_where_the_kernel_would_be_kept(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Half of those that come while LLVM works, which Python hears of in its next callback."""

    def not_told(result: object) -> object:
        raise RuntimeError("no compiled object yet")

    monkeypatch.setattr(
        kernel_cache.CompileResultCacheImpl, "reduce", lambda _, cres: not_told(cres)
    )
    with pytest.raises(KeyboardInterrupt):
        grow_into(np.ones((1, 1), np.uint8), np.float32(1.0), 2, 2, 1, np.zeros((5, 5), np.uint8))


@compiled
def test_where_no_cache_can_be_written_kernels_are_compiled_without_one(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("in the way")
    nowhere = str(tmp_path / "file" / "below")
    environment = os.environ | {
        "VIASPLINE_CACHE_DIR": nowhere, "XDG_CACHE_HOME": nowhere, "HOME": nowhere,
        "TMPDIR": nowhere,
    }  # fmt: skip
    block = "import tempfile; tempfile.tempdir = " + repr(nowhere) + "\n"
    show = "from viaspline.kernels.kernel_cache import CACHE_FOLDER; print(CACHE_FOLDER)"
    done = subprocess.run(
        [sys.executable, "-c", block + ONE_KERNEL + show],
        env=environment, capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.split()[-1] == "None"


INTERRUPTED = """
import ctypes, threading, time
from typing import NamedTuple
import numpy as np
from viaspline.kernels.jit import kernel

class Found(NamedTuple):
    places: np.ndarray
    rests: bool

@kernel
def found(places, begun):
    begun[0] = 1.0
    for k in range(200_000_000):
        places[k % 3] += k ** 0.5
    return Found(places.copy(), True)

class Stop(BaseException):
    pass

def work():
    try:
        found(np.zeros(3), begun)
    except Stop:
        print("stopped")

begun = np.zeros(1)
found.compile("(f8[:], f8[:])")
worker = threading.Thread(target=work)
worker.start()
while not begun[0]:
    time.sleep(0.001)
ctypes.pythonapi.PyThreadState_SetAsyncExc(
    ctypes.c_ulong(worker.ident), ctypes.py_object(Stop)
)
worker.join()
"""


@compiled
def test_an_interrupt_while_a_kernel_runs_that_gives_a_named_tuple_is_an_exception() -> None:
    run = [sys.executable, "-c", INTERRUPTED]
    done = subprocess.run(run, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "stopped\n"), done.stderr
