"""Options that mean something to fleets only.

Tested through ``test_cli`` and ``commands/test_fleet_steps``.
"""

from __future__ import annotations

from typing import Final

import click

IMPROVE: Final = click.option(
    "--improve", type=click.FloatRange(min=0.0, max=1e6), default=0.0, metavar="SECONDS",
    help="For so long sooner orders of a fleet's robots are sought.  [default: 0]",
)  # fmt: skip
WORKERS: Final = click.option(
    "--workers", type=click.IntRange(1, 61), metavar="N",
    help="So many processes lay a fleet's paths.  [default: one for each core where that pays]",
)  # fmt: skip
SCHEDULER: Final = click.option(
    "--scheduler", metavar="ADDRESS",
    help="A cluster of dask.distributed lays them: the address of its scheduler.",
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
