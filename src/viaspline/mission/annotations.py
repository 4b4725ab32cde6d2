"""What the annotation of a field says beside its type: a unit, words, a limit held elsewhere.

Pydantic passes over them; messages and the JSON Schema are made of them, see ``key_words``.

Tested through ``mission/test_key_words``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from pydantic import GetJsonSchemaHandler


class Unit(NamedTuple):
    """What a number counts.

    Attributes:
        symbol: As documentation has it in brackets, e.g. ``m/s``.
        words: As messages say it, e.g. ``metres per second``.
    """

    symbol: str
    words: str


class Expects(NamedTuple):
    """What would be right, in words, where type, unit and limits don't say it well enough.

    Attributes:
        words: They end the sentence "it should be …".
    """

    words: str


class Limit(NamedTuple):
    """A limit of a number that a semantic check holds, as it can say more than pydantic.

    Attributes:
        ge: The least value; None: none.
        le: The greatest value; None: none.
    """

    ge: float | None = None
    le: float | None = None

    def __get_pydantic_json_schema__(
        self, core_schema: Any, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """The schema of the number with its limit."""
        limits = {"minimum": self.ge, "maximum": self.le}
        told = {name: limit for name, limit in limits.items() if limit is not None}
        return {**handler(core_schema), **told}
