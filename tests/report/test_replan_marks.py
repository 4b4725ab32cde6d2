"""The diamonds where new paths begin."""

from __future__ import annotations

from dataclasses import replace

from viaspline.report.canvas import new_figure
from viaspline.report.labels import Labels
from viaspline.report.replan_marks import AROUND_VIA, USUAL, draw_replans
from viaspline.robot.run import Run


def test_a_new_path_that_begins_at_a_via_point_leaves_its_number_to_be_read(driven: Run) -> None:
    axes = new_figure(6, 6).add_subplot()
    axes.set(xlim=(0, 1000), ylim=(0, 1000))
    (replan, *_), via = driven.replans, driven.plan.path.vias[0]
    places = (((500.0, 500.0), USUAL, "white"), (via.at, AROUND_VIA, "none"))
    for at, size, fill in places:
        run = replace(driven, replans=(replace(replan, at=at),))
        (mark,) = draw_replans(axes, Labels(axes), run, many=False)
        assert mark.get_markersize() == size
        assert mark.get_markerfacecolor() == fill
