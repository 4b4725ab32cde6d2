"""What a search told, kept without what it searched in.

Tested through ``saved_plans/test_load_plan``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.planning.problem.ledger import LedgerEntry
from viaspline.planning.problem.preferred_clearance import PreferredClearance


@dataclass(frozen=True)
class KeptAccount:
    """The account of a search that was made elsewhere, or earlier, as it stands in a file.

    Attributes:
        ledger: Every group that was met and the sides that were tried.
        preferred: What more clearance was weighed; None where none is asked for.
    """

    ledger: tuple[LedgerEntry, ...]
    preferred: PreferredClearance | None = None
