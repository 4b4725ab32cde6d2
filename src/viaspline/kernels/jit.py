"""The one decorator of all kernels, and where their compiled form is kept.

numba's own cache does not notice an edit of a helper in another file, and refuses to import a
cached kernel when its folder can't be written. So the folder's name is a hash of every kernel
source, of the versions of numba and numpy (whose constants are compiled in) and of the processor,
and without a writable folder there is no cache.
"""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, TypeVar

import numba
import numpy
from llvmlite import binding
from numba.core import config, event, types

_Function = TypeVar("_Function", bound=Callable[..., Any])


def _fingerprint() -> str:
    digest = hashlib.sha256()
    root = Path(__file__).parent
    for source in sorted(root.rglob("*.py")):
        digest.update(source.relative_to(root).as_posix().encode())
        digest.update(source.read_bytes())
    parts = (numba.__version__, numpy.__version__, sys.version, binding.get_host_cpu_name())
    digest.update("|".join(parts).encode())
    return digest.hexdigest()[:16]


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


def _take_literals_as_values(dispatcher: Any) -> None:
    """Let ``f(0)`` and ``f(n)`` be one to numba, which would compile a kernel for each literal."""
    plain = dispatcher.get_call_template
    value: Callable[[Any], Any] = types.unliteral

    def template(args: Any, kws: Any) -> Any:
        return plain(tuple(map(value, args)), {name: value(kind) for name, kind in kws.items()})

    dispatcher.get_call_template = template


def _is_of_ours(signature: Any) -> bool:
    """Whether every tuple among the arguments is of a class of this package."""
    classes = [
        getattr(kind, "instance_class", None) for kind in getattr(signature, "args", signature)
    ]
    return all(one is None or one.__module__.startswith("viaspline.") for one in classes)


def _keep_ours_alone(dispatcher: Any) -> None:
    """Don't keep on disk what was compiled for somebody's own packed world.

    Its class may stand in a script that another program can't import, and then numba can't read
    the index of the kernel any more.
    """
    cache = dispatcher._cache
    save, load = cache.save_overload, cache.load_overload
    cache.save_overload = lambda sig, data: save(sig, data) if _is_of_ours(sig) else None
    cache.load_overload = lambda sig, target: load(sig, target) if _is_of_ours(sig) else None


def _compile(function: _Function, **options: Any) -> _Function:
    settings: Any = config  # numba makes its settings as it reads them
    kept = settings.CACHE_DIR
    if CACHE_FOLDER is not None:
        settings.CACHE_DIR = str(CACHE_FOLDER)
    njit: Any = numba.njit
    try:
        cache = CACHE_FOLDER is not None
        compiled: _Function = njit(
            cache=cache, error_model="numpy", nogil=True, no_cfunc_wrapper=True, **options
        )(function)
    finally:
        settings.CACHE_DIR = kept
    if hasattr(compiled, "get_call_template"):  # else the JIT is off
        _take_literals_as_values(compiled)
        _keep_ours_alone(compiled)
    return compiled


def kernel(function: _Function) -> _Function:
    """Compile an array function with numba; cached on disk where that is possible.

    The cache folder is set only while numba looks at it, so the caller's own numba functions keep
    theirs.
    """
    return _compile(function)


def inner(function: _Function) -> _Function:
    """Compile a function that only kernels call: without a door from Python it compiles sooner.

    With ``NUMBA_DISABLE_JIT=1`` it is an ordinary function and can be tested by itself.
    """
    return _compile(function, no_cpython_wrapper=True)


def uncounted(function: _Function) -> _Function:
    """Compile a function that kernels call, without counting references to the arrays it is given.

    It must neither make nor return arrays. For what is called often with a large packed world: its
    every array is counted at every call otherwise, which takes longer than a distance does.
    """
    return _compile(function, no_cpython_wrapper=True, _nrt=False)


def inlined(function: _Function) -> _Function:
    """Compile a function right into the kernels that call it: for the inside of hot loops.

    It must neither make nor return arrays. numba counts references at every call; not here.
    """
    return _compile(function, no_cpython_wrapper=True, forceinline=True, _nrt=False)


def fused(function: _Function) -> _Function:
    """Take a function as a part of the one kernel that calls it.

    Every function of its own is linked with all that it reaches and optimised by itself before the
    kernel is. So this serves what stands between a kernel and the distance code; in long kernels
    numba's types take longer than that.
    """
    return _compile(function, no_cpython_wrapper=True, inline="always")


class _CompileListener(event.Listener):
    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell

    def on_start(self, event: Any) -> None:
        function = event.data["dispatcher"].py_func
        if function.__module__.startswith("viaspline."):
            self._tell(f"{function.__module__.rsplit('.', 1)[-1]}.{function.__name__}")

    def on_end(self, event: Any) -> None:
        pass


@contextmanager
def compile_progress(tell: Callable[[str], None]) -> Iterator[None]:
    """Within the block, ``tell`` hears the name of every kernel that has to be compiled."""
    listener = _CompileListener(tell)
    with event.install_listener("numba:compile", listener):
        yield
