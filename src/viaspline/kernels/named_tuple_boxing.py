"""Named tuples given to Python so that an interrupt meanwhile is an exception, and no crash.

Ctrl-C, or the studio where it stops a plan, is an exception that Python raises at its next step.
While a kernel runs there is none, so one that comes then is raised in what numba calls to hand the
result over. Of an array that isn't there for it numba makes nothing, and its named tuples are made
of that all the same, which ends the process. Here they aren't, and the exception goes on.

Tested through ``kernels/test_jit``.
"""

from __future__ import annotations

from typing import Any

from numba.core import cgutils, types
from numba.core.boxing import box_tuple
from numba.core.pythonapi import _boxers


def _boxed(kind: Any, value: Any, context: Any) -> Any:
    """A named tuple as a Python object, or nothing where an exception is set."""
    constants, python, builder = context.env_manager, context.pyapi, context.builder
    utils: Any = cgutils
    of_class = constants.read_const(constants.add_const(kind.instance_class))
    made = utils.alloca_once_value(builder, python.get_null_object())
    items = box_tuple(kind, value, context)
    with builder.if_then(utils.is_null(builder, python.err_occurred()), likely=True):
        builder.store(python.call(of_class, items), made)
    python.decref(items)
    return builder.load(made)


def box_named_tuples() -> None:
    """Have numba make named tuples so from now on."""
    for kind in (types.NamedTuple, types.NamedUniTuple):
        _boxers.functions[kind] = _boxed
