from __future__ import annotations

import subprocess
import sys

import pytest

CODE = """
import os, signal, sys
from viaspline.report.terminal import interrupts
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
        "import ctypes, os, signal, sys; from viaspline.report.terminal import interrupts\n"
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


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_what_a_signal_left_half_made_does_not_complain_when_it_is_deleted() -> None:
    code = (
        "import os, signal; from viaspline.report.terminal import interrupts\n"
        "class Half:\n"
        "    def __init__(self):\n"
        "        os.kill(os.getpid(), signal.SIGINT)\n"
        "        self.made = True\n"
        "    def __del__(self): del self.made\n"
        "interrupts.install()\n"
        "try: Half()\n"
        "except KeyboardInterrupt as error: error.__traceback__ = None\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], text=True, capture_output=True, timeout=60, check=True
    )
    assert done.stderr == ""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="takes a lock of glibc")
@pytest.mark.parametrize(("name", "code"), [("SIGINT", 130), ("SIGTERM", 143)])
def test_work_that_lets_no_handler_run_is_tidied_and_ended(name: str, code: int) -> None:
    # A call into C that goes on for ever without the interpreter's lock, as a long kernel does.
    source = (
        "import ctypes, os, signal, threading\n"
        "from viaspline.report.terminal import interrupts\n"
        "interrupts.GRACE_S = 0.1\n"
        "interrupts.install()\n"
        "libc, lock = ctypes.CDLL(None), ctypes.create_string_buffer(64)\n"
        "with interrupts.undone_at_the_end(lambda: print('undone', flush=True)):\n"
        f"    threading.Timer(0.2, os.kill, [os.getpid(), signal.{name}]).start()\n"
        "    libc.pthread_mutex_lock(lock), libc.pthread_mutex_lock(lock)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", source], text=True, capture_output=True, timeout=120, check=False
    )
    assert done.returncode == code
    assert done.stdout == "undone\n"
    assert done.stderr.endswith("ed; no file was left half written\n")
