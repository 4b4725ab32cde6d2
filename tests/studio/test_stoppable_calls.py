"""Calls that are stopped from another thread end soon, once, and never half way in an import."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path
from threading import Event, Thread
from typing import Any

import pytest

from viaspline.studio.stoppable_calls import Stoppable, StoppedCallError


def test_a_call_that_goes_on_for_ever_is_stopped() -> None:
    running, begun, caught = Stoppable(), Event(), Event()

    def work() -> None:
        def call() -> None:
            begun.set()
            while True:
                pass

        try:
            running.run(call)
        except StoppedCallError:
            caught.set()

    thread = Thread(target=work, daemon=True)
    thread.start()
    begun.wait()
    running.stop()
    assert caught.wait(5)
    thread.join(5)


def test_a_call_that_was_stopped_before_it_began_never_begins() -> None:
    running, calls = Stoppable(), list[int]()
    running.stop()
    with pytest.raises(StoppedCallError):
        running.run(lambda: calls.append(1))
    assert calls == []


def test_a_call_that_has_ended_is_not_stopped_any_more() -> None:
    running = Stoppable()
    assert running.run(lambda: 5) == 5
    running.stop()
    assert sum(range(1000)) == 499500  # the thread goes on


def _work(n: int) -> None:
    """Mostly short; every hundredth lasts until it is stopped, however the threads take turns."""
    while n % 100 == 0:
        pass
    sum(range(n % 400))


def test_stopping_at_any_moment_leaves_the_thread_as_it_was() -> None:
    """Stops that come while a call ends reach the call or nobody."""
    ends, stray = {"done": 0, "stopped": 0}, list[BaseException]()
    current: list[Stoppable] = []
    is_over = Event()

    def work() -> None:
        try:
            for i in range(3000):
                current[:] = [Stoppable()]
                try:
                    current[0].run(lambda n=i: _work(n))  # type: ignore[misc]
                    ends["done"] += 1
                except StoppedCallError:
                    ends["stopped"] += 1
        except BaseException as error:
            stray.append(error)
        is_over.set()

    usual = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    try:
        Thread(target=work, daemon=True).start()
        while not is_over.is_set():
            for running in tuple(current):
                running.stop()
    finally:
        sys.setswitchinterval(usual)
    assert stray == []
    assert ends["done"] + ends["stopped"] == 3000
    assert ends["stopped"] >= 30


PROFILED = """
import cProfile, threading
from viaspline.studio.stoppable_calls import Stoppable, StoppedCallError

def work():
    for call in (lambda: 7, lambda: running.stop()):
        running = Stoppable()
        try:
            running.run(call)
        except StoppedCallError:
            pass

worker = threading.Thread(target=work)
worker.start()
worker.join()
cProfile.Profile().runcall(lambda: 7)
print("profiled")
"""


def test_calls_that_could_be_stopped_leave_nothing_that_the_interpreter_looks_for() -> None:
    """CPython 3.11 profiles for ever where an exception for a thread is on its way."""
    run = [sys.executable, "-c", PROFILED]
    done = subprocess.run(run, capture_output=True, text=True, check=False, timeout=60)
    assert (done.returncode, done.stdout) == (0, "profiled\n"), done.stderr


def test_an_import_is_finished_before_the_call_is_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "slow_to_import.py").write_text("import time\ntime.sleep(0.3)\nWHOLE = True\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    running, begun, ended = Stoppable(), Event(), Event()
    seen: list[Any] = []

    def call() -> None:
        begun.set()
        seen.append(__import__("slow_to_import").WHOLE)
        while True:
            pass

    def work() -> None:
        try:
            running.run(call)
        except StoppedCallError:
            ended.set()

    Thread(target=work, daemon=True).start()
    begun.wait()
    deadline = time.monotonic() + 60
    while not ended.is_set():
        running.stop()
        time.sleep(0.01)
        assert time.monotonic() < deadline
    assert seen == [True]
