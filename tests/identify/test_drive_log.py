"""Logs of drives, read from CSV files: what is wrong is named by its line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from viaspline.errors import GeometryError, MissionError
from viaspline.identify.drive_log import COLUMNS, DriveLog, DriveLogError, drive_csv, read_drive_csv

T = np.arange(0.0, 10.0, 0.05)
LOG = DriveLog(T, np.sin(T), T, 3.0 + T, 0 * T + 0.5, 0 * T)


def test_a_log_that_is_written_is_read_again(tmp_path: Path) -> None:
    (tmp_path / "log.csv").write_text(drive_csv(LOG))
    again = read_drive_csv(tmp_path / "log.csv")
    for name in ("times", "x", "y", "headings", "speeds", "yaw_rates"):
        assert np.allclose(getattr(again, name), getattr(LOG, name), atol=1e-6)


def test_headings_run_on_and_may_be_in_degrees(tmp_path: Path) -> None:
    lines = drive_csv(LOG).replace("heading_rad", "heading_deg").splitlines()
    (tmp_path / "log.csv").write_text("\n".join(lines))
    assert np.allclose(read_drive_csv(tmp_path / "log.csv").headings, np.radians(LOG.headings))
    wrapped = DriveLog(T, T, T, np.remainder(5.0 * T, 2 * np.pi), T, T)
    assert np.allclose(np.diff(wrapped.headings), 0.25)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "is empty"),
        ("time_s,x_m\n1,2\n", "no column y_m"),
        (",".join(COLUMNS) + "\n0,0,0,0,0,0\n1,2,x,4,5,6\n", r":3: y_m is 'x'"),
        (",".join(COLUMNS) + "\n0,0,0,nan,0,0\n", r":2: heading_rad is 'nan'"),
        (",".join(COLUMNS) + "\n0,0,0\n", r":2: heading_rad is ''"),
        (",".join(COLUMNS) + "\n0,0,0,0,0,0\n1,0,0,0,0,0\n", "too short"),
        (",".join(COLUMNS) + "\n" + 60 * "1,0,0,0,0,0\n", "have to increase"),
    ],
)
def test_a_file_that_is_no_log_is_refused_by_line(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "log.csv").write_text(text)
    with pytest.raises(DriveLogError, match=said):
        read_drive_csv(tmp_path / "log.csv")


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(MissionError, match="no such file"):
        read_drive_csv(tmp_path / "none.csv")


def test_arrays_that_make_no_log_are_refused() -> None:
    with pytest.raises(GeometryError, match="different lengths"):
        DriveLog(T, T[1:], T, T, T, T)
    with pytest.raises(GeometryError, match="finite"):
        DriveLog(T, T * np.nan, T, T, T, T)
    with pytest.raises(ValueError, match="read-only"):
        LOG.x[0] = 1.0
