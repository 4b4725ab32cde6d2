"""The drive of a simulated cart, found as a person would find it: by ``viaspline identify``.

The commands of ``viaspline identify --drive`` are driven in the simulator, on a floor without any
posts, without feedback; the log goes to ``viaspline identify``, and the keys that it prints into a
mission. Nothing of the simulator's own figures is used.
"""

from __future__ import annotations

import csv
import subprocess
import sys
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from sim_bridge import PERIOD, TRACK, SimulatedCart

from viaspline.identify.drive_log import COLUMNS

SPEED, YAW_RATE = 1.0, 1.5
"""Greatest of the test drive [m/s], [rad/s]."""


def identified(cart: SimulatedCart, folder: Path) -> dict[str, Any]:
    """The keys below ``robot`` that a cart's test drive has shown.

    Args:
        cart: On free ground.
        folder: Commands, log and keys are left there.
    """
    commands, log, keys = (
        folder / name for name in ("commands.csv", "test_drive.csv", "drive.yaml")
    )
    viaspline(
        "identify", "--drive", str(commands), "--max-speed", f"{SPEED}",
        "--max-yaw-rate", f"{YAW_RATE}", "--period", f"{PERIOD}",
    )  # fmt: skip
    with commands.open() as told, log.open("w", newline="") as driven:
        rows = csv.writer(driven)
        rows.writerow(COLUMNS)
        for row in csv.DictReader(told):
            speed = float(row["speed_command_mps"])
            yaw_rate = float(row["yaw_rate_command_radps"])
            state = cart.state
            rows.writerow([cart.time, *state.position, state.heading, speed, yaw_rate])
            cart.drive(speed, yaw_rate)
    viaspline("identify", str(log), "--track", f"{TRACK}", "--out", str(keys))
    with keys.open() as text:
        return dict(YAML(typ="safe").load(text)["robot"])


def viaspline(*arguments: str) -> None:
    """Run a command of viaspline in a process of its own."""
    subprocess.run([sys.executable, "-m", "viaspline", *arguments], check=True)
