"""Parts of a mission that people build by themselves, whose errors are the package's own.

Tested through ``mission/test_model`` and ``test_junk_arguments``.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar

from pydantic import ValidationError

from viaspline.errors import MissionError
from viaspline.mission.unplaced_faults import located
from viaspline.mission.value import Value

if TYPE_CHECKING:
    from typing import Self

    from viaspline.mission.unplaced_faults import Path


class Standalone(Value):
    """A value that can be built without a mission.

    What is wrong with it is a `viaspline.errors.MissionError`, with every fault, where it is built
    by its name or by ``model_validate``; inside of a mission it is the mission's.
    """

    stands_at: ClassVar[tuple[str | int, ...]]
    """Where in a mission such a value stands."""

    def __init__(self, /, **data: Any) -> None:
        """Build it from its keys.

        Raises:
            MissionError: With every fault.
        """
        try:
            super().__init__(**data)
        except ValidationError as error:
            raise _own(error, data, self.stands_at) from None

    # Inside of a mission pydantic builds values without __init__, as those of its own.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    @classmethod
    def model_validate(cls, obj: Any, **options: Any) -> Self:
        """Build it from a mapping.

        Raises:
            MissionError: With every fault.
        """
        try:
            return super().model_validate(obj, **options)
        except ValidationError as error:
            raise _own(error, obj, cls.stands_at) from None


def _own(error: ValidationError, data: Any, stands_at: Path) -> MissionError:
    # The words for a fault come from all of a mission's keys, this value's among them: they are
    # looked up by name, and only once something is wrong.
    words = import_module("viaspline.mission.schema_errors")
    faults = words.schema_faults(error, at=stands_at)
    own = [fault._replace(path=fault.path[len(stands_at) :]) for fault in faults]
    return MissionError(located(own, data, None))
