"""Broken files of terrain, voxels and way points: each is refused in words, or sound.

``benchmarks/broken_files.py`` breaks thousands; here are some of each kind, and those that were a
defect once.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

BENCHMARKS = Path(__file__).parents[1] / "benchmarks"
OUTCOMES = {"planned", "refused", "no path", "gave up"}


@settings(deadline=None, max_examples=25)
@example(seed=4561)  # a terrain whose corner is 1e308 m off
@example(seed=5241)
@given(seed=st.integers(0, 10**6))
def test_a_broken_file_is_sound_or_refused_by_its_name(seed: int) -> None:
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(BENCHMARKS))
        from broken_files import KINDS, run

        word, wrong = run(seed, tuple(sorted(KINDS)))
    assert word in OUTCOMES
    assert wrong == ""
