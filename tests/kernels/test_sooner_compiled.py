import gc
import os
import subprocess
import sys
from pathlib import Path

import pytest
from numba.core import errors, ir
from numba.core.compiler import Flags

from viaspline.kernels import jit
from viaspline.kernels.sooner_compiled import _variables_in, is_a_part

compiled = pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="nothing is compiled with the JIT off"
)


def _half(x: float) -> float:
    return 0.5 * x


def _impossible(x: float) -> float:
    return x.nothing_of_that_name  # type: ignore[attr-defined, no-any-return]


@compiled
def test_garbage_is_collected_again_once_something_was_compiled_or_could_not_be() -> None:
    _half.__module__ = _impossible.__module__ = "viaspline.kernels.example"
    assert gc.isenabled()
    assert jit.kernel(_half)(3.0) == 1.5
    assert gc.isenabled()
    with pytest.raises(errors.TypingError):
        jit.kernel(_impossible)(3.0)
    assert gc.isenabled()


@compiled
def test_who_has_turned_the_collector_off_finds_it_off() -> None:
    gc.disable()
    try:
        jit.kernel(lambda x: x + 1)(3)
        assert not gc.isenabled()
    finally:
        gc.enable()


def test_options_have_the_values_that_were_set_and_the_others_their_defaults() -> None:
    flags = Flags()
    flags.nrt, flags.error_model = True, "numpy"
    assert flags.values() == {name: getattr(flags, name) for name in Flags.options}
    assert list(flags.values()) == list(Flags.options)
    assert flags == flags.copy()
    assert flags != Flags()


def test_the_variables_of_instructions_are_those_that_numba_finds() -> None:
    place = ir.Loc("here.py", 1)
    scope = ir.Scope(None, place)
    x, y, z = (ir.Var(scope, name, place) for name in "xyz")
    call = ir.Expr.call(x, [y], (("key", z),), place)
    made: list[ir.Stmt] = [
        ir.Assign(call, x, place),
        ir.Assign(ir.Const(3, place), y, place),
        ir.Assign(ir.Global("name", 3, place), y, place),
        ir.SetItem(x, y, z, place),
        ir.Raise(None, place),
    ]
    for one in made:
        assert one.list_vars() == _variables_in(one, one.__dict__)
    names = [{variable.name for variable in one.list_vars()} for one in made]
    assert names == [{"x", "y", "z"}, {"y"}, {"y"}, {"x", "y", "z"}, set()]


@compiled
def test_of_what_only_kernels_call_there_is_no_machine_code_but_in_the_kernels() -> None:
    def part(x: float) -> float:
        if x < 0.0:
            raise ValueError("too little")
        return 3.0 * x

    def whole(x: float) -> float:
        return tripled(x) + 1.0

    part.__module__ = whole.__module__ = "viaspline.kernels.example"
    tripled, called = jit.inner(part), jit.kernel(whole)
    assert called(2.0) == 7.0
    with pytest.raises(ValueError, match="too little"):
        called(-1.0)
    (inside,), (outside,) = (one.overloads.values() for one in (tripled, called))  # type: ignore[attr-defined]
    assert is_a_part(inside.library._final_module)
    assert not is_a_part(outside.library._final_module)
    assert outside.library.serialize_using_object_code()[1] == "object"
    kept = inside.library.serialize_using_object_code()
    assert kept[1] == "bitcode"
    read = inside.library.codegen.unserialize_library(kept)
    name = inside.fndesc.llvm_func_name
    assert name in {one.name for one in read._get_module_for_linking().functions}


def test_numbas_own_functions_are_compiled_in_kernels_as_ever(tmp_path: Path) -> None:
    lines = (
        "import numpy as np",
        "from viaspline.kernels import jit",
        "made = jit.kernel(lambda n: np.full(n, 2.0).sum() + np.zeros((n, 2)).size)",
        "print(made(3))",
    )
    environment = os.environ | {"VIASPLINE_CACHE_DIR": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", "\n".join(lines)],
        env=environment, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert (done.returncode, done.stdout) == (0, "12.0\n"), done.stderr
