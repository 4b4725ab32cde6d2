"""``viaspline download``: what can go wrong; what goes well stands beside the upload."""

from pathlib import Path

from click.testing import CliRunner

from viaspline.cli import cli


def test_only_plans_are_written(tmp_path: Path) -> None:
    words = ["download", str(tmp_path / "board.kml"), "--from", "udp:127.0.0.1:14999"]
    result = CliRunner().invoke(cli, words)
    assert result.exit_code == 2
    assert "doesn't end with .plan" in result.output


def test_an_address_that_is_none_is_refused(tmp_path: Path) -> None:
    words = ["download", str(tmp_path / "board.plan"), "--from", "bluetooth:x"]
    result = CliRunner().invoke(cli, words)
    assert result.exit_code == 2
    assert "it can be udp:HOST:PORT" in result.output
    assert list(tmp_path.iterdir()) == []
