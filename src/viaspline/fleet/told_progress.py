"""What is told of a plan of a fleet while it is made.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

from collections.abc import Callable

FleetProgress = Callable[[str, float], None]
"""Called with what is being done, and the share of it that is done."""


def untold(stage: str, share: float) -> None:
    """Tell nobody.

    Args:
        stage: What is being done.
        share: What of it is done.
    """
