"""The film of a flight: where the robot is in plan and in elevation, and where it looks.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg

from viaspline.report import style
from viaspline.report.canvas import any_name
from viaspline.report.space.moving_in_space import solids_met
from viaspline.report.space.spatial_picture import drawn_page
from viaspline.report.video_file import VideoFile
from viaspline.report.video_writer import FILM_DPI, MAX_FRAMES, Frame, write_film
from viaspline.space.spatial_run import SpatialRun

ARROW_PX = 26.0
"""How long the arrow of the heading is."""


@any_name()
def film_flight(
    run: SpatialRun, name: str, film: VideoFile, progress: Callable[[float], None]
) -> None:
    """Film a flight.

    Args:
        run: What was flown.
        name: The mission's name.
        film: Where to.
        progress: Hears how much is done, from 0 to 1.
    """
    count = int(np.clip(len(run.times), 2, MAX_FRAMES))
    write_film(film, flight_frames(run, name, count), count, progress)


def flight_frames(run: SpatialRun, name: str, count: int) -> Iterator[Frame]:
    """Pictures of the flight, equally far apart in time; what stands still is drawn once."""
    sheet = drawn_page(run.plan, name, FILM_DPI)
    axes = (sheet.elevation, *sheet.strips)
    cursors = [one.axvline(0.0, color=style.INK, linewidth=0.9) for one in axes]
    (side,) = sheet.elevation.plot(
        [], [], "o", color=style.UNSEEN, markeredgecolor=style.INK, markersize=7, zorder=9
    )
    (above,) = sheet.map.plot(
        [], [], "o", color=style.UNSEEN, markeredgecolor=style.INK, markersize=8, zorder=30
    )
    (nose,) = sheet.map.plot([], [], color=style.INK, linewidth=1.6, zorder=31)
    up = float(sheet.figure.get_size_inches()[1])
    clock = sheet.figure.text(
        0.98, 1 - 0.3 / up, "", size=style.TEXT_PT, color=style.MUTED, ha="right", va="center",
        family="DejaVu Sans Mono",
    )  # fmt: skip
    solids = solids_met(run)
    (movers,) = sheet.map.plot(
        [], [], "o", color=style.MOVING_FILL, markeredgecolor=style.MOVING, markersize=9, zorder=29
    )
    moving: tuple[Artist, ...] = (*cursors, side, movers, above, nose, clock)
    for artist in moving:
        artist.set_animated(True)
    canvas = sheet.figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    canvas.draw()  # type: ignore[no-untyped-call]
    still = canvas.copy_from_bbox(sheet.figure.bbox)  # type: ignore[no-untyped-call]
    length = ARROW_PX / sheet.pixels_per_metre
    for time in np.linspace(run.times[0], run.times[-1], count).tolist():
        x, y, z = (float(np.interp(time, run.times, run.positions[:, k])) for k in range(3))
        heading = float(np.interp(time, run.times, run.headings))
        speed = float(np.interp(time, run.times, run.speeds))
        distance = float(np.asarray(run.plan.trajectory.distance_at(time)))
        for cursor in cursors:
            cursor.set_xdata([distance, distance])
        side.set_data([distance], [z])
        above.set_data([x], [y])
        here = [one.at(np.array([time]))[0] for one in solids]
        movers.set_data([at[0] for at in here], [at[1] for at in here])
        nose.set_data([x, x + length * np.cos(heading)], [y, y + length * np.sin(heading)])
        clock.set_text(f"{time:6.1f} s  {speed:5.2f} m/s  {z:6.1f} m")
        canvas.restore_region(still)  # type: ignore[no-untyped-call]
        for artist in moving:
            sheet.figure.draw_artist(artist)
        pixels = np.asarray(canvas.buffer_rgba())[..., :3]  # type: ignore[no-untyped-call]
        height, width = (size - size % 2 for size in pixels.shape[:2])
        yield pixels[:height, :width].copy()
