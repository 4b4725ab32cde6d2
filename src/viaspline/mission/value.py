"""What the parts of a mission have in common: they are frozen, and say what keys they have.

A key is declared once, where its field is: the type holds its limits and its unit, the class's
docstring what it means. Messages (``key_words``) and the JSON Schema are derived from that.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from pydantic import BaseModel, ConfigDict, model_validator
from pydantic_core import PydanticCustomError

from viaspline.mission.key_rules import KeyRules, describe_keys
from viaspline.presentable.compared_by_value import hashed
from viaspline.presentable.short_repr import ShortText, in_lines, short

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Self

    from pydantic import GetJsonSchemaHandler
    from typing_extensions import Unpack


class Value(BaseModel):
    """A frozen value that refuses keys it does not know.

    >>> class Wheel(Value, expected="a wheel such as {radius_m: 0.2}"):
    ...     radius_m: float
    >>> Wheel.key_rules["expected"]
    'a wheel such as {radius_m: 0.2}'
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    if TYPE_CHECKING:  # an annotation would be evaluated once more for each class
        key_rules: ClassVar[KeyRules]

    def __init_subclass__(cls, **rules: Unpack[KeyRules]) -> None:
        """Take the class's `KeyRules`; those that it doesn't give are those of its base."""
        super().__init_subclass__()
        cls.key_rules = {**getattr(cls, "key_rules", KeyRules()), **rules}

    def __hash__(self) -> int:
        said = [getattr(self, name) for name in type(self).model_fields]
        return hash((type(self).__name__, hashed(said)))

    def __repr_args__(self) -> Iterator[tuple[str, ShortText]]:
        """What isn't as it would be if nobody had said it; long lists are counted."""
        for name, field in type(self).model_fields.items():
            value = getattr(self, name)
            if field.is_required() or value != field.default:
                yield name, short(value)

    def __repr__(self) -> str:
        return in_lines(type(self).__name__, list(self.__repr_args__()))

    __str__ = __repr__

    @classmethod
    def __get_pydantic_json_schema__(
        cls, core_schema: Any, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """The schema with what the class says of its keys."""
        schema = handler(core_schema)
        describe_keys(cls, cls.key_rules, handler.resolve_ref_schema(schema))
        return schema


class OneOf(Value):
    """A value of which exactly one of the keys ``exactly_one`` is given, e.g. the kind of a drive.

    The others among them are None.
    """

    @model_validator(mode="after")
    def _is_one(self) -> Self:
        keys = self.key_rules["exactly_one"]
        fields = type(self).model_fields.items()
        values = {field.alias or name: getattr(self, name) for name, field in fields}
        given = [key for key in keys if values[key] is not None]
        if not given:
            raise PydanticCustomError("none_of", "give one of them", {"keys": keys})
        if len(given) > 1:
            raise two_of(*given)
        return self


def two_of(*keys: str) -> PydanticCustomError:
    """The error of keys that exclude each other."""
    return PydanticCustomError("two_of", "give one of them", {"keys": keys})
