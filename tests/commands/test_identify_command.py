"""The command that fits a drive: what it writes and says, and what it refuses."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from ruamel.yaml import YAML

from viaspline.cli import cli
from viaspline.mission.model import Mission

MISSION = """\
robot:
  max_speed_mps: 1.2
  drive: {differential: {track_m: 0.4}, delay_s: 0.2, lag_s: 0.15, speed_noise_mps: 0.01}
  localization: {position_noise_m: 0.005, heading_noise_deg: 0.3}
route: {start: [0, 0], goal: [10, 0]}
"""


def run(*arguments: object) -> Result:
    return CliRunner().invoke(cli, ["identify", *map(str, arguments)])


def test_what_is_simulated_is_identified_and_can_be_pasted(tmp_path: Path) -> None:
    (tmp_path / "m.yaml").write_text(MISSION)
    done = run("--drive", tmp_path / "log.csv", "--on", tmp_path / "m.yaml", "--seed", 2)
    assert done.exit_code == 0, done.output
    assert "log.csv" in done.output
    found = run(tmp_path / "log.csv", "--track", 0.4)
    assert found.exit_code == 0, found.output
    block = YAML(typ="safe").load(found.output)
    mission = Mission.model_validate({**block, "route": {"start": [0, 0], "goal": [10, 0]}})
    drive = mission.robot.drive
    assert drive is not None
    assert drive.delay_s == pytest.approx(0.2, abs=0.02)
    assert drive.lag_s == pytest.approx(0.15, abs=0.02)
    assert drive.kind.example.keys() == {"track_m"}
    out = run(tmp_path / "log.csv", "--track", 0.4, "--out", tmp_path / "drive.yaml")
    assert "wrote" in out.output
    assert (tmp_path / "drive.yaml").read_text() == found.output


def test_a_car_is_identified_and_can_be_pasted(tmp_path: Path) -> None:
    car = MISSION.replace("differential: {track_m: 0.4}",
                          "ackermann: {wheelbase_m: 0.9, max_steer_deg: 25}")  # fmt: skip
    (tmp_path / "m.yaml").write_text(car)
    done = run("--drive", tmp_path / "log.csv", "--on", tmp_path / "m.yaml", "--max-yaw-rate", 9)
    assert done.exit_code == 0, done.output
    found = run(tmp_path / "log.csv", "--wheelbase", 0.9)
    assert found.exit_code == 0, found.output
    block = YAML(typ="safe").load(found.output)
    mission = Mission.model_validate({**block, "route": {"start": [0, 0], "goal": [10, 0]}})
    assert mission.robot.drive is not None
    radius = mission.robot.drive.kind.turn_radius
    assert radius is not None
    assert radius > 0.95 * 0.9 / math.tan(math.radians(25.0))


def test_no_command_is_tighter_than_the_turning_circle(tmp_path: Path) -> None:
    out = tmp_path / "c.csv"
    done = run("--drive", out, "--max-yaw-rate", 9, "--turn-radius", 3.0)
    assert done.exit_code == 0, done.output
    rows = [[float(one) for one in row.split(",")] for row in out.read_text().splitlines()[1:]]
    turned = [abs(rate) / speed for _, speed, rate in rows if rate]
    assert max(turned) == pytest.approx(1.0 / 3.0, abs=1e-3)
    assert any(rate > 0.0 for _, _, rate in rows)
    assert any(rate < 0.0 for _, _, rate in rows)


def test_commands_are_written_with_the_ground_that_they_take(tmp_path: Path) -> None:
    done = run("--drive", tmp_path / "c.csv", "--max-speed", 2, "--period", 0.1)
    assert done.exit_code == 0, done.output
    assert "m ahead, 0.0 m behind" in done.output
    first, *rows = (tmp_path / "c.csv").read_text().splitlines()
    assert first == "time_s,speed_command_mps,yaw_rate_command_radps"
    assert max(float(row.split(",")[1]) for row in rows) == 2.0


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        ([], 2, "give the LOG"),
        (["a.csv", "--drive", "b.csv"], 2, "not both"),
        (["--drive", "b.csv", "--period", "60"], 2, "give 0.001 to 0.2 s"),
        (["--drive", "b.csv", "--period", "1e-9"], 2, "give 0.001 to 0.2 s"),
        (["a.csv", "--max-speed", "1"], 2, "go with --drive"),
        (["a.csv", "--turn-radius", "1"], 2, "go with --drive"),
        (["a.csv", "--track", "1", "--wheelbase", "1"], 2, "not both"),
        (["--drive", "b.csv", "--wheelbase", "1"], 2, "not both"),
        (["a.csv", "--wheelbase", "0"], 2, "--wheelbase"),
        (["none.csv"], 2, "no such file"),
        (["a.csv", "--odometry", "/odom"], 2, "for logs of ROS 2"),
        (["--drive", "b.csv", "--commands", "/cmd_vel"], 2, "not both"),
        (["--drive", "c.csv", "--seed", "1"], 2, "--seed goes with --on"),
        (["--drive", "/nowhere/c.csv"], 2, "no such file"),
    ],
)
def test_what_makes_no_sense_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: list[str], code: int, said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    done = run(*arguments)
    assert done.exit_code == code
    assert said in done.output


def test_a_recorded_drive_is_identified_from_its_bag(tmp_path: Path) -> None:
    pytest.importorskip("mcap")
    mission = tmp_path / "cart.yaml"
    mission.write_text(
        "robot: {radius_m: 0.3, clearance_m: 0.3, max_speed_mps: 1, max_accel_mps2: 1,\n"
        "        drive: {differential: {track_m: 0.4}, delay_s: 0.1, lag_s: 0.2}}\n"
        "route: {start: [0, 0], via: [{at: [6, 1], dwell_s: 2}, [9, 6], {at: [3, 9], dwell_s: 2},"
        " [-2, 5]], goal: [0, -4]}\n"
    )
    bag = tmp_path / "drive.mcap"
    out = ["--out", str(tmp_path / "out"), "--quiet"]
    assert CliRunner().invoke(cli, ["run", str(mission), "--bag", str(bag), *out]).exit_code == 0
    result = run(bag, "--track", "0.4")
    assert result.exit_code == 0, result.output
    assert "delay_s:" in result.output
    assert not result.stderr
    named = run(bag, "--track", "0.4", "--odometry", "/odom", "--commands", "/cmd_vel")
    assert named.stdout == result.stdout
    other = run(bag, "--odometry", "/wheels")
    assert other.exit_code == 2
    assert "no odometry on /wheels; it has /odom" in other.output
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(bag.read_bytes()[: bag.stat().st_size * 3 // 4])
    short = run(cut, "--track", "0.4")
    assert short.exit_code == 0, short.output
    assert "is cut short" in short.stderr
