"""Which compiled kernels a process has loaded, and how another one loads them beforehand.

A kernel is loaded from disk, or compiled, when it is first called. Who must not wait then has it
loaded before. A kernel is named by its module, its name and the types that it was compiled for.

Tested through ``warming/test_warm_up``.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from importlib import import_module
from typing import Any, NamedTuple

from viaspline.kernels.kernel_cache import SOURCES


class LoadedKernel(NamedTuple):
    """A kernel and what it was compiled for.

    Attributes:
        module: The dotted name of its module.
        name: Its name there.
        types: The types of its arguments, as numba writes them.
    """

    module: str
    name: str
    types: str


def kernel_functions() -> Iterator[tuple[str, str, Any]]:
    """The module, the name and the compiler of every kernel that was imported."""
    for module, held in sorted(sys.modules.items()):
        if module in SOURCES.of and held is not None:
            for name, value in sorted(vars(held).items()):
                function = getattr(value, "py_func", None)
                if function is not None and function.__module__ == module:
                    yield module, name, value


def loaded_kernels() -> frozenset[LoadedKernel]:
    """All kernels that Python can call and that this process has loaded or compiled."""
    return frozenset(
        LoadedKernel(module, name, str(types))
        for module, name, compiler in kernel_functions()
        if not compiler.targetoptions.get("no_cpython_wrapper")
        for types in compiler.overloads
    )


def load_kernels(wanted: Iterable[LoadedKernel]) -> tuple[LoadedKernel, ...]:
    """Load kernels that were compiled before.

    Args:
        wanted: Which; those that are loaded already cost nothing.

    Returns:
        Those that nobody has compiled yet.
    """
    missing = []
    for one in wanted:
        compiler = getattr(import_module(one.module), one.name, None)
        if compiler is None or not _is_loaded(compiler, one.types):
            missing.append(one)
    return tuple(missing)


def _is_loaded(compiler: Any, types: str) -> bool:
    """Whether what was compiled for these types is loaded now, or was before."""
    if any(str(types_of_one) == types for types_of_one in compiler.overloads):
        return True
    for signature in compiler._cache.kept():
        if str(signature) == types:
            compiler.compile(signature)
            return True
    return False
