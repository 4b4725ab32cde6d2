"""numba compiles the same code sooner: a fourth of its time goes into what serves nobody.

It looks for garbage in circles while it makes a million objects that stay. It asks for the defaults
of thirty options whenever it compares two sets of them, which is at every call in a kernel. It
looks for variables inside of words and numbers, by way of an abstract class. Its own functions,
such as ``np.empty``, get a door from C that nobody goes through. And it makes machine code of
every function, also of those that only kernels call: a kernel has what it calls in its own code,
which is made of what LLVM reads.
"""

from __future__ import annotations

import gc
from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, Final

from numba.core import codegen, environment, event, ir
from numba.core.targetconfig import TargetConfig
from numba.core.typing import templates

_NO_VARIABLES: Final = frozenset(
    {str, int, bool, type(None), ir.Loc, ir.Const, ir.Global, ir.FreeVar, ir.Arg}
)
"""The types of what stands in an instruction and holds no variable of its function."""

_own_functions: Final[Any] = getattr(templates, "_OverloadFunctionTemplate", None)
_variables_in: Final[Any] = getattr(ir.Inst, "_rec_list_vars", None)
_decorator_of: Final[Any] = getattr(_own_functions, "_get_jit_decorator", None)
_engines: Final[Any] = getattr(codegen, "JITCPUCodegen", None)
_added_to_engine: Final[Any] = getattr(_engines, "_add_module", None)
_environment_set: Final[Any] = getattr(_engines, "set_env", None)
_libraries: Final[Any] = getattr(codegen, "JITCodeLibrary", None)
_made_ready: Final[Any] = getattr(_libraries, "_finalize_specific", None)
_environment_named: Final[Any] = getattr(environment, "lookup_environment", None)
_kept_with_code: Final[Any] = getattr(_libraries, "serialize_using_object_code", None)

_OURS, _DOOR, _OF_ITSELF, _ENVIRONMENT = (
    "_ZN9viaspline", "_ZN7cpython", ".numba.unresolved$", "_ZN08NumbaEnv",
)  # fmt: skip
"""How names begin: of our functions, of doors from Python, of a function that calls itself, and of
what a function finds its objects by."""


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


def is_a_part(module: Any) -> bool:
    """Whether all that a module of LLVM defines becomes a part of the kernels that call it."""
    names = [one.name for one in module.functions if not one.is_declaration]
    return (
        any(name.startswith(_OURS) for name in names)
        and not any(name.startswith(_DOOR) for name in names)
        and not any(one.name.startswith(_OF_ITSELF) for one in module.global_variables)
    )


def _add_to_engine(engines: Any, module: Any) -> Any:
    """Have machine code made of a module, unless it is a part of others."""
    return None if is_a_part(module) else _added_to_engine(engines, module)


def _set_environment(engines: Any, name: str, objects: Any) -> None:
    """Tell machine code where a function's objects are, if there is any."""
    if engines._engine.is_symbol_defined(name):
        _environment_set(engines, name, objects)


def _make_ready(library: Any) -> None:
    """Make machine code, and tell it where the objects of its parts are."""
    _made_ready(library)
    if is_a_part(library._final_module):
        return
    for one in library._final_module.global_variables:
        if one.name.startswith(_ENVIRONMENT):
            found = _environment_named(one.name)
            if found is not None:
                library.codegen.set_env(one.name, found)


def _keep(library: Any) -> Any:
    """What is kept of a function: no machine code of a part."""
    library._ensure_finalized()
    if is_a_part(library._final_module):
        return library.serialize_using_bitcode()
    return _kept_with_code(library)


def _make_no_code_of_parts() -> None:
    """Have numba leave out the machine code of what only kernels call."""
    needed = (_added_to_engine, _environment_set, _environment_named, _made_ready, _kept_with_code)
    if all(needed) and hasattr(_libraries, "serialize_using_bitcode"):
        _engines._add_module, _engines.set_env = _add_to_engine, _set_environment
        _libraries._finalize_specific = _make_ready
        _libraries.serialize_using_object_code = _keep


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
    _make_no_code_of_parts()
