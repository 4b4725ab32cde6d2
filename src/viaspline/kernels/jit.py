"""The one decorator of all kernels; where their compiled form is kept: ``kernel_cache``."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar

import numba
from numba.core import types

from viaspline.kernels.kernel_cache import KernelCache, is_kept
from viaspline.kernels.named_tuple_boxing import box_named_tuples

box_named_tuples()

_Function = TypeVar("_Function", bound=Callable[..., Any])


def _take_literals_as_values(dispatcher: Any) -> None:
    """Let ``f(0)`` and ``f(n)`` be one to numba, which would compile a kernel for each literal."""
    plain = dispatcher.get_call_template
    value: Callable[[Any], Any] = types.unliteral

    def template(args: Any, kws: Any) -> Any:
        return plain(tuple(map(value, args)), {name: value(kind) for name, kind in kws.items()})

    dispatcher.get_call_template = template


def _compile(function: _Function, **options: Any) -> _Function:
    """Compile a function with options that are its own.

    Those that aren't said numba takes over from the caller for which it is first compiled, and
    keeps on disk for all: of the same sources one order of compiling made certificates that took
    twice as long as those of another.
    """
    njit: Any = numba.njit
    settled = {"error_model": "numpy", "forceinline": False, "_nrt": True} | options
    compiled: _Function = njit(nogil=True, no_cfunc_wrapper=True, **settled)(function)
    if hasattr(compiled, "get_call_template"):  # else the JIT is off
        dispatcher: Any = compiled
        cache: Any = KernelCache
        _take_literals_as_values(dispatcher)
        if is_kept(function):
            dispatcher._cache = cache(function)
            dispatcher.compile = partial(_compile_or_let_go, dispatcher.compile, dispatcher._cache)
    return compiled


def _compile_or_let_go(compiling: Callable[[Any], Any], cache: Any, signature: Any) -> Any:
    """Compile for a signature; no other process waits for what fails or is interrupted."""
    try:
        return compiling(signature)
    except BaseException:
        cache.let_go()
        raise


def kernel(function: _Function) -> _Function:
    """Compile an array function with numba; cached on disk where that is possible."""
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

    It must neither make nor return arrays. numba counts references at every call; not here. So are
    those that are given a whole packed world: a hundred words at every call take longer than that.
    """
    return _compile(function, no_cpython_wrapper=True, forceinline=True, _nrt=False)


def fused(function: _Function) -> _Function:
    """Take a function as a part of the one kernel that calls it.

    Every function of its own is linked with all that it reaches and optimised by itself before the
    kernel is. So this serves what stands between a kernel and the distance code; in long kernels
    numba's types take longer than that.
    """
    return _compile(function, no_cpython_wrapper=True, inline="always")
