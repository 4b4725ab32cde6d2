"""Which robots have a course anywhere near those of some robots.

Tested through ``fleet/test_crossings``.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Flags, Ints
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.growable import new_floats
from viaspline.kernels.jit import kernel


@kernel
def mark_neighbours(courses: PackedCourses, asked: Ints, out: Flags) -> None:
    """Mark the robots whose courses' boxes come near those of the ones that are asked for.

    Args:
        courses: PackedCourses.
        asked: The robots that are asked for, (k,).
        out: (n,), set to whether each is marked; those that are asked for are.
    """
    robots = courses.reach.shape[0]
    box = new_floats(robots, 4)
    for robot in range(robots):
        node = courses.first[robot]
        low_x, low_y = courses.place[node, 0], courses.place[node, 1]
        high_x, high_y, bow = low_x, low_y, 0.0
        for k in range(node, courses.first[robot + 1]):
            x, y = courses.place[k, 0], courses.place[k, 1]
            low_x, low_y = min(low_x, x), min(low_y, y)
            high_x, high_y = max(high_x, x), max(high_y, y)
            bow = max(bow, courses.bow[k])
        more = courses.reach[robot] + bow
        box[robot, 0], box[robot, 1] = low_x - more, low_y - more
        box[robot, 2], box[robot, 3] = high_x + more, high_y + more
        out[robot] = False
    for one in asked:
        for robot in range(robots):
            beside = box[robot, 0] > box[one, 2] or box[robot, 2] < box[one, 0]
            beside = beside or box[robot, 1] > box[one, 3] or box[robot, 3] < box[one, 1]
            if not beside:
                out[robot] = True
