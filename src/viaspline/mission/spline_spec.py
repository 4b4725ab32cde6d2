"""The shape of a mission's curve.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from typing import Annotated, Final, Literal, TypeAlias

from pydantic import BeforeValidator

from viaspline.mission.annotations import Expects, Limit
from viaspline.mission.fields import Number, plain
from viaspline.mission.value import Value

POLYLINE_TENSION: Final = 1.0
POLYLINE_SLACK: Final = 0.0
LOOSEST_TENSION: Final = -199.0
LOOSEST_SLACK: Final = 100.0

Tangents: TypeAlias = Literal["cardinal", "continuous"]
Tension: TypeAlias = Annotated[Number, Limit(ge=LOOSEST_TENSION, le=POLYLINE_TENSION)]
Slack: TypeAlias = Annotated[Number, Limit(ge=POLYLINE_SLACK, le=LOOSEST_SLACK)]


class SplineSpec(
    Value,
    expected="a mapping such as {tension: 0.1}",
    excluding=(("tension", "slack"),),
    examples=(
        {"tension": 0.1, "knots": "chordal", "tangents": "continuous"},
        {"slack": 0.45},
        {"tension": "auto"},
    ),
):
    """The curve's shape.

    Attributes:
        tension: Eq. (7)'s t: 1 is the polyline, 0 Catmull-Rom, -1 loose. One number, or one for
            each span between the points of the route, or ``auto``: the one with
            which the whole plan is fastest, of many that are tried, or none.
        slack: The tension by its other name, s = (1 - t) / 2. Give one of the two.
        knots: How far apart the points are in parameter: equally, by the root of their distance,
            by their distance.
        tangents: ``continuous`` for continuous curvature, or ``cardinal``, the paper's. None:
            continuous.
    """

    tension: Annotated[
        Tension | Annotated[tuple[Tension, ...], BeforeValidator(plain)] | Literal["auto"] | None,
        Expects("one number from -199 to 1, a list with one for each span, or auto"),
    ] = None
    slack: Annotated[
        Slack | Annotated[tuple[Slack, ...], BeforeValidator(plain)] | None,
        Expects("one number from 0 to 100, or a list with one for each span"),
    ] = None
    knots: Literal["uniform", "centripetal", "chordal"] = "chordal"
    tangents: Tangents | None = None

    @property
    def has_own_tension(self) -> bool:
        """Whether it says how taut it is to be.

        >>> [SplineSpec(**said).has_own_tension for said in ({}, {"slack": 0.5}, {"tension": 0})]
        [False, True, True]
        """
        return self.tension is not None or self.slack is not None
