"""What the parts of a mission have in common: they are frozen, and say what keys they have.

A key is declared once, where its field is: the type holds its limits and its unit, the class's
docstring what it means. Messages (``key_words``) and the JSON Schema are derived from that.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from pydantic import BaseModel, ConfigDict, model_validator
from pydantic_core import PydanticCustomError

if TYPE_CHECKING:
    from typing import Self

    from pydantic import GetJsonSchemaHandler


class Value(BaseModel):
    """A frozen value that refuses keys it does not know.

    Attributes:
        expected: What would be right where one is asked for, in words; empty: a mapping with its
            keys.
        exactly_one: Keys of which exactly one has to be given.
        excluding: Pairs of keys of which one at most may be given.
        needing: Keys that make sense beside another only.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    expected: ClassVar[str] = ""
    exactly_one: ClassVar[tuple[str, ...]] = ()
    excluding: ClassVar[tuple[tuple[str, str], ...]] = ()
    needing: ClassVar[Mapping[str, str]] = {}

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core_schema: Any, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """The schema with what the class says of its keys."""
        from viaspline.mission.json_schema import describe_keys

        schema = handler(core_schema)
        describe_keys(cls, handler.resolve_ref_schema(schema))
        return schema


class Choice(Value):
    """A value of which exactly one of the keys ``exactly_one`` is given, e.g. the kind of a drive.

    The others among them are None.
    """

    @model_validator(mode="after")
    def _is_one(self) -> Self:
        given = [key for key in self.exactly_one if getattr(self, key) is not None]
        if not given:
            raise PydanticCustomError("none_of", "give one of them", {"keys": self.exactly_one})
        if len(given) > 1:
            raise two_of(*given)
        return self


def two_of(*keys: str) -> PydanticCustomError:
    """The error of keys that exclude each other."""
    return PydanticCustomError("two_of", "give one of them", {"keys": keys})
