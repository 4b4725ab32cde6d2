import os
from collections.abc import Iterator
from pathlib import Path

import numba
import pytest

from viaspline.kernels import jit

compiled = pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="nothing is compiled with the JIT off"
)


def test_the_chosen_folder_is_taken_and_named_after_the_sources(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VIASPLINE_CACHE_DIR", str(tmp_path / "mine"))
    folder = jit.cache_folder()
    assert folder is not None
    assert folder.parent == tmp_path / "mine"
    assert folder.is_dir()
    assert folder == jit.cache_folder()


def test_where_the_first_folder_cannot_be_made_the_next_is_taken(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("VIASPLINE_CACHE_DIR", str(tmp_path / "file"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    folder = jit.cache_folder()
    assert folder is not None
    assert folder.parent == tmp_path / "cache" / "viaspline"


def test_without_any_folder_there_is_no_cache(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def nowhere() -> Iterator[Path]:
        yield tmp_path / "file" / "below"

    (tmp_path / "file").write_text("in the way")
    monkeypatch.setattr(jit, "_candidates", nowhere)
    assert jit.cache_folder() is None


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="folders have no owner here")
def test_a_folder_of_somebody_else_is_not_trusted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stranger = tmp_path.stat().st_uid + 1
    monkeypatch.setattr(os, "getuid", lambda: stranger)
    monkeypatch.setattr(jit, "_candidates", lambda: iter([tmp_path / "planted"]))
    assert jit.cache_folder() is None


@compiled
def test_the_callers_own_cache_folder_stays_as_it_was() -> None:
    before = numba.config.CACHE_DIR
    jit.kernel(lambda x: x + 1)
    assert before == numba.config.CACHE_DIR


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
    with jit.compile_progress(heard.append):
        numba.njit(ours)(1.0)
        numba.njit(theirs)(1.0)
    assert heard == ["example.ours"]
