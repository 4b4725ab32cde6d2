"""Advice of a tension, beside what anybody would try by hand.

    python benchmarks/tension_advice.py [--seed 0] [--missions 40]

Random missions of four via points and vector worlds in turn, in which a tension stands or none. The
suggested one must not be slower than none stated, -0.5, 0, 0.5 and what stands there, and no
sharper than one of them that is as fast. All are planned by themselves, without what advice knows
of them.
"""

from __future__ import annotations

import argparse

import numpy as np
from driven_missions import four_vias, vector_world

import viaspline as vs

BY_HAND = (None, -0.5, 0.0, 0.5)
STANDING = (None, -0.3, 0.2, 0.8)
SAME = 1e-5  # of a time or a curvature


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--missions", type=int, default=40)
    asked = parser.parse_args()
    gains, sharper, idle, refused = [], 0, 0, 0
    for seed in range(asked.seed, asked.seed + asked.missions):
        stands = STANDING[int(np.random.default_rng((15, seed)).integers(len(STANDING)))]
        mission = (four_vias, vector_world)[seed % 2](seed)
        try:
            advice = vs.advise_tension(with_tension(mission, stands))
            by_hand = [cost(mission, tension) for tension in (stands, *BY_HAND)]
        except vs.PlanningError:
            refused += 1
            continue
        time, peak = cost(mission, advice.suggested)
        gains.append(min(other for other, _ in by_hand) / time)
        sharper += any(
            other <= time and bend < (1.0 - SAME) * peak and gains[-1] < 1.0 + SAME
            for other, bend in by_hand
        )
        idle += not advice.matters
    slower = sum(gain < 1.0 - SAME for gain in gains)
    print(
        f"of {len(gains)} ({refused} refused): {slower} slower, {sharper} sharper than one as fast"
    )
    print(f"least time by hand over that of what is advised: {spread(gains)}; no matter: {idle}")


def with_tension(mission: vs.Mission, tension: object) -> vs.Mission:
    """With a tension, or with none stated."""
    spline = mission.spline.model_copy(update={"tension": tension})
    return mission.model_copy(update={"spline": spline})


def cost(mission: vs.Mission, tension: object) -> tuple[float, float]:
    """The time with a tension [s], and the peak curvature [1/m]."""
    plan = vs.plan(with_tension(mission, tension))
    return plan.trajectory.duration, plan.path.max_curvature()[0]


def spread(gains: list[float]) -> str:
    """Median and largest."""
    return f"{np.median(gains):.4f}, {max(gains):.4f} at most"


if __name__ == "__main__":
    main()
