"""What the fields of a mission are made of: numbers with limits, points, rings, names."""

from __future__ import annotations

import os
from typing import Annotated, Any, Final, TypeAlias, TypeVar

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field
from pydantic_core import PydanticCustomError

FAR: Final = 1e9
"""The farthest coordinate and the greatest length [m]; beyond it a double loses the micrometre."""

Number: TypeAlias = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Coordinate: TypeAlias = Annotated[Number, Field(ge=-FAR, le=FAR)]
Positive: TypeAlias = Annotated[Number, Field(gt=0)]
NotNegative: TypeAlias = Annotated[Number, Field(ge=0)]
Name: TypeAlias = Annotated[str, Field(strict=True, min_length=1)]


def plain(value: Any) -> Any:
    """Arrays as lists."""
    return value.tolist() if hasattr(value, "tolist") else value


def _opened(ring: tuple[tuple[float, float], ...]) -> tuple[tuple[float, float], ...]:
    """Drop a last point that repeats the first, as other formats write rings."""
    return ring[:-1] if len(ring) > 3 and ring[0] == ring[-1] else ring


def as_text(value: Any) -> Any:
    """Paths as texts."""
    return os.fspath(value) if isinstance(value, os.PathLike) else value


Point2: TypeAlias = Annotated[tuple[Coordinate, Coordinate], BeforeValidator(plain)]
Point: TypeAlias = Annotated[
    tuple[Coordinate, ...], Field(min_length=2, max_length=3), BeforeValidator(plain)
]
Ring: TypeAlias = Annotated[
    tuple[Point2, ...], Field(min_length=3), BeforeValidator(plain), AfterValidator(_opened)
]


class Value(BaseModel):
    """A frozen value that refuses keys it does not know."""

    model_config = ConfigDict(frozen=True, extra="forbid")


Kind = TypeVar("Kind", bound=Value)


def one_of(value: Kind, *keys: str) -> Kind:
    """The value, if just one of some keys is given.

    Raises:
        PydanticCustomError: ``none_of`` or ``two_of``, with the keys in its context.
    """
    given = [key for key in keys if getattr(value, key) is not None]
    if not given:
        raise PydanticCustomError("none_of", "give one of them", {"keys": keys})
    if len(given) > 1:
        raise two_of(*given)
    return value


def two_of(*keys: str) -> PydanticCustomError:
    """The error of keys that exclude each other."""
    return PydanticCustomError("two_of", "give one of them", {"keys": keys})
