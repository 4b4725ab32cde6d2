"""Where the lines and turns round a row of bends settle, for ramps of given lengths.

Every turn moves the lines at its ends a little, and they move the turns. They are laid in turn
until nothing moves; what doesn't settle, or has no line, tells where.

Tested through ``kernels/turning/test_turn_sequence``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.jit import inner, uncounted
from viaspline.kernels.turning.clothoid import MIN_TURN_RAD, shape_of

# Columns of a bend: its middle, the radius that is kept from it, the side to which it turns (1
# left, -1 right, 0 whichever comes), the heading that is given at an end (NaN: it is free), and
# the least radius of its turn.
X, Y, KEPT, SIDE, HEADING, RADIUS = range(6)
FINE, NO_TANGENT, NO_ROOM, RESTLESS, LEFT_OUT = range(5)
MAX_HEADING_ROUNDS = 400
SETTLED_RAD = 1e-13  # change of a heading in the last round [rad]
RESTING_RAD = 1e-10  # the same, if it won't become less [rad]
ROUGHLY_SETTLED_RAD = 1e-3  # the same, where lines are missing or turns overlap [rad]
LEAST_RESTLESS = 0.05  # a line that still turns, of what the most restless one does
WRONG_TURN_RAD = 1e-9  # by which a bend is turned at to the wrong side, at least [rad]
WRONG_PER_SETTLED = 10.0  # the same, over the change of a heading in the last round
UNMOVED = 0.3  # of that: a turn between lines that change less stays as it is
HOPELESS_ROUNDS = 40  # in which the least change isn't halved: they go round and round
ROUGHLY_HOPELESS_ROUNDS = 16  # the same, where they need to settle roughly only
ACCELERATED_RAD = 0.05  # change of a heading from which on the next changes are foreseen [rad]
MAX_OVERSHOOT = 20.0  # of such a change
LEAST_SIDED_RAD = 1e-9  # to the other side than that which is set: none [rad]
GENTLE_TURN_RAD = 1.2  # turns up to this are reckoned from where their lines meet [rad]


@inner
def wrapped(angle: float, about: float) -> float:
    """The angle plus whole turns, within half a turn of ``about``."""
    return angle - 2.0 * math.pi * math.floor((angle - about + math.pi) / (2.0 * math.pi))


@uncounted
def touching_line(circles: Floats, i: int, j: int) -> float:
    """Heading of the line that touches circle i and then circle j; NaN where there is none."""
    dx = circles[j, 0] - circles[i, 0]
    dy = circles[j, 1] - circles[i, 1]
    gap = math.hypot(dx, dy)
    offset = circles[j, 2] - circles[i, 2]
    if gap <= abs(offset) or gap == 0.0:
        return np.nan
    return math.atan2(dy, dx) - math.asin(offset / gap)


@uncounted
def _turn_at(bend: Floats, before: float, after: float, last: float) -> float:
    """By how much the path turns at a bend, left positive; ``last`` is what it was."""
    if math.isnan(bend[HEADING]):
        return wrapped(after - before, last)
    if bend[SIDE] == 0.0:  # the lesser turn, which near half a turn stays to the side where it is
        return wrapped(after - before, min(max(last, -0.5 * math.pi), 0.5 * math.pi))
    # To the given side, by less than a whole turn: what was nearly one may have gone beyond it,
    # and is hardly any then.
    turned = bend[SIDE] * (after - before)
    turned -= 2.0 * math.pi * math.floor((turned + LEAST_SIDED_RAD) / (2.0 * math.pi))
    return bend[SIDE] * max(turned, 0.0)


@uncounted
def turn_radius(bend: Floats) -> float:
    """The radius of its turn [m]: no less than what is kept from its middle."""
    return max(bend[RADIUS], bend[KEPT])


@uncounted
def _place(bend: Floats, kind: int, turn: float, heading: float, ramp: float, circle: Floats,
           apex: Floats) -> None:  # fmt: skip
    """Where the turn of a bend lies: the circle that its lines touch, and its apex.

    Args:
        bend: Its row.
        kind: -1 where the path starts at it, 1 where it ends, 0 in between.
        turn: [rad], left is positive.
        heading: At the apex [rad].
        ramp: [m].
        circle: x, y, signed radius; filled. A radius of 0 is the point where the lines meet.
        apex: x, y; filled.
    """
    theta = abs(turn)
    if theta < MIN_TURN_RAD or (kind == 0 and bend[SIDE] * turn < 0.0):
        off = bend[SIDE] * bend[KEPT]  # what may prove needless is touched without a turn
        apex[0], apex[1] = bend[X] + off * math.sin(heading), bend[Y] - off * math.cos(heading)
        circle[0], circle[1], circle[2] = apex[0], apex[1], 0.0
        return
    side = 1.0 if turn > 0.0 else -1.0
    radius, shift, lead = shape_of(theta, turn_radius(bend), ramp)
    touch = radius + shift
    out_x, out_y = side * math.sin(heading), -side * math.cos(heading)
    if kind == 0:
        apex[0], apex[1] = bend[X] + bend[KEPT] * out_x, bend[Y] + bend[KEPT] * out_y
        center_x, center_y = apex[0] - radius * out_x, apex[1] - radius * out_y
    else:
        given = heading + kind * 0.5 * turn
        c, s = math.cos(given), math.sin(given)
        if theta < GENTLE_TURN_RAD:
            reach = -kind * (lead + touch * math.tan(0.5 * theta))
            meet_x, meet_y = bend[X] + reach * c, bend[Y] + reach * s
            height = touch / math.cos(0.5 * theta)
            center_x, center_y = meet_x - height * out_x, meet_y - height * out_y
        else:
            center_x = bend[X] - kind * lead * c - side * touch * s
            center_y = bend[Y] - kind * lead * s + side * touch * c
        apex[0], apex[1] = center_x + radius * out_x, center_y + radius * out_y
    if theta < GENTLE_TURN_RAD:
        height = touch / math.cos(0.5 * theta)
        circle[0], circle[1] = center_x + height * out_x, center_y + height * out_y
        circle[2] = 0.0
    else:
        circle[0], circle[1], circle[2] = center_x, center_y, side * touch


@uncounted
def needless_bend(bends: Floats, closed: bool, turns: Floats, settled: float) -> int:
    """The bend that is turned at most to the wrong side: the others make it needless; else -1.

    Only the last round tells: before the turns have settled, one may seem so that is needed.

    Args:
        bends: As in ``turn_sequence``.
        closed: The same.
        turns: [rad], (n,).
        settled: By how much headings changed in the last round [rad].
    """
    worst, found, count = -max(WRONG_TURN_RAD, WRONG_PER_SETTLED * settled), -1, bends.shape[0]
    for k in range(0 if closed else 1, count if closed else count - 1):
        if bends[k, SIDE] * turns[k] < worst:
            worst, found = bends[k, SIDE] * turns[k], k
    return found


@uncounted
def _overshoot(steps: Floats, before: Floats) -> float:
    """How much of the last change is taken back, so that what is left to go is least.

    D. G. Anderson, Iterative procedures for nonlinear integral equations (1965), with one step of
    memory.
    """
    both, square = 0.0, 0.0
    for k in range(steps.shape[0]):
        change = steps[k] - before[k]
        both += steps[k] * change
        square += change * change
    return max(min(both / square, 1.0), -MAX_OVERSHOOT) if square > 0.0 else 0.0


@uncounted
def _lay(
    bends: Floats, closed: bool, ramps: Floats, lines: Floats, turns: Floats,
    circles: Floats, apexes: Floats, laid: Floats, fresh: Flags, unmoved: float,
) -> None:  # fmt: skip
    """Lay the turns between lines anew, but where these have hardly moved since.

    Args:
        bends: As in ``turn_sequence``, and so are the next three.
        closed: The same.
        ramps: The same.
        lines: The same.
        turns: [rad], (n,); changed.
        circles: What lines touch, (n, 3); changed.
        apexes: [m], (n, 2); changed.
        laid: The headings before and after each turn as it was last laid [rad], (n, 2); changed.
        fresh: Which turns are laid anew, (n,); filled.
        unmoved: By what these may differ [rad].
    """
    count, last = bends.shape[0], lines.shape[0]
    for k in range(count):
        kind = 0
        if not closed and k == 0:
            kind, after = -1, lines[0]
            before = after if math.isnan(bends[k, HEADING]) else bends[k, HEADING]
        elif not closed and k == count - 1:
            kind, before = 1, lines[last - 1]
            after = before if math.isnan(bends[k, HEADING]) else bends[k, HEADING]
        else:
            before, after = lines[(k - 1) % last], lines[k]
        fresh[k] = max(abs(before - laid[k, 0]), abs(after - laid[k, 1])) > unmoved
        if fresh[k]:
            laid[k, 0], laid[k, 1] = before, after
            turns[k] = _turn_at(bends[k], before, after, turns[k])
            middle = before + 0.5 * turns[k] if kind >= 0 else after - 0.5 * turns[k]
            _place(bends[k], kind, turns[k], middle, ramps[k], circles[k], apexes[k])


@inner
def settle(
    bends: Floats, closed: bool, ramps: Floats, lines: Floats, turns: Floats,
    circles: Floats, apexes: Floats, laid: Floats, tight: Flags, settled: float,
) -> tuple[int, float]:  # fmt: skip
    """Let lines and turns settle, until no heading changes more than ``settled`` [rad] in a round.

    Lines and turns have the values of a first guess, or of what they settled to before; ``laid`` is
    infinite for turns that have changed since, see ``_lay``.

    Returns:
        What came of it, and by how much headings still change [rad]; ``tight`` says at which
        lines it failed.
    """
    count = bends.shape[0]
    last = count if closed else count - 1
    came_from, steps, steps_before = lines.copy(), np.zeros(last), np.zeros(last)
    touching = np.zeros(last)
    fresh = np.ones(count, np.bool_)
    moved, least, least_before = 0.0, math.inf, math.inf
    missing = False
    hopeless = HOPELESS_ROUNDS if settled < ROUGHLY_SETTLED_RAD else ROUGHLY_HOPELESS_ROUNDS
    for round_ in range(MAX_HEADING_ROUNDS):
        if round_ % hopeless == 0 and round_ > 0:
            if least > 0.5 * least_before:
                break
            least, least_before = math.inf, least
        moved, missing = 0.0, False
        for k in range(last):
            after = (k + 1) % count
            if fresh[k] or fresh[after]:
                touching[k] = touching_line(circles, k, after)
            tight[k] = math.isnan(touching[k])  # stays, until its ends have found their places
            missing = missing or tight[k]
            steps_before[k] = steps[k]
            steps[k] = 0.0 if tight[k] else wrapped(touching[k], lines[k]) - lines[k]
            moved = max(moved, abs(steps[k]))
        if missing and round_ > 0 and moved < ROUGHLY_SETTLED_RAD:
            break
        least = min(least, moved)
        share = _overshoot(steps, steps_before) if round_ > 1 and moved < ACCELERATED_RAD else 0.0
        for k in range(last):
            here, line = lines[k], lines[k] + steps[k]
            lines[k] = line - share * (line - came_from[k] - steps_before[k])
            came_from[k] = here
        if round_ > 0 and moved < settled:
            return FINE, settled
        _lay(bends, closed, ramps, lines, turns, circles, apexes, laid, fresh, UNMOVED * settled)
    is_restless = moved >= (ROUGHLY_SETTLED_RAD if missing else max(RESTING_RAD, settled))
    if is_restless:
        _add_restless(steps, tight)
    state = RESTLESS if is_restless else FINE
    if missing:
        state = NO_TANGENT
    return state, max(settled, moved)


@inner
def _add_restless(steps: Floats, tight: Flags) -> None:
    """Tell the lines that still turn, of neighbours the one that turns most."""
    most = max(np.abs(steps).max() * LEAST_RESTLESS, SETTLED_RAD)
    for k in range(steps.size):
        here = abs(steps[k])
        before = abs(steps[k - 1]) if k > 0 else 0.0
        after = abs(steps[k + 1]) if k + 1 < steps.size else 0.0
        tight[k] = tight[k] or (here >= most and here >= before and here > after)
