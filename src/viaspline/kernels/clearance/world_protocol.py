"""What a certificate asks of a world, whichever world it is.

A world says of how many dimensions its places are, how far it is from a place at an instant and
from a chord, and how fast that distance may change while the place stays (its pace); in place it
changes by no more than a metre a metre. That is all. numba compiles a certificate anew for each
packed type that it is given and takes the answers of that type, so none pays for another.

A world that moves, or one with height, is a further NamedTuple of arrays with four functions:

    @answers(distance_at, PackedBalls)
    def _distance(world, place, instant, limit): ...
"""

from __future__ import annotations

from collections.abc import Callable
from functools import singledispatch
from typing import Any, TypeVar

from numba.core import types
from numba.core.typing.templates import AbstractTemplate, builtin_registry

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.segment import nearest_to_segment

_Answer = TypeVar("_Answer", bound=Callable[..., Any])


def asked_of(function: Callable[..., Any]) -> Any:
    """A question: a function that is another one for each packed type of its first argument.

    In Python it is chosen when it is called, in kernels when they are compiled: there the answer
    goes right into its caller, for a world is a hundred words long and handing it on costs a
    quarter of a certificate's time.
    """
    question: Any = singledispatch(function)
    question.compiled = {}
    registry: Any = builtin_registry

    class Chosen(AbstractTemplate):
        key = question

        def generic(self, args: Any, kws: Any) -> Any:
            answer = question.compiled.get(getattr(args[0], "instance_class", None))
            if answer is None:
                return None
            return types.Dispatcher(answer).get_call_type(self.context, args, kws)

        def get_impl_key(self, sig: Any) -> Any:
            return types.Dispatcher(question.compiled[sig.args[0].instance_class]).get_impl_key(sig)

    registry.register_global(question, types.Function(Chosen))
    return question


def _no_world(world: Any) -> TypeError:
    return TypeError(f"{type(world).__name__} is no world for a certificate; see world_protocol")


@asked_of
def dimension(world: Any) -> int:
    """How many coordinates a place has."""
    raise _no_world(world)


@asked_of
def pace(world: Any) -> float:
    """By how much the distance at a place may change in time, at most [m/s]; 0 if nothing moves."""
    raise _no_world(world)


@asked_of
def distance_at(world: Any, place: Floats, instant: float, limit: float) -> tuple[float, int]:
    """Signed distance of a place (d,) from the world at an instant [s], and what is nearest.

    Returns:
        (distance [m], index): the limit and -1 where nothing is nearer than the limit.
    """
    raise _no_world(world)


@asked_of
def chord_distance(
    world: Any, first: Floats, last: Floats, instant: float, limit: float
) -> tuple[float, int]:
    """Distance of the segment between two places (d,) from the world at an instant [s].

    Returns:
        (distance [m], index): not above 0 where it touches something; see ``distance_at``.
    """
    raise _no_world(world)


def answers(question: Any, packed: type) -> Callable[[_Answer], _Answer]:
    """Let a function answer a question for one packed type.

    Args:
        question: ``dimension``, ``pace``, ``distance_at`` or ``chord_distance``.
        packed: The NamedTuple of arrays that is the world's packed form.
    """

    def register(answer: _Answer) -> _Answer:
        question.register(packed, answer)
        question.compiled[packed] = inlined(answer)
        return answer

    return register


@answers(dimension, PackedWorld)
def _planar_dimension(world: PackedWorld) -> int:
    return 2


@answers(pace, PackedWorld)
def _planar_pace(world: PackedWorld) -> float:
    return 0.0


@answers(distance_at, PackedWorld)
def _planar_distance(
    world: PackedWorld, place: Floats, instant: float, limit: float
) -> tuple[float, int]:
    return nearest(world, place[0], place[1], limit)


@answers(chord_distance, PackedWorld)
def _planar_chord(
    world: PackedWorld, first: Floats, last: Floats, instant: float, limit: float
) -> tuple[float, int]:
    return nearest_to_segment(world, first[0], first[1], last[0], last[1], limit)
