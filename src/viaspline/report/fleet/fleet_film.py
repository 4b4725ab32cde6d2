"""The film of a fleet: robots in their colours with trails, and arrows from who waits to whom."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Text

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.timelines import Timeline, timelines_of
from viaspline.kernels.arrays import Floats, Ints
from viaspline.report import style
from viaspline.report.canvas import any_name
from viaspline.report.fleet.driven_timelines import driven_timelines
from viaspline.report.fleet.film_names import FilmNames
from viaspline.report.fleet.fleet_colours import FleetColours, fleet_colours
from viaspline.report.fleet.fleet_map import robot_keys, scene_of
from viaspline.report.fleet.fleet_marks import LEAST_ARROW_PX, MAX_PLAIN, paths_of
from viaspline.report.fleet.flown_scene import FlownScene
from viaspline.report.fleet.places_over_time import FleetMotion, span_of
from viaspline.report.labels import Labels
from viaspline.report.moving_film import arrow_line
from viaspline.report.scene import Scene
from viaspline.report.sheet import Box, new_sheet
from viaspline.report.side_column import SideColumn
from viaspline.report.video_file import VideoFile
from viaspline.report.video_writer import Frame, write_film

MOST_FRAMES: Final = 240
LEAST_FRAMES: Final = 2
FRAME_S: Final = 0.25  # from one frame to the next, if that gives no more than the most [s]
FLEET_DPI: Final = 80
TRAIL_S: Final = 12.0  # what is shown of the way behind a robot [s]
TRAIL_STEP_S: Final = 0.25  # from one point of it to the next, at least [s]
MOST_STEPS: Final = 40  # of a trail between two frames
LEAST_BODY_PX: Final = 5.0  # of a body that can be seen: its radius [pixels]
HEAD_PX: Final = 9.0  # of an arrow [pixels]
ARROW_GAP_PX: Final = 1.0  # between an arrow and a robot [pixels]


@dataclass(frozen=True, eq=False)
class FilmedFleet:
    """What a film of a fleet shows.

    Attributes:
        name: What the fleet is called.
        scene: Its world.
        view: What is seen of it [m].
        paths: Of the robots [m], each (k, 2).
        motion: Where the robots are, at least at the times of the frames.
        frames: The numbers of these times, (f,).
        timelines: Who waits when.
        colours: Of the robots.
    """

    name: str
    scene: Scene | FlownScene
    view: Box
    paths: Sequence[Floats]
    motion: FleetMotion
    frames: Ints
    timelines: Sequence[Timeline]
    colours: FleetColours

    @classmethod
    def of_plan(cls, plan: FleetPlan, name: str, count: int | None = None) -> FilmedFleet:
        """A plan, in so many frames; None: as many as its time asks for."""
        times, frames = film_times(*span_of(plan), count)
        motion, waits = FleetMotion.of_plan(plan, times), timelines_of(plan)
        colours = fleet_colours(motion.names, plan.fleet, waits, plan.certificate)
        return cls(name, *scene_of(plan), paths_of(plan), motion, frames, waits, colours)

    @classmethod
    def of_run(
        cls, plan: FleetPlan, run: FleetRun, name: str, count: int | None = None
    ) -> FilmedFleet:
        """What was driven of a plan, in so many frames; None: as many as its time asks for."""
        times, frames = film_times(span_of(plan)[0], run.end_s, count)
        motion = FleetMotion.of_run(plan, run, times)
        waits = driven_timelines(plan, run)
        colours = fleet_colours(motion.names, plan.fleet, waits, run.certificate)
        return cls(name, *scene_of(plan), paths_of(plan), motion, frames, waits, colours)


@any_name()
def film_fleet(filmed: FilmedFleet, film: VideoFile, progress: Callable[[float], None]) -> None:
    """Film a fleet.

    Args:
        filmed: What is shown.
        film: Where to.
        progress: Hears how much is done, from 0 to 1.
    """
    write_film(film, fleet_frames(filmed), len(filmed.frames), progress)


def frame_count(lasts: float) -> int:
    """How many frames a film of so much time has [s].

    Example:
        >>> frame_count(1.0), frame_count(40.0), frame_count(3600.0)
        (5, 161, 240)
    """
    return int(np.clip(round(lasts / FRAME_S) + 1, LEAST_FRAMES, MOST_FRAMES))


def film_times(begin: float, end: float, count: int | None = None) -> tuple[Floats, Ints]:
    """Times at which a film has to know where robots are, and which of them have a frame.

    Between frames that are far apart there are more, so that trails go round corners.

    Args:
        begin: Of the film [s].
        end: Of the film [s].
        count: Of frames; None: as many as its time asks for.
    """
    frames = frame_count(end - begin) if count is None else count
    each = int(np.clip(np.ceil((end - begin) / max(frames - 1, 1) / TRAIL_STEP_S), 1, MOST_STEPS))
    times = np.linspace(begin, max(end, begin + 1e-3), (frames - 1) * each + 1)
    return times, np.arange(frames) * each


def fleet_frames(filmed: FilmedFleet) -> Iterator[Frame]:
    """The pictures of a film, one for each of the times."""
    stage = _FleetStage(filmed)
    for k in filmed.frames.tolist():
        yield stage.frame(k)


class _FleetStage:
    """What stands still is drawn once; robots, trails and arrows onto it for every frame."""

    def __init__(self, filmed: FilmedFleet) -> None:
        self._filmed = filmed
        self._numbers = {name: i for i, name in enumerate(filmed.motion.names)}
        self._sheet = sheet = new_sheet(
            filmed.view, (), style.short(filmed.name, 48), (), dpi=FLEET_DPI
        )
        axes = sheet.map
        names, colours = filmed.motion.names, list(filmed.colours.of.values())
        many = len(names) > MAX_PLAIN
        told = np.array([name in filmed.colours.told for name in names], bool)
        handles = filmed.scene.draw(axes, sheet.pixels_per_metre)
        labels = Labels(axes)
        filmed.scene.name(labels)
        labels.place(np.vstack([*filmed.paths, np.zeros((0, 2))]), np.zeros((0, 2)))
        axes.add_collection(
            LineCollection(
                list(filmed.paths), colors=colours, linewidths=0.3 if many else 0.7, alpha=0.4,
                zorder=6,
            ),
            autolim=False,
        )  # fmt: skip
        least = np.where(told | (not many), LEAST_BODY_PX, 0.6 * LEAST_BODY_PX)
        self._radii = np.maximum(filmed.motion.bodies * sheet.pixels_per_metre, least)
        sizes = 2.0 * self._radii / sheet.pixels_per_metre
        self._discs = EllipseCollection(
            sizes, sizes, np.zeros(len(names)), units="xy", offsets=np.zeros((len(names), 2)),
            offset_transform=axes.transData, facecolors=colours or "none", edgecolors=style.INK,
            linewidths=np.where(told, 0.7, 0.3), zorder=20,
        )  # fmt: skip
        self._trails = LineCollection(
            [], colors=colours or "none", linewidths=np.where(told, 2.4, 1.2 if many else 1.8),
            zorder=9, capstyle="round",
        )  # fmt: skip
        self._arrows = LineCollection([], colors=style.INK, linewidths=1.4, zorder=25)
        for layer in (self._trails, self._discs, self._arrows):
            axes.add_collection(layer, autolim=False)
            layer.set_animated(True)
        named = {i: name for i, name in enumerate(names) if told[i]}
        self._names = FilmNames(axes, named, self._radii)
        self._clock = _clock_of(sheet.figure, axes.get_position().x0)
        keys = [
            Line2D([], [], color=style.MUTED, linewidth=2.4, label=f"its last {TRAIL_S:g} s"),
            Line2D([], [], color=style.INK, marker=">", markersize=5, label="waits for"),
            *(robot_keys(filmed.colours) if not filmed.colours.all_told else ()),
        ]  # fmt: skip
        SideColumn(sheet).legend([*keys, *handles])
        canvas = sheet.figure.canvas
        assert isinstance(canvas, FigureCanvasAgg)
        self._canvas = canvas
        canvas.draw()  # type: ignore[no-untyped-call]
        self._still = canvas.copy_from_bbox(sheet.figure.bbox)  # type: ignore[no-untyped-call]

    def frame(self, k: int) -> Frame:
        """The picture at one of the times, by its number."""
        motion = self._filmed.motion
        time, here = float(motion.times[k]), motion.places[:, k]
        since = int(np.searchsorted(motion.times, time - TRAIL_S))
        self._discs.set_offsets(here)
        self._trails.set_segments(list(motion.places[:, since : k + 1]))
        waits = self._waits_at(time)
        head = HEAD_PX / self._sheet.pixels_per_metre
        self._arrows.set_segments([arrow_line(self._between(here, i, j), head) for i, j in waits])
        self._names.move(here)
        self._clock.set_text(f"{time:6.1f} s   {_waiting_words(len(waits))}")
        self._canvas.restore_region(self._still)  # type: ignore[no-untyped-call]
        for layer in (self._trails, self._discs, self._arrows, *self._names.texts):
            self._sheet.map.draw_artist(layer)
        self._sheet.figure.draw_artist(self._clock)
        pixels = np.asarray(self._canvas.buffer_rgba())[..., :3]  # type: ignore[no-untyped-call]
        height, width = (size - size % 2 for size in pixels.shape[:2])
        return pixels[:height, :width].copy()

    def _waits_at(self, time: float) -> list[tuple[int, int]]:
        """Who waits for whom, as numbers, as far as both are there."""
        found = []
        for i, one in enumerate(self._filmed.timelines):
            j = self._numbers.get(one.waits_for(time), i)
            if j != i:
                found.append((i, j))
        return found

    def _between(self, here: Floats, i: int, j: int) -> Floats:
        """An arrow from the edge of one robot to that of another: x, y, dx, dy [m].

        A short one is drawn longer, from farther back.
        """
        way = here[j] - here[i]
        length = max(float(np.hypot(*way)), 1e-9)
        radii = (self._radii[[i, j]] + ARROW_GAP_PX) / self._sheet.pixels_per_metre
        end = max(length - radii[1], 0.5 * length)
        begin = min(radii[0], end - LEAST_ARROW_PX / self._sheet.pixels_per_metre)
        return np.concatenate([here[i] + begin / length * way, (end - begin) / length * way])


def _waiting_words(count: int) -> str:
    return f"{count} waiting" if count else ""


def _clock_of(figure: Figure, left: float) -> Text:
    _, up = figure.get_size_inches()
    return figure.text(
        left, 1 - 0.62 / up, "", size=style.TITLE_PT - 2, color=style.MUTED, va="center",
        family="DejaVu Sans Mono", animated=True,
    )  # fmt: skip
