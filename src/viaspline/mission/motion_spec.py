"""How an obstacle moves: along keyframes, or straight on.

Tested through ``mission/test_motion``.
"""

from __future__ import annotations

from typing import Annotated, Final, Literal, TypeAlias

from pydantic import AfterValidator, BeforeValidator, ConfigDict, Field
from pydantic_core import PydanticCustomError

from viaspline.mission.annotations import Expects
from viaspline.mission.fields import (
    MAX_DURATION_S,
    MAX_HEADING_DEG,
    MAX_LENGTH_M,
    METRES_PER_SECOND,
    SPEEDS_MPS,
    Distance,
    Number,
    Point,
    SpeedNoise,
    plain,
)
from viaspline.mission.value import OneOf, Value

After: TypeAlias = Literal["loop", "bounce", "stay", "vanish"]

MAX_KEYFRAMES: Final = 1_000_000
"""How many keyframes one obstacle can have at most."""
KEYFRAME_WORDS: Final = "[t, x, y] or [t, x, y, heading_deg], in seconds, metres and degrees"
FRAMES_IN_SPACE: Final = "in space [t, x, y, heading_deg, z]"


def _in_range(frame: tuple[float, ...]) -> tuple[float, ...]:
    """A keyframe whose numbers are those of a place and a time."""
    limits = (MAX_DURATION_S, MAX_LENGTH_M, MAX_LENGTH_M, MAX_HEADING_DEG, MAX_LENGTH_M)
    for place, (value, limit) in enumerate(zip(frame, limits, strict=False)):
        if not abs(value) <= limit:
            raise PydanticCustomError(
                "item_out_of_range", "item {place} is out of range",
                {"place": place, "found": value, "limit": limit},
            )  # fmt: skip
    return frame


Keyframe: TypeAlias = Annotated[
    tuple[Annotated[Number, Field(ge=-MAX_LENGTH_M, le=MAX_LENGTH_M)], ...],
    Field(min_length=3, max_length=5),
    AfterValidator(_in_range),
    Expects(f"{KEYFRAME_WORDS}; {FRAMES_IN_SPACE}"),
]
Keyframes: TypeAlias = Annotated[
    tuple[Keyframe, ...],
    Field(min_length=1, max_length=MAX_KEYFRAMES),
    BeforeValidator(plain),
    Expects(f"a list of keyframes, each {KEYFRAME_WORDS}; {FRAMES_IN_SPACE}"),
]
SignedSpeed: TypeAlias = Annotated[Number, Field(ge=-SPEEDS_MPS[1], le=SPEEDS_MPS[1])]
Velocity: TypeAlias = Annotated[
    tuple[SignedSpeed, ...],
    Field(min_length=2, max_length=3),
    METRES_PER_SECOND,
    BeforeValidator(plain),
    Expects("[vx, vy], or in space [vx, vy, vz], in metres per second"),
]


class MotionError(
    Value,
    expected="a mapping such as {position_m: 0.05, growth_mps: 0.1}",
    examples=({"position_m": 0.05, "growth_mps": 0.1},),
):
    """How far from where it is said to be an obstacle may be.

    Attributes:
        position_m: At time 0 and before [m].
        growth_mps: By how much that grows in a second from then on [m/s].
    """

    position_m: Distance = 0.0
    growth_mps: SpeedNoise = 0.0


class Motion(
    OneOf,
    expected="{keyframes: [[0, 1, 2], [4, 5, 2]], after: stay} or "
    "{from: [10, 3], velocity_mps: [1, 0]}",
    exactly_one=("keyframes", "from"),
    needing=(("after", "keyframes"), ("before", "keyframes"), ("velocity_mps", "from")),
    examples=(
        {"keyframes": [[0, 1, 2], [4, 5, 2]], "after": "vanish", "before": "absent"},
        {"from": [10, 3], "velocity_mps": [1, 0], "error": {"position_m": 0.05}},
    ),
):
    """How an obstacle moves; its shape stands in a frame of its own, which is moved and turned.

    Attributes:
        keyframes: Where the frame's origin is when, ``[t, x, y]`` or ``[t, x, y, heading_deg]``,
            in space also ``[t, x, y, heading_deg, z]`` [s, m, deg anticlockwise from x]; it goes
            evenly from one to the next. Times increase. One without a heading or a z has that of
            the one before, at first 0. Headings count on: from 350 to 370 it turns left by 20, from
            350 to 10 right by 340.
        after: What it does when the keyframes are over: begins again (``loop``), goes back the
            way that it came (``bounce``), ``stay`` or ``vanish``.
        before: What it does before the first keyframe: stands there (``stay``), or isn't there
            (``absent``). None: ``absent`` if it vanishes after the last one, else ``stay``. What
            goes on and on has no before.
        from_: Where the frame's origin is at time 0, ``[x, y]`` or in space ``[x, y, z]`` [m];
            ``from`` in a file.
        velocity_mps: How fast it goes from there, ``[vx, vy]`` or in space ``[vx, vy, vz]`` [m/s],
            before and after.
        error: How far from there it may be.
    """

    model_config = ConfigDict(
        validate_by_alias=True, validate_by_name=True, serialize_by_alias=True
    )

    keyframes: Keyframes | None = None
    after: After | None = None
    before: Literal["stay", "absent"] | None = None
    from_: Annotated[Point | None, Field(alias="from")] = None
    velocity_mps: Velocity | None = None
    error: MotionError = MotionError()

    @property
    def has_heights(self) -> bool:
        """Whether it says how high the frame is, so that it moves in space.

        >>> Motion(from_=(0, 0, 9), velocity_mps=(1, 0)).has_heights
        True
        """
        return (
            any(len(frame) > 4 for frame in self.keyframes or ())
            or (self.from_ is not None and len(self.from_) > 2)
            or (self.velocity_mps is not None and len(self.velocity_mps) > 2)
        )
