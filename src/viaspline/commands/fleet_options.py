"""Options for fleets only.

Tested through ``test_cli`` and ``commands/test_fleet_steps``.
"""

from __future__ import annotations

from typing import Final

import click

IMPROVE: Final = click.option(
    "--improve", type=click.FloatRange(min=0.0, max=1e6), default=0.0, metavar="SECONDS",
    help="How long to look for orders by which a fleet arrives sooner.  [default: 0]",
)  # fmt: skip
WORKERS: Final = click.option(
    "--workers", type=click.IntRange(1, 61), metavar="N",
    help="How many processes lay a fleet's paths.  [default: one per core where that pays]",
)  # fmt: skip
SCHEDULER: Final = click.option(
    "--scheduler", metavar="ADDRESS",
    help="Lay them on a cluster of dask.distributed: the address of its scheduler.",
)  # fmt: skip


def check_workers(workers: int | None, scheduler: str | None) -> None:
    """Refuse processes of this machine and a cluster at once."""
    if workers is not None and scheduler is not None:
        raise click.UsageError("give --workers or --scheduler, not both")


def check_of_fleets(improve: float, workers: int | None, scheduler: str | None) -> None:
    """Refuse options that mean nothing to a single robot."""
    for name, is_given in (
        ("--improve", improve > 0.0),
        ("--workers", workers is not None),
        ("--scheduler", scheduler is not None),
    ):
        if is_given:
            raise click.UsageError(f"{name} is for fleets; this is the mission of one robot")
