"""How long the commands take as whole processes, on a warm cache and on none.

python benchmarks/startup.py [RUNS]
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

PATROL = Path(__file__).parent.parent / "examples" / "fig8-patrol.yaml"


def seconds(arguments: list[str], environment: dict[str, str]) -> float:
    begin = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "viaspline", *arguments],
        env=environment, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    return time.perf_counter() - begin


def main(runs: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | {"VIASPLINE_CACHE_DIR": f"{folder}/cache"}
        drive = ["run", str(PATROL), "--out", f"{folder}/out"]
        print(f"first run ever             {seconds(drive, environment):6.2f} s")
        commands = {"--help": ["--help"], "check": ["check", str(PATROL)], "run": drive}
        spent: dict[str, list[float]] = {name: [] for name in commands}
        for _ in range(runs):
            for name, arguments in commands.items():
                spent[name].append(seconds(arguments, environment))
        bare = []
        for _ in range(runs):
            begin = time.perf_counter()
            subprocess.run([sys.executable, "-c", "pass"], check=True)
            bare.append(time.perf_counter() - begin)
        for name, values in spent.items():
            print(f"{name:10s} on a warm cache {np.median(values):6.2f} s")
        print(f"bare interpreter           {np.median(bare):6.2f} s")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 7)
