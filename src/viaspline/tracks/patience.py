"""How a robot bears with what moves: what it keeps, how often it looks, when it gives up.

Tested through ``robot/yielding/test_give_way`` and ``space/online/test_fly_among_unseen``.
"""

from __future__ import annotations

APART_M = (0.3, 0.0)
"""What it keeps to what moves beyond what is required [m], the most that can be: that may turn."""

RETRY_S = 0.3
"""A robot that gives way looks so often for something better [s]."""

PATIENCE_S = 1.0
"""It waits so much longer than it would drive before it looks at other sides [s]."""

GAIN_S = 0.5
"""Another side has to be so much sooner than waiting [s]."""

FREE_S = 0.05
"""Who comes no later than this doesn't give way [s]."""

MAX_HELD_UP_S = 60.0
"""It gives up that has stood so long without a way on [s]."""

PAUSE_SHARE, MAX_PAUSE_S = 0.1, 2.0
"""From one look for a way on to the next it waits a share of how long it has stood, not more than
this [s]."""

MAX_FROZEN_S = 60.0
"""A robot gives up that has stood so long without a step that is proven to be safe [s],"""

FROZEN = (
    f"for {MAX_FROZEN_S:g} s no step of it was proven safe from what moves there, or may come out "
    "of what it doesn't see; moving.max_speed_mps says how fast that may be"
)
"""and says why,"""

UNSEEING = "; it has no robot.sensor, and so sees nowhere that nothing comes"
"""and this as well where it has no sensor."""
