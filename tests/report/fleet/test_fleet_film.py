from __future__ import annotations

from itertools import combinations, pairwise
from pathlib import Path

import numpy as np
from PIL import Image

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.timelines import timelines_of
from viaspline.report.canvas import new_figure
from viaspline.report.fleet.film_names import FilmNames
from viaspline.report.fleet.fleet_colours import ROBOT_COLOURS
from viaspline.report.fleet.fleet_film import FilmedFleet, film_fleet, film_times, fleet_frames
from viaspline.report.video_file import VideoFile
from viaspline.report.video_writer import Frame


def dark(frame: Frame) -> int:
    """Pixels of an arrow's colour on the map."""
    wanted = [0x1B, 0x1F, 0x24]
    return int((np.abs(frame[120:].astype(int) - wanted).max(axis=2) < 20).sum())


def test_robots_move_and_the_size_stays(fleet_plan: FleetPlan) -> None:
    frames = list(fleet_frames(FilmedFleet.of_plan(fleet_plan, "yard", 5)))
    assert len({frame.shape for frame in frames}) == 1
    assert all(size % 2 == 0 for size in frames[0].shape[:2])
    assert all((a != b).any() for a, b in pairwise(frames))
    for colour in ROBOT_COLOURS[:3]:
        wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
        assert (np.abs(frames[1].astype(int) - wanted).max(axis=2) < 12).sum() > 20


def test_an_arrow_goes_from_who_waits_to_whom(fleet_plan: FleetPlan) -> None:
    one = next(one for one in timelines_of(fleet_plan) if one.waits)
    wait = max(one.waits, key=lambda wait: wait.lost)
    filmed = FilmedFleet.of_plan(fleet_plan, "yard", 120)
    times = filmed.motion.times[filmed.frames]
    waiting = int(np.argmin(np.abs(times - 0.5 * (wait.begin + wait.end))))
    frames = list(fleet_frames(filmed))
    free = [k for k, time in enumerate(times) if not any(
        each.waits_for(time) for each in filmed.timelines)]  # fmt: skip
    assert dark(frames[waiting]) > max(dark(frames[k]) for k in free[5:-5:10])


def test_a_gif_of_a_drive_is_written_whole(
    fleet_plan: FleetPlan, fleet_run: FleetRun, tmp_path: Path
) -> None:
    heard: list[float] = []
    filmed = FilmedFleet.of_run(fleet_plan, fleet_run, "yard", 6)
    film_fleet(filmed, VideoFile(tmp_path / "fleet.gif"), heard.append)
    with Image.open(tmp_path / "fleet.gif") as film:
        assert film.n_frames == 6
    assert heard[-1] == 1.0


def test_trails_have_points_between_frames_that_are_far_apart() -> None:
    times, frames = film_times(0.0, 3600.0)
    assert len(frames) == 240
    assert frames[-1] == len(times) - 1
    assert (times[-1] - times[-2]) < 0.5


def test_names_cover_neither_robots_nor_each_other_and_stay_on_their_sides() -> None:
    axes = new_figure(6.0, 6.0).add_axes((0, 0, 1, 1))
    axes.set_xlim(0, 60)
    axes.set_ylim(0, 60)
    radii = np.full(4, 6.0)
    names = FilmNames(axes, {0: "one", 1: "two", 2: "three"}, radii)
    here = np.array([[30.0, 30.0], [30.0, 31.5], [30.0, 33.0], [np.nan, np.nan]])
    names.move(here)
    assert all(text.get_visible() for text in names.texts)
    boxes = [text.get_window_extent() for text in names.texts]
    assert not any(a.overlaps(b) for a, b in combinations(boxes, 2))
    middles = axes.transData.transform(here[:3])
    for k, box in enumerate(boxes):
        for other in np.delete(middles, k, axis=0):
            nearest = np.clip(other, box.min, box.max)
            assert np.hypot(*(other - nearest)) > 0.6 * radii[0]
    placed = [text.get_position() for text in names.texts]
    names.move(here + 0.01)
    assert [text.get_position() for text in names.texts] == placed


def test_the_name_of_a_robot_that_is_gone_is_not_shown() -> None:
    axes = new_figure(6.0, 6.0).add_axes((0, 0, 1, 1))
    names = FilmNames(axes, {0: "one", 1: "two"}, np.full(2, 6.0))
    names.move(np.array([[0.5, 0.5], [np.nan, np.nan]]))
    assert [text.get_visible() for text in names.texts] == [True, False]
