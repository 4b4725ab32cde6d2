"""The result of every search for a way."""

from __future__ import annotations

from dataclasses import dataclass

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.detour.ledger import LedgerEntry


@dataclass(frozen=True)
class Detoured:
    """A path that was proven clear.

    Attributes:
        path: The curve with its via points.
        certificate: Its proven clearance.
        ledger: Every group that was met and the sides that were tried.
        changed_from: Distance along the path from which it differs from the one it replaces [m].
        rejoins_at: Distance along this path from which it is the old one again [m], or None.
    """

    path: Path
    certificate: Certificate
    ledger: tuple[LedgerEntry, ...]
    changed_from: float = 0.0
    rejoins_at: float | None = None
