"""Texts of pictures: does one lie over another, or reach beyond its picture?

Random missions are planned and driven, and their ``plan.png``, ``run.png`` and a frame of their
film are drawn. Every text that matplotlib draws meanwhile is written down with its box; boxes that
overlap by more than half a pixel each way, and boxes that aren't whole on the picture, are faults.

    python benchmarks/picture_texts.py --missions 100
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.text import Text

from viaspline.errors import ViasplineError
from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.report.animation import frames
from viaspline.report.canvas import any_name
from viaspline.report.plan_picture import plan_picture
from viaspline.report.run_picture import run_picture
from viaspline.robot.simulator import simulate

SLACK_PX = 0.5
LETTERS = (
    "abcdefghij klmnop", "ÄÖÜß éè ñç", "ВГДЕЖ абвгд", "αβγδ εζη", "שער צפוני", "البوابة",
    "ポンプ場", "$x_1$ \\frac", "WWWW MMMM", "1234 5678",
)  # fmt: skip


@dataclass
class DrawnTexts:
    """What was drawn: words, box [pixels] and the size of the picture, by the text's number."""

    texts: dict[int, tuple[str, np.ndarray, np.ndarray]] = field(default_factory=dict)
    kept: list[Text] = field(default_factory=list)

    def add(self, text: Text, renderer: Any) -> None:
        """Write down a text that is drawn, as far as it isn't clipped away."""
        box = np.array(text.get_window_extent(renderer).extents)
        page = text.get_figure(root=True).bbox.extents
        clip = text.get_clip_box() if text.get_clip_on() else None
        if clip is not None:
            box = np.concatenate((np.maximum(box[:2], clip.min), np.minimum(box[2:], clip.max)))
        if (box[2:] > box[:2]).all():
            self.texts[id(text)] = (text.get_text(), box, page)
            self.kept.append(text)  # as long as it lives no other text has its number

    def over(self) -> list[tuple[str, str]]:
        """Pairs of texts of which one lies over the other."""
        found = []
        shown = list(self.texts.values())
        for i, (words, box, page) in enumerate(shown):
            for others, other, its in shown[:i]:
                both = np.minimum(box[2:], other[2:]) - np.maximum(box[:2], other[:2])
                if (both > SLACK_PX).all() and (page == its).all():
                    found.append((words, others))
        return found

    def beyond(self) -> list[str]:
        """Texts that aren't whole on their picture."""
        return [
            words
            for words, box, page in self.texts.values()
            if (box[:2] < page[:2] - SLACK_PX).any() or (box[2:] > page[2:] + SLACK_PX).any()
        ]


@contextmanager
def drawn_texts() -> Iterator[DrawnTexts]:
    """Within the block every text that is drawn is written down."""
    drawn, draw = DrawnTexts(), Text.draw

    def watched(self: Text, renderer: Any, *args: Any, **kwargs: Any) -> Any:
        if self.get_visible() and self.get_text().strip():
            drawn.add(self, renderer)
        return draw(self, renderer, *args, **kwargs)

    Text.draw = watched  # type: ignore[method-assign]
    try:
        yield drawn
    finally:
        Text.draw = draw  # type: ignore[method-assign]


