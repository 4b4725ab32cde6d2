"""The command: what it says, what it refuses, and how it ends."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest
from click.testing import CliRunner

from viaspline.cli import cli
from viaspline.errors import StudioError
from viaspline.studio import serve
from viaspline.studio.serve import Address

EXAMPLES = Path(__file__).parents[2] / "examples"


def studio(*arguments: object) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "viaspline", "studio", *map(str, arguments), "--no-browser"],
        text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ},
    )  # fmt: skip


@pytest.mark.skipif(os.name == "nt", reason="signals of another kind")
def test_it_says_where_it_is_and_ends_with_ctrl_c() -> None:
    process = studio(EXAMPLES / "fig8-patrol.yaml", "--port", 0)
    assert process.stdout is not None
    line = process.stdout.readline()
    url = line.split(" at ")[1].split(" ")[0]
    with urllib.request.urlopen(url) as answer:
        assert b"viaspline studio" in answer.read()
    process.send_signal(signal.SIGINT)
    _, told = process.communicate(timeout=120)
    assert process.returncode == 130
    assert "Traceback" not in told


def test_a_taken_port_is_named_with_the_remedy() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        result = CliRunner().invoke(cli, ["studio", "--port", str(port), "--no-browser"])
    assert result.exit_code == 2
    assert f"port {port} is taken" in result.output
    assert f"--port {port + 1}" in result.output


def test_without_the_extra_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(serve, "find_spec", lambda name: None if name == "uvicorn" else True)
    result = CliRunner().invoke(cli, ["studio", "--no-browser"])
    assert result.exit_code == 2
    assert "pip install 'viaspline[studio]'" in result.output
    assert "uvicorn" in result.output


@pytest.mark.parametrize("text", ["a: [", "a: 1\na: 2\n", "route: {start: [.inf, 0]}\n"])
def test_a_file_that_can_not_be_edited_is_refused_before_the_page_opens(
    tmp_path: Path, text: str
) -> None:
    file = tmp_path / "broken.yaml"
    file.write_text(text)
    result = CliRunner().invoke(cli, ["studio", str(file), "--port", "0", "--no-browser"])
    assert result.exit_code == 2
    assert "broken.yaml" in result.output


def test_a_file_that_is_not_there_is_refused() -> None:
    result = CliRunner().invoke(cli, ["studio", "nowhere.yaml", "--port", "0", "--no-browser"])
    assert result.exit_code == 2
    assert "there is no such file" in result.output


def test_another_address_gets_a_token_and_a_wrong_one_a_reason() -> None:
    address = Address.bound("0.0.0.0", 0, None)
    address.listener.close()
    assert "?token=" in address.url
    given = Address.bound("0.0.0.0", 0, "open sesame")
    given.listener.close()
    assert given.url.endswith("?token=open%20sesame")
    with pytest.raises(StudioError, match="no address"):
        Address.bound("no such host.invalid", 0, None)
    with pytest.raises(StudioError, match="leave out --host"):
        Address.bound("203.0.113.7", 0, None)


def test_help_imports_no_server() -> None:
    code = (
        "import sys; from click.testing import CliRunner; from viaspline.cli import cli; "
        "CliRunner().invoke(cli, ['studio', '--help']); "
        "print(sorted({'starlette', 'uvicorn', 'numba'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], text=True, capture_output=True, check=True)
    assert done.stdout.strip() == "[]"
