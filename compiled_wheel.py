#!/usr/bin/env python3
"""A wheel with compiled kernels: whoever installs it plans at once, without compiling first.

    .venv/bin/python compiled_wheel.py                  dist/viaspline-….whl, after some minutes
    .venv/bin/python compiled_wheel.py --kinds plain    with what plain missions need alone

Run from a checkout, by a Python in which viaspline is installed with the versions of numba and
numpy that the wheel is for: the compiled kernels are loaded with these alone, and compiled as ever
with others. They are compiled for processors of x86-64-v3 (Intel since 2013, AMD since 2017), or
on other machines for what numba calls generic.
"""

from __future__ import annotations

import argparse
import os
import platform
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent
X86_64_V3 = (
    "cx16", "sahf", "sse", "sse2", "sse3", "ssse3", "sse4.1", "sse4.2", "popcnt", "avx", "avx2",
    "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe", "xsave",
)  # fmt: skip


def features() -> str:
    """What the processor has to be able to do, as numba wants it."""
    is_x86 = platform.machine().lower() in ("x86_64", "amd64")
    return ",".join(f"+{one}" for one in X86_64_V3) if is_x86 else ""


def run(environment: dict[str, str], *words: str | Path) -> None:
    """Run a module of this Python; stop with its exit code if it fails."""
    command = [sys.executable, "-m", *map(str, words)]
    print(f"$ python -m {' '.join(map(str, words))}", flush=True)
    code = subprocess.run(command, cwd=ROOT, env=environment, check=False).returncode
    if code:
        sys.exit(code)


def main() -> None:
    """Compile, pack, build."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=ROOT / "dist", help="folder of the wheel")
    parser.add_argument("--kinds", nargs="*", help="of missions; all if none are given")
    parser.add_argument("--cache", type=Path, help="keeps what was compiled for the next time")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        cache, compiled = chosen.cache or Path(scratch, "cache"), Path(scratch, "compiled")
        environment = os.environ | {
            "PYTHONPATH": str(ROOT / "src"),
            "VIASPLINE_CACHE_DIR": str(cache),
            "NUMBA_CPU_NAME": "generic",
            "NUMBA_CPU_FEATURES": features(),
        }
        for kind in chosen.kinds or ():
            run(environment, "viaspline.warming.record_kind", kind)
        if not chosen.kinds:
            run(environment, "viaspline", "warm", "--all")
        run(environment, "viaspline.warming.pack_kernels", compiled)
        told = os.environ | {"VIASPLINE_COMPILED": str(compiled)}
        run(told, "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", chosen.out, ROOT)
    for wheel in sorted(chosen.out.glob("viaspline-*.whl")):
        print(f"{wheel} ({wheel.stat().st_size / 1e6:.1f} MB)")


if __name__ == "__main__":
    main()
