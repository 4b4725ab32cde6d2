"""Whatever becomes of the streams, a command ends with its exit code and no traceback."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

MISSION = Path(__file__).parents[3] / "examples" / "fig7-obstacles.yaml"

pytestmark = pytest.mark.skipif(not Path("/dev/full").exists(), reason="has no /dev/full")


def run(words: str, redirection: str = "", **environment: str) -> subprocess.CompletedProcess[str]:
    command = f"exec {sys.executable} -m viaspline {words} {redirection}"
    return subprocess.run(
        ["sh", "-c", command], capture_output=True, text=True, timeout=120, check=False,
        env={**os.environ, **environment},
    )  # fmt: skip


@pytest.mark.parametrize("words", [f"check {MISSION}", "--help", "check --schema"])
def test_an_output_that_is_closed_is_no_error(words: str) -> None:
    done = run(words, ">&-")
    said = [line for line in done.stderr.splitlines() if not line.startswith("reading ")]
    assert (done.returncode, said) == (0, [])


@pytest.mark.parametrize("words", ["--help", "plan --help", "--version", "check --schema"])
def test_a_reader_that_is_gone_before_anything_is_said_is_no_error(words: str) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    done = subprocess.run(
        [sys.executable, "-m", "viaspline", *words.split()],
        stdout=writing, stderr=subprocess.PIPE, timeout=120, check=False,
    )  # fmt: skip
    os.close(writing)
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.parametrize("words", [f"check {MISSION}", "--help", "check --schema"])
def test_an_output_that_is_full_is_said_on_the_error_stream(words: str) -> None:
    done = run(words, "> /dev/full")
    assert done.returncode == 2
    assert done.stderr.endswith(  # a busy machine says before it what it is reading
        "viaspline: <output>: can't be written (no space left on device); "
        "free some space, or send it elsewhere\n"
    )


@pytest.mark.parametrize("redirection", ["2>/dev/full", "2>&-", ">&- 2>&- <&-"])
def test_what_can_not_be_said_leaves_the_exit_code(redirection: str) -> None:
    assert run("check no-such-file.yaml", redirection).returncode == 2


def test_a_plain_terminal_gets_plain_characters(tmp_path: Path) -> None:
    plain = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": "ascii"}
    done = run(f"plan {MISSION} --out {tmp_path}", **plain)
    assert done.returncode == 0
    assert (done.stdout + done.stderr).isascii()
    assert "Plan - fig7-obstacles" in done.stdout
    assert "1 m/s2" in run(f"check {MISSION}", **plain).stdout
