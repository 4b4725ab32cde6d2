"""The result of every search for a way.

Tested through ``planning/replanning/test_replan``.
"""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.planning.alternatives.kept_account import KeptAccount
from viaspline.planning.alternatives.record import Account
from viaspline.planning.problem.ledger import LedgerEntry
from viaspline.presentable.told_in_lines import told_in_lines


@told_in_lines
@dataclass(frozen=True)
class Solution:
    """A path that was proven clear.

    Attributes:
        path: The curve with its via points.
        certificate: Its proven clearance.
        account: Of the groups that were met and the sides that were tried; None where nothing
            was laid.
        changed_from: Distance along the path from which it differs from the one it replaces [m].
        rejoins_at: Distance along this path from which it is the old one again [m], or None.
    """

    path: Path
    certificate: Certificate
    account: Account | KeptAccount | None
    changed_from: float = 0.0
    rejoins_at: float | None = None

    @property
    def ledger(self) -> tuple[LedgerEntry, ...]:
        """Every group that was met and the sides that were tried."""
        return () if self.account is None else self.account.ledger
