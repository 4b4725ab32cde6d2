"""Where the compiled form of the kernels is kept.

numba's own cache does not notice an edit of a helper in another file, is bound to the folder of
the sources, and refuses to import a cached kernel when its own folder can't be written. So a
kernel's folder is named after its module and a hash of all the sources that it reaches
(``source_keys``), below one that is named after the versions of Python, of numba and of numpy
(whose constants are compiled in) and the processor; and without a writable folder there is no
cache. What a wheel brings along (``shipped_kernels``) is taken before what lies there.

Tested through ``kernels/test_jit``.
"""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

import numba
import numpy
from llvmlite import binding
from numba.core import types
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile

from viaspline.kernels.compile_lock import CompileLock
from viaspline.kernels.shipped_kernels import SHIPPED
from viaspline.kernels.sooner_compiled import compile_sooner
from viaspline.kernels.source_keys import PACKAGE, SourceKeys

compile_sooner()

SOURCES = SourceKeys.read(Path(__file__).parent)


def _fingerprint() -> str:
    parts = (numba.__version__, numpy.__version__, sys.version, binding.get_host_cpu_name())
    return hashlib.sha256("|".join(parts).encode()).hexdigest()[:16]


def _is_ours(folder: Path) -> bool:
    """Whether the folder can be written, and by nobody else: what lies in it will be executed."""
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if hasattr(os, "getuid") and folder.stat().st_uid != os.getuid():
            return False
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


def _candidates() -> Iterator[Path]:
    if chosen := os.environ.get("VIASPLINE_CACHE_DIR"):
        yield Path(chosen)
    if xdg := os.environ.get("XDG_CACHE_HOME"):
        yield Path(xdg) / "viaspline"
    with suppress(RuntimeError):  # no home folder
        yield Path.home() / ".cache" / "viaspline"
    user = os.getuid() if hasattr(os, "getuid") else "user"
    yield Path(tempfile.gettempdir()) / f"viaspline-{user}"


def cache_folder() -> Path | None:
    """The folder of the compiled kernels, or None where nothing can be written.

    ``VIASPLINE_CACHE_DIR`` is tried first, then the user's cache folder, then the temporary one.
    """
    name = _fingerprint()
    for root in _candidates():
        if _is_ours(root) and _is_ours(root / name):
            return root / name
    return None


CACHE_FOLDER = cache_folder()
NOWHERE = Path(os.devnull)
"""Where nothing can be kept, and nothing is found."""


def folder_name(module: str) -> str:
    """The name of the folder of a module's kernels, of its sources as they are."""
    return f"{module.removeprefix(f'{PACKAGE}.')}-{SOURCES.of[module]}"


def kernel_folders() -> tuple[Path, ...]:
    """Where compiled kernels are looked for, in this order."""
    shipped = () if SHIPPED is None else (SHIPPED.folder,)
    return shipped if CACHE_FOLDER is None else (*shipped, CACHE_FOLDER)


class _KernelFolder:
    """Where numba keeps the kernels of a module: nothing of it names the sources' own folder."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self._py_file = function.__code__.co_filename  # numba's warnings name it
        self._line = function.__code__.co_firstlineno
        self._key = SOURCES.of[function.__module__]
        self._name = folder_name(function.__module__)

    def get_cache_path(self) -> str:
        return str((CACHE_FOLDER or NOWHERE) / self._name)

    def ensure_cache_path(self) -> None:
        Path(self.get_cache_path()).mkdir(exist_ok=True)

    def get_source_stamp(self) -> str:
        return self._key

    def get_disambiguator(self) -> str:
        return str(self._line)

    @classmethod
    def from_function(cls, function: Callable[..., Any], _: str) -> _KernelFolder:
        return cls(function)


class _KernelFiles(CompileResultCacheImpl):
    _locator_classes: Any = [_KernelFolder]  # noqa: RUF012 (numba's own way to say it)


class KernelCache(FunctionCache):
    """What is kept of a kernel.

    What was compiled for somebody's own packed world isn't: its class may stand in a script that
    another program can't import, and then numba can't read the kernel's index any more. A class of
    ours counts by the sources of its module.
    """

    _impl_class = _KernelFiles

    def __init__(self, function: Callable[..., Any]) -> None:
        base: Any = super()
        base.__init__(function)
        impl: Any = self._impl
        self._shipped: Any = None
        self._lock = CompileLock(Path(self.cache_path) / f"{impl.filename_base}.lock")
        self._compiling: set[Any] = set()
        if SHIPPED is not None:
            folder = SHIPPED.folder / Path(self.cache_path).name
            stamp = impl.locator.get_source_stamp()
            files: Any = IndexDataCacheFile
            self._shipped = files(str(folder), impl.filename_base, stamp)

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """What is kept for a signature, or None: then the caller compiles it and has it kept."""
        if not _is_of_ours(sig):
            return None
        kept = self._load_shipped(sig, target_context)
        kept = self._load_own(sig, target_context) if kept is None else kept
        if kept is not None or sig in self._compiling:
            return kept
        self._compiling.add(sig)
        if self._lock.take():
            kept = self._load_own(sig, target_context)
        if kept is not None:
            self._compiled(sig)
        return kept

    def _compiled(self, sig: Any) -> None:
        self._compiling.discard(sig)
        self._lock.give_back()

    def _load_own(self, sig: Any, context: Any) -> Any:
        base: Any = super()
        return base.load_overload(sig, context)

    def _load_shipped(self, sig: Any, context: Any) -> Any:
        if self._shipped is None or SHIPPED is None:
            return None
        context.refresh()
        signature, _, *rest = self._index_key(sig, context.codegen())
        data = self._shipped.load((signature, SHIPPED.target, *rest))
        impl: Any = self._impl
        return None if data is None else impl.rebuild(context, data)

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep what was compiled for a signature, if that can be.

        Raises:
            KeyboardInterrupt: When one came where llvmlite is told what was compiled: that is
                called back from C, which swallows exceptions, and isn't told then.
        """
        base: Any = super()
        if not _is_of_ours(sig):
            return
        try:
            base.save_overload(sig, data)
        except OSError:  # the folder can't be written any more: compiled, not kept
            pass
        except RuntimeError as error:
            raise KeyboardInterrupt from error
        if sig in self._compiling:
            self._compiled(sig)

    def let_go(self) -> None:
        """Let other processes compile what this one failed at."""
        while self._compiling:
            self._compiled(next(iter(self._compiling)))

    def kept(self) -> set[Any]:
        """The signatures for which something is kept."""
        files: list[Any] = [self._cache_file, self._shipped]
        return {key[0] for one in files if one is not None for key in one._load_index()}

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        base: Any = super()
        modules = sorted({one.__module__ for one in _classes(sig)})
        keys = tuple(SOURCES.of.get(module, "") for module in modules)
        return (*base._index_key(sig, codegen), keys)


def _classes(signature: Any) -> set[type]:
    """The classes of the named tuples among a kernel's arguments, and of those inside of them."""
    todo, found = list(getattr(signature, "args", signature)), set()
    while todo:
        kind = todo.pop()
        found |= {kind.instance_class} if hasattr(kind, "instance_class") else set()
        todo += kind.types if isinstance(kind, types.BaseTuple) and hasattr(kind, "types") else ()
    return found


def _is_of_ours(signature: Any) -> bool:
    return all(one.__module__.startswith("viaspline.") for one in _classes(signature))


def is_kept(function: Callable[..., Any]) -> bool:
    """Whether a function's compiled form is kept: a kernel's is, if a folder can be written."""
    return (CACHE_FOLDER or SHIPPED) is not None and function.__module__ in SOURCES.of