class PictureMissions:
    """Draws missions of all sizes, with names of all kinds.

    Args:
        rng: Where chance comes from.
    """

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng

    def draw(self) -> dict[str, Any]:
        """The next one: what a mission file holds."""
        rng = self.rng
        size = float(10.0 ** rng.uniform(0.0, 4.0))
        wide = np.array([size, size * float(rng.uniform(0.3, 1.0))])[:: rng.choice([1, -1])]
        radius = float(0.01 * wide.min() * rng.uniform(0.05, 1.0))
        count = int(rng.integers(2, rng.choice([4, 12, 40])))
        points = (wide * rng.uniform(0.1, 0.9, (count, 2))).round(6)
        if rng.random() < 0.3:  # some are on a heap, or are come to twice
            points[count // 2 :] = points[: count - count // 2] + 1e-3 * size * rng.integers(0, 2)
        obstacles = self._obstacles(wide, points, radius)
        unseen = int(rng.integers(0, 3)) if len(obstacles) > 3 else 0
        via = [{"at": p.tolist(), **self._station()} for p in points[1:-1]]
        return {
            "world": {
                "known": obstacles[unseen:], "unseen": obstacles[:unseen],
                "speed_zones": self._zones(wide),
                **({"bounds": [0.0, 0.0, *wide.tolist()]} if rng.random() < 0.6 else {}),
            },
            "robot": {
                "radius_m": radius, "clearance_m": radius, "max_speed_mps": 0.02 * size,
                "max_accel_mps2": 0.01 * size, "sensor": {"range_m": 0.2 * size},
            },
            "route": {
                "start": {"at": points[0].tolist(), **self._name(0.5)},
                "via": via, "goal": {"at": points[-1].tolist(), **self._name(0.5)},
            },
        }  # fmt: skip

    def _obstacles(self, wide: np.ndarray, points: np.ndarray, radius: float) -> list[Any]:
        """Discs off the route's points."""
        found = []
        for _ in range(int(self.rng.integers(0, self.rng.choice([3, 12, 40])))):
            centre = wide * self.rng.uniform(0.0, 1.0, 2)
            round_it = float(0.06 * wide.min() * self.rng.uniform(0.1, 1.0))
            if np.hypot(*(points - centre).T).min() > round_it + 4.0 * radius:
                disc = {"center": centre.tolist(), "radius": round_it}
                found.append({"circle": disc, **self._name(0.7)})
        return found

    def _zones(self, wide: np.ndarray) -> list[Any]:
        zones = []
        for _ in range(int(self.rng.integers(0, 3))):
            x, y = (wide * self.rng.uniform(0.0, 0.7, 2)).tolist()
            across, up = (wide * self.rng.uniform(0.05, 0.3, 2)).tolist()
            corners = [[x, y], [x + across, y], [x + across, y + up], [x, y + up]]
            zones.append(
                {"polygon": corners, "max_speed_mps": 0.01 * float(wide.max()), **self._name(0.5)}
            )
        return zones

    def _station(self) -> dict[str, Any]:
        dwell = {"dwell_s": round(float(self.rng.uniform(1, 99)), 1)}
        return self._name(0.4) | (dwell if self.rng.random() < 0.3 else {})

    def _name(self, share: float) -> dict[str, str]:
        """A name of one to sixty letters, or none."""
        if self.rng.random() >= share:
            return {}
        letters = str(self.rng.choice(LETTERS))
        length = int(self.rng.choice([1, 4, 9, 20, 60]))
        name = "".join(self.rng.choice(list(letters), length)).strip()
        return {"name": name} if name else {}


@dataclass
class Count:
    """What was found on the pictures of one kind."""

    pictures: int = 0
    texts: int = 0
    over: int = 0
    beyond: int = 0
    seconds: float = 0.0


def counted(missions: int, seed: int, *, told: bool = True) -> dict[str, Count]:
    """The faults of the pictures of so many random missions, by the kind of picture."""
    source = PictureMissions(np.random.default_rng(seed))
    counts = {kind: Count() for kind in ("plan.png", "run.png", "film")}
    done = 0
    while done < missions:
        data = source.draw()
        try:
            planned = plan(Mission.model_validate(data))
            driven = simulate(planned.mission, plan=planned)
        except ViasplineError:
            continue  # no path at all: there is nothing to draw
        done += 1
        makers: dict[str, Any] = {
            "plan.png": lambda: plan_picture(planned, "random"),  # noqa: B023
            "run.png": lambda: run_picture(driven, "random"),  # noqa: B023
            "film": lambda: any_name()(list)(frames(driven, "random", 2)),  # noqa: B023
        }
        for kind, make in makers.items():
            begin = time.process_time()
            with drawn_texts() as drawn:
                make()
            one = counts[kind]
            one.pictures += 1
            one.seconds += time.process_time() - begin
            one.texts += len(drawn.texts)
            one.over += len(drawn.over())
            one.beyond += len(drawn.beyond())
            if told and (drawn.over() or drawn.beyond()):
                print(f"mission {done}, {kind}: over {drawn.over()}, beyond {drawn.beyond()}")
    return counts


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--missions", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    print(f"{'picture':10} {'drawn':>6} {'texts':>7} {'over':>5} {'beyond':>7} {'s each':>7}")
    for kind, one in counted(args.missions, args.seed).items():
        each = one.seconds / max(one.pictures, 1)
        print(f"{kind:10} {one.pictures:6} {one.texts:7} {one.over:5} {one.beyond:7} {each:7.2f}")


if __name__ == "__main__":
    main()
