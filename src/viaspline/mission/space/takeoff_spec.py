"""How a flight begins and ends: straight up from the start, straight down to where it lands.

Tested through ``mission/space/test_spatial_keys``.
"""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator

from viaspline.mission.fields import Length, Point2, plain
from viaspline.mission.value import Value


class Takeoff(
    Value,
    expected="{to_agl_m: 10}",
    examples=({"to_agl_m": 10},),
):
    """Straight up from the start, before anything else.

    Attributes:
        to_agl_m: How high above the ground under the start [m].
    """

    to_agl_m: Length


class Landing(
    Value,
    expected="[x, y] or {at: [x, y]}",
    examples=({"at": [40, 0]},),
):
    """Straight down at the end of the route, to the ground.

    Attributes:
        at: Where it touches the ground, ``[x, y]`` [m].
    """

    at: Point2


def _as_landing(value: Any) -> Any:
    """The short form ``[x, y]`` of ``{at: [x, y]}``."""
    value = plain(value)
    return {"at": value} if isinstance(value, list | tuple) else value


AnyLanding: TypeAlias = Annotated[
    Landing, BeforeValidator(_as_landing, json_schema_input_type=Point2 | Landing)
]
