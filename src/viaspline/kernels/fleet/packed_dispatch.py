"""How far a fleet has come and how far it may go, as the kernels that drive it see it.

Tested through ``fleet/execution/test_fleet_orders``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Flags, Floats, Ints


class PackedDispatch(NamedTuple):
    """The state of a fleet under way, as far as is known of it; all of it is written to.

    Attributes:
        leaders: Who passes each crossing first; negative: there is no order in it, (c,).
        progress: How far each robot has come at least [m]; infinite: it has left the world, (n,).
        head: The first bar of each robot that isn't open, (n,).
        promised: The farthest that a robot may take to be granted [m], (n,).
        recall: The crossing that a robot is to let another pass first, if it still can; -1: none,
            (n,).
        recall_place: Before which it is to stay for that [m]; infinite: none, (n,).
        recalled_at: Since when it is asked to, or to stop where ``halt`` is [s]; infinite: it isn't
            asked to, for it doesn't say how far it takes itself to be let, (n,).
        begin: When each robot would have set out to be where it is without any waits [s], (n,).
        moved_at: When it was last seen to get on, or held back [s], (n,).
        fixed: Whether a robot never gets on any more, (n,).
        departs: When each robot may set out [s], (n,).
        halt: Beyond which a robot isn't let for now, whoever is in its way: it has to stand there
            [m]; infinite: nowhere, (n,).
    """

    leaders: Ints
    progress: Floats
    head: Ints
    promised: Floats
    recall: Ints
    recall_place: Floats
    recalled_at: Floats
    begin: Floats
    moved_at: Floats
    fixed: Flags
    departs: Floats
    halt: Floats
