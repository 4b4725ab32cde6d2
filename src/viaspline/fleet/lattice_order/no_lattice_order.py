"""Why a lattice gives no order in which robots could pass each other.

Tested through ``fleet/lattice_order/test_solve_lattice``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class NoLatticeOrder:
    """That there is none, or that none was found.

    Attributes:
        outcome: ``refused``: proven that there is none on the lattice, which says nothing about
            other ways to drive; ``gave up``: none was found, or there is no such lattice.
        reason: Why, in words.
        remedy: What would help.
    """

    outcome: Literal["refused", "gave up"]
    reason: str
    remedy: str
