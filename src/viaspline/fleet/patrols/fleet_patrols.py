"""What a fleet's plan says of its patrols: from when on and after how long all comes again.

Tested through ``fleet/patrols/test_timed_patrols``.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class FleetPatrols:
    """The closed patrols of a fleet that never end.

    From ``repeats_from`` on nobody but patrols moves, and each of them is where it was a period
    before. Their plans hold so many laps that they last until a whole period after that: what is
    proven of them is proven for ever.

    Attributes:
        period: [s].
        laps: How many laps each drives in a period, by name.
        begins: When each begins its first lap [s], by name: once it has taken off, if it does.
        repeats_from: From when on all is as it was a period before, but for a first one [s].
        planned_until: Until when the laps of all plans last at least [s].
    """

    period: float
    laps: dict[str, int]
    begins: dict[str, float]
    repeats_from: float
    planned_until: float
