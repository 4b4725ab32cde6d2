import subprocess
from pathlib import Path
from typing import Any

import pytest

from viaspline import precompile


def test_every_job_that_is_done_leaves_a_mark(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(precompile, "CACHE_FOLDER", tmp_path)
    precompile.compile_all(["curves"])
    assert {file.name for file in tmp_path.iterdir()} == {"curves-compiled"}
    precompile.compile_all(["driving"])
    assert (tmp_path / "driving-compiled").exists()


def test_the_second_process_is_started_once_and_ends_with_the_block(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[subprocess.Popen[bytes]] = []
    real = subprocess.Popen

    def recorded(*args: Any, **kwargs: Any) -> subprocess.Popen[bytes]:
        started.append(real(*args, **kwargs))
        return started[-1]

    monkeypatch.setattr(precompile, "CACHE_FOLDER", tmp_path)
    monkeypatch.setattr(precompile.os, "cpu_count", lambda: 2)
    monkeypatch.setattr(precompile.subprocess, "Popen", recorded)
    with precompile.second_compiler():
        assert len(started) == 1
    assert started[0].returncode is not None
    assert started[0].args[-1:] == ["curves"]  # type: ignore[index]
    (tmp_path / "curves-compiled").touch()
    with precompile.second_compiler():
        assert len(started) == 1


def test_only_what_is_not_compiled_yet_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[list[str]] = []

    def refuses(command: list[str], **kwargs: Any) -> None:
        asked.append(command[command.index("viaspline.precompile") + 1 :])
        raise FileNotFoundError("no interpreter")

    monkeypatch.setattr(precompile, "CACHE_FOLDER", tmp_path)
    monkeypatch.setattr(precompile.os, "cpu_count", lambda: 2)
    monkeypatch.setattr(precompile.subprocess, "Popen", refuses)
    for made in ("", "curves-compiled"):
        (tmp_path / (made or "nothing")).touch()
        with precompile.second_compiler(["curves", "driving"]):
            pass
    assert asked == [["curves", "driving"], ["driving"]]


def test_without_an_interpreter_the_run_goes_on_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuses(*args: Any, **kwargs: Any) -> None:
        raise FileNotFoundError("no interpreter")

    monkeypatch.setattr(precompile, "CACHE_FOLDER", tmp_path)
    monkeypatch.setattr(precompile.os, "cpu_count", lambda: 2)
    monkeypatch.setattr(precompile.subprocess, "Popen", refuses)
    with precompile.second_compiler():
        pass
