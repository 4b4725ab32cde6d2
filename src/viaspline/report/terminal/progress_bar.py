"""Progress on the error stream, only of what takes longer than a second.

Tested through ``test_cli``.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import RLock, Timer

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

from viaspline.report.terminal.interrupts import come_through

SILENT_S = 1.0  # [s]


class ProgressBar:
    """Says what is going on, and keeps the wall-clock time of every stage.

    On a terminal it is a bar that appears after a second; elsewhere one line is written for every
    stage that has not ended after a second, and for the compiling of kernels.

    Args:
        quiet: Say nothing; only keep the times.
    """

    def __init__(self, *, quiet: bool = False) -> None:
        self.times: dict[str, float] = {}
        self._console = Console(file=sys.stderr, markup=False, highlight=False)
        self._quiet = quiet
        self._compiled = 0
        self._text = ""
        self._bar: Progress | None = None
        self._task: int | None = None
        self._told: set[str] = set()
        self._lock = RLock()
        self._depth = 0

    @contextmanager
    def stage(self, name: str, text: str) -> Iterator[None]:
        """Within the block the stage ``name`` is going on, which is called ``text``."""
        come_through()
        start = time.perf_counter()
        self._text, self._depth = text, self._depth + 1
        timer = Timer(SILENT_S, self._appear)
        timer.daemon = True
        timer.start()
        try:
            yield
        finally:
            timer.cancel()
            self._depth -= 1
            self._disappear()
            self.times[name] = self.times.get(name, 0.0) + time.perf_counter() - start

    def compiling(self, notice: Callable[[], str], kernel: str) -> None:
        """Hear that a kernel is being compiled.

        Args:
            notice: Gives what is said when the first one is: what is compiled, and how long all of
                that takes.
            kernel: The one that is begun.
        """
        come_through()
        self._compiled += 1
        if self._compiled == 1:
            self._say(notice())
        self.update(f"compiling: {self._compiled}, {kernel}")

    def fraction(self, done: float) -> None:
        """Hear how much of the stage is done, from 0 to 1."""
        come_through()
        if self._bar is not None and self._task is not None:
            self._bar.update(self._task, completed=done, total=1.0, description=self._text)  # type: ignore[arg-type]

    def driven(self, time: float, distance: float, length: float) -> None:
        """Hear how far the robot has come [s, m], and how long its path is [m]."""
        del time
        self.fraction(distance / length if length > 0 else 1.0)

    def update(self, text: str) -> None:
        """Say something else about the stage."""
        if self._bar is not None and self._task is not None:
            self._bar.update(self._task, description=text)  # type: ignore[arg-type]

    def _say(self, line: str) -> None:
        if not self._quiet:
            self._console.print(line, soft_wrap=True)

    def _appear(self) -> None:
        with self._lock:
            if not self._quiet and self._depth and self._bar is None:
                self._start_bar()

    def _start_bar(self) -> None:
        if not self._console.is_terminal:
            if self._text not in self._told:
                self._told.add(self._text)
                self._say(f"{self._text} …")
            return
        columns = (
            SpinnerColumn(),
            TextColumn("{task.description}"),
            BarColumn(24),
            TimeElapsedColumn(),
        )
        bar = Progress(*columns, console=self._console, transient=True)
        self._task = bar.add_task(self._text, total=None)
        bar.start()
        self._bar = bar

    def _disappear(self) -> None:
        with self._lock:
            bar, self._bar, self._task = self._bar, None, None
            if bar is not None:
                bar.stop()
