"""How a robot slows down to a crawl with a limit of its jerk, as a first guess of a time law.

Tested through ``trajectory/test_jerk``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel


@kernel
def slowed_to_crawl(
    v: float, a: float, crawl: float, length: float, brake: float, jerk: float, step: float,
    count: int,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Distances [m] and v² [m²/s²] of a robot that slows down from now on, shape (n + 1,) each.

    Args:
        v: Its speed [m/s],
        a: and acceleration [m/s²].
        crawl: The speed that it slows down to [m/s].
        length: It is looked at up to here [m].
        brake: Its largest deceleration [m/s²].
        jerk: How fast that changes at most [m/s³].
        step: Time between two of its places [s].
        count: So many steps at most.
    """
    line, squares = np.zeros(count + 1), np.zeros(count + 1)
    squares[0], s, n = v * v, 0.0, 0
    while n < count:
        wanted = -min(brake, np.sqrt(max(jerk * (v - crawl), 0.0)))
        a += min(max(wanted - a, -jerk * step), jerk * step)
        new = max(v + a * step, crawl)
        s += 0.5 * (v + new) * step
        v = new
        n += 1
        line[n], squares[n] = s, v * v
        if v <= crawl or s > length:
            break
    return line[: n + 1], squares[: n + 1]
