"""What is said when a run has to compile: what, and how long that took before on this machine.

What each kernel took is kept beside the compiled kernels, for each kind of processor. After an
update only those count that have to be compiled again.
"""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Final

from llvmlite import binding

from viaspline.kernels import kernel_cache
from viaspline.kernels.compile_events import compile_times
from viaspline.kernels.kernel_cache import SOURCES
from viaspline.precompile import Job

FILE_NAME: Final = "compile-times.json"
WORDS: Final[Mapping[Job, str]] = {
    "curves": "paths",
    "driving": "drives and turns",
    "fleets": "fleets",
}
MEASURED_S: Final[Mapping[Job, float]] = {"curves": 40.0, "driving": 40.0, "fleets": 60.0}
"""What they took on one core of an AMD EPYC of 2022 (Zen 4) [s]."""


@contextmanager
def first_run(jobs: Sequence[Job]) -> Iterator[Callable[[], str]]:
    """Within the block it is kept how long kernels take to compile; gives what says so beforehand.

    Args:
        jobs: What the run will need.
    """
    before, took = _before(jobs), dict[str, float]()
    try:
        with compile_times(took.__setitem__):
            yield lambda: notice(jobs, before)
    finally:
        if took:
            _keep(jobs, before | took)


def notice(jobs: Sequence[Job], before: Mapping[str, float]) -> str:
    """What is compiled, and how long that took before.

    Args:
        jobs: What the run will need.
        before: How long each kernel took when it was last compiled here [s].

    >>> notice(["curves", "driving"], {})
    'compiling the kernels of paths, drives and turns, once per machine: that takes 80 s or less
    on one free core of an AMD EPYC; here it was never measured'
    """
    names = [WORDS[job] for job in jobs if job in WORDS]
    what = ", ".join(names)
    again = [seconds for kernel, seconds in before.items() if not is_compiled(kernel)]
    if again:
        kernels = f"{len(again)} kernel{'s' if len(again) > 1 else ''}"
        last = f"that took {max(sum(again), 1.0):.0f} s here when it was last done"
        return f"compiling {kernels} of {what}, once: {last}"
    if before:
        return f"compiling kernels of {what} that were never compiled here, once"
    most = sum(MEASURED_S.get(job, 0.0) for job in jobs)
    there = f"that takes {most:.0f} s or less on one free core of an AMD EPYC"
    return f"compiling the kernels of {what}, once per machine: {there}; here it was never measured"


def is_compiled(kernel: str) -> bool:
    """Whether a kernel was compiled from its sources as they are."""
    module, _, name = kernel.rpartition(".")
    if module not in SOURCES.of:
        return True  # there is none of that name any more
    return any(
        any((folder / kernel_cache.folder_name(module)).glob(f"*.{name}-*.nbi"))
        for folder in kernel_cache.kernel_folders()
    )


def _file() -> Path | None:
    folder = kernel_cache.CACHE_FOLDER
    return None if folder is None else folder.parent / FILE_NAME


def _machine() -> str:
    return f"{binding.get_host_cpu_name()} with {os.cpu_count()} cores"


def _all() -> dict[str, Any]:
    file = _file()
    if file is not None:
        with suppress(OSError, ValueError):
            read = json.loads(file.read_text(encoding="utf-8"))
            return read if isinstance(read, dict) else {}
    return {}


def _before(jobs: Sequence[Job]) -> dict[str, float]:
    with suppress(AttributeError, TypeError, ValueError):
        kept = _all().get(_machine(), {}).get("+".join(jobs), {})
        return {str(kernel): float(seconds) for kernel, seconds in kept.items()}
    return {}


def _keep(jobs: Sequence[Job], took: Mapping[str, float]) -> None:
    file, everything = _file(), _all()
    if file is None:
        return
    here = everything.setdefault(_machine(), {})
    here["+".join(jobs)] = {kernel: round(took[kernel], 3) for kernel in sorted(took)}
    with suppress(OSError):
        number, name = tempfile.mkstemp(dir=file.parent)
        with os.fdopen(number, "w", encoding="utf-8") as written:
            json.dump(everything, written, indent=0)
        Path(name).replace(file)
