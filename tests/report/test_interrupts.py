from __future__ import annotations

import subprocess
import sys

import pytest

CODE = """
import os, signal, sys
from viaspline.report import interrupts
interrupts.install()
try:
    os.kill(os.getpid(), signal.{name})
    signal.pause() if hasattr(signal, "pause") else None
except BaseException as error:
    first = type(error).__name__
try:
    interrupts.come_through()
except BaseException as error:
    print(first, type(error).__name__)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize(
    ("name", "raised"), [("SIGINT", "KeyboardInterrupt"), ("SIGTERM", "Terminated")]
)
def test_a_signal_that_was_swallowed_comes_through_later(name: str, raised: str) -> None:
    command = [sys.executable, "-c", CODE.format(name=name)]
    done = subprocess.run(command, text=True, capture_output=True, timeout=60, check=True)
    assert done.stdout.split() == [raised, raised]


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_a_signal_in_a_callback_that_cannot_raise_is_not_shown_as_a_traceback() -> None:
    code = (
        "import ctypes, os, signal, sys; from viaspline.report import interrupts\n"
        "interrupts.install()\n"
        "back = ctypes.CFUNCTYPE(None)(lambda: os.kill(os.getpid(), signal.SIGINT))\n"
        "back()\n"
        "print(interrupts.remembered().__name__)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], text=True, capture_output=True, timeout=60, check=False
    )
    assert done.stderr == ""
    assert done.stdout == "KeyboardInterrupt\n"
