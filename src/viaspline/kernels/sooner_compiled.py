"""numba compiles the same code sooner: a sixth of its time goes into what serves nobody.

It looks for garbage in circles while it makes a million objects that stay. It asks for the defaults
of thirty options whenever it compares two sets of them, which is at every call in a kernel. It
looks for variables inside of words and numbers, by way of an abstract class. And its own functions,
such as ``np.empty``, get a door from C that nobody goes through.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, Final

from numba.core import event, ir
from numba.core.targetconfig import TargetConfig
from numba.core.typing import templates

_NO_VARIABLES: Final = frozenset(
    {str, int, bool, type(None), ir.Loc, ir.Const, ir.Global, ir.FreeVar, ir.Arg}
)
"""The types of what stands in an instruction and holds no variable of its function."""

_own_functions: Final[Any] = getattr(templates, "_OverloadFunctionTemplate", None)
_variables_in: Final[Any] = getattr(ir.Inst, "_rec_list_vars", None)
_decorator_of: Final[Any] = getattr(_own_functions, "_get_jit_decorator", None)


class _NoCollections(event.Listener):
    """Python's garbage collector rests while something of ours is compiled."""

    def __init__(self) -> None:
        self._depth, self._rests = 0, False

    def on_start(self, event: Any) -> None:
        function = event.data["dispatcher"].py_func
        if not self._depth and function.__module__.startswith("viaspline.") and gc.isenabled():
            self._rests = True
            gc.disable()
        self._depth += 1

    def on_end(self, event: Any) -> None:
        del event
        self._depth = max(self._depth - 1, 0)  # an interrupt may have come before it was counted
        if not self._depth and self._rests:
            self._rests = False
            gc.enable()


@cache
def _defaults(kind: Any) -> Mapping[str, Any]:
    return {name: option.default for name, option in kind.options.items()}


def _values(options: Any) -> Mapping[str, Any]:
    """The value of every option."""
    kind: Any = options.__class__
    return {**_defaults(kind), **options._values}


def _variables(instruction: Any, value: Any) -> list[Any]:
    """The variables in a part of an instruction."""
    found: list[Any] = [] if type(value) in _NO_VARIABLES else _variables_in(instruction, value)
    return found


def _decorator(template: Any) -> Callable[..., Any]:
    """What compiles a function of numba's own."""
    decorator = _decorator_of(template)
    return lambda **options: decorator(**{"no_cfunc_wrapper": True, **options})


def compile_sooner() -> None:
    """Have numba do without all of that from now on.

    These are places of its own, which another numba may have elsewhere: that compiles as it does.
    """
    register: Any = event.register
    register("numba:compile", _NoCollections())
    kinds: tuple[Any, ...] = (TargetConfig, ir.Inst, _own_functions)
    names = ("values", "_rec_list_vars", "_get_jit_decorator")
    for kind, name, function in zip(kinds, names, (_values, _variables, _decorator), strict=True):
        if hasattr(kind, name):
            setattr(kind, name, function)
