"""The kernels of a cache put together for a wheel.

``python -m viaspline.warming.pack_kernels FOLDER``, in the environment that they were compiled in:
only what Python code calls, for the processor that numba was told of, with the lists of what each
kind of mission needs. ``compiled_wheel.py`` beside the sources does all of it.

Tested through ``kernels/test_shipped_kernels``.
"""

from __future__ import annotations

import json
import shutil
import sys
from collections.abc import Iterable, Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from viaspline.kernels.kernel_cache import CACHE_FOLDER
from viaspline.kernels.loaded_kernels import LoadedKernel
from viaspline.kernels.shipped_kernels import write_note
from viaspline.precompile import JOBS, mark_name
from viaspline.warming.kernel_list import LISTS, package_key


def numba_target() -> tuple[str, str, str]:
    """The triple, the name of the processor and its features for which numba compiles here."""
    from numba.core.registry import cpu_target

    triple, name, features = cpu_target.target_context.codegen().magic_tuple()
    return str(triple), str(name), str(features)


def pack_kernels(folder: Path, kernels: Iterable[LoadedKernel]) -> int:
    """Copy compiled kernels out of the user's cache, with a note of what they were compiled with.

    Args:
        folder: Where to; it is made.
        kernels: Which.

    Returns:
        How many of them there were.

    Raises:
        OSError: A file can't be read or written.
    """
    target, count = numba_target(), 0
    folder.mkdir(parents=True, exist_ok=True)
    for module, name in sorted({(one.module, one.name) for one in kernels}):
        files: Any = getattr(import_module(module), name)._cache._cache_file
        kept = {key: data for key, data in files._load_index().items() if key[1] == target}
        if not kept:
            continue
        home = folder / Path(files._cache_path).name
        home.mkdir(exist_ok=True)
        for data in sorted({files._index_name, *kept.values()}):
            shutil.copyfile(Path(files._cache_path) / data, home / data)
        count += len(kept)
    write_note(folder, target)
    return count


def _listed(lists: Iterable[Path]) -> Iterator[LoadedKernel]:
    for file in lists:
        for one in json.loads(file.read_text(encoding="utf-8"))["kernels"]:
            yield LoadedKernel(*one)


def pack_all(folder: Path) -> int:
    """Copy all that the lists in the user's cache name, and the lists; returns how many kernels."""
    assert CACHE_FOLDER is not None, "there is no cache"
    lists = sorted((CACHE_FOLDER / LISTS).glob(f"*-{package_key()}.json"))
    count = pack_kernels(folder, _listed(lists))
    (folder / LISTS).mkdir(exist_ok=True)
    for file in lists:
        shutil.copyfile(file, folder / LISTS / file.name)
    for job in JOBS:
        if (CACHE_FOLDER / mark_name(job)).exists():
            (folder / mark_name(job)).touch()
    return count


if __name__ == "__main__":
    print(f"{pack_all(Path(sys.argv[1]))} kernels in {sys.argv[1]}")
