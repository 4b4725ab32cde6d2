"""A navigator that is given the same decides the same; what it isn't given is said."""

import math
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from mcap.reader import make_reader
from mcap.writer import Writer

import viaspline as vs
from viaspline.bags.bag_file import BagFile
from viaspline.bags.own_messages import STEP, STEP_TOPIC, TOLD_TOPIC, bag_book
from viaspline.bags.replay import Replayed, differs, replay
from viaspline.errors import BagError
from viaspline.robot.run import Run

Recorded = Callable[[str], tuple[Path, Run]]
BOOK = bag_book()


def rewritten(path: Path, to: Path, change: Callable[[str, int, dict[str, Any]], bool]) -> Path:
    """A bag in which the messages of viaspline's own are changed: left out where it says False."""
    with path.open("rb") as file, to.open("wb") as out:
        reader, writer = make_reader(file), Writer(out)
        writer.start("ros2", "test")
        for one in reader.iter_attachments():
            writer.add_attachment(0, 0, one.name, one.media_type, one.data)
        for note in reader.iter_metadata():
            writer.add_metadata(note.name, note.metadata)
        channels: dict[int, int] = {}
        count = 0
        for schema, channel, message in reader.iter_messages(topics=[STEP_TOPIC, TOLD_TOPIC]):
            assert schema is not None
            if channel.id not in channels:
                number = writer.register_schema(schema.name, schema.encoding, schema.data)
                channels[channel.id] = writer.register_channel(channel.topic, "cdr", number)
            value = BOOK.decoded(schema.name, message.data)
            count += channel.topic == STEP_TOPIC
            if change(channel.topic, count, value):
                data = BOOK.encoded(schema.name, value)
                writer.add_message(channels[channel.id], message.log_time, data, message.log_time)
        writer.finish()
    return to


def outcome(path: Path) -> Replayed | str:
    """What a replay comes to, or why it is refused."""
    try:
        return replay(path)
    except BagError as error:
        return str(error)


@pytest.mark.parametrize("name", ["exact", "lidar", "driven", "moving"])
def test_our_own_logs_are_decided_the_same(recorded: Recorded, name: str) -> None:
    path, run = recorded(name)
    heard: list[int] = []
    done = replay(path, tolerance=0.0, tell=lambda step, time: heard.append(step))
    assert (done.difference, done.damage, done.version) == (None, None, vs.__version__)
    assert heard == list(range(1, done.steps + 1))
    assert done.until == pytest.approx(run.duration, abs=6.0)


@pytest.mark.parametrize(
    "more",
    [
        {"spline": {"tension": "auto"}},
        {
            "route": {
                "start": [0, 0],
                "via": [[8, 3], [9, -4]],
                "goal": [20, 0],
                "order": "shortest",
            }
        },
        {"route": {"start": [0, 0], "via": [[8, 3], [9, -4]], "closed": True, "laps": 4}},
    ],
    ids=["tension", "order", "laps"],
)
def test_what_is_chosen_while_planning_is_chosen_again(
    more: dict[str, Any], tmp_path: Path
) -> None:
    asked = {"route": {"start": [0, 0], "via": [[8, 3], [9, -4]], "goal": [20, 0]}, **more}
    try:
        mission = vs.Mission.model_validate(asked)
    except vs.MissionError as error:
        pytest.fail(str(error))
    plan = vs.plan(mission)
    assert isinstance(plan, vs.Plan)
    with BagFile(tmp_path / "a.mcap").recording(mission, plan) as watch:
        vs.simulate(plan.mission, plan=plan, watch=watch)
    assert replay(tmp_path / "a.mcap", tolerance=0.0).difference is None


def test_the_step_that_is_decided_otherwise_is_named(recorded: Recorded, tmp_path: Path) -> None:
    path, _ = recorded("driven")

    def other_command(topic: str, count: int, value: dict[str, Any]) -> bool:
        if topic == STEP_TOPIC and count == 40:
            value["command"]["speed"] += 1e-6
        return True

    found = replay(rewritten(path, tmp_path / "a.mcap", other_command)).difference
    assert found is not None
    assert (found.step, found.what) == (40, "command.speed")
    assert found.time == pytest.approx(39 * 0.05)
    assert replay(tmp_path / "a.mcap", tolerance=1e-3).difference is None

    def other_input(topic: str, count: int, value: dict[str, Any]) -> bool:
        if topic == STEP_TOPIC and count == 60:
            value["position"] = value["position"] + 0.02
        return True

    found = replay(rewritten(path, tmp_path / "b.mcap", other_input)).difference
    assert found is not None
    assert found.step == 60
    assert found.what.startswith("command.")


def test_a_step_that_is_refused_today_is_a_difference(recorded: Recorded, tmp_path: Path) -> None:
    def backwards(topic: str, count: int, value: dict[str, Any]) -> bool:
        if topic == STEP_TOPIC and count == 30:
            value["time"] = math.nan
        return True

    found = replay(rewritten(recorded("driven")[0], tmp_path / "a.mcap", backwards)).difference
    assert found is not None
    assert found.step == 30
    assert "time" in found.now


def test_obstacles_that_were_never_told_of_are_a_fault_of_the_bag(
    recorded: Recorded, tmp_path: Path
) -> None:
    def silent(topic: str, count: int, value: dict[str, Any]) -> bool:
        return topic != TOLD_TOPIC

    with pytest.raises(BagError, match="makes no sense"):
        replay(rewritten(recorded("exact")[0], tmp_path / "a.mcap", silent))


def test_a_bag_that_is_cut_short_is_driven_as_far_as_it_is_whole(
    recorded: Recorded, tmp_path: Path
) -> None:
    path, _ = recorded("lidar")
    data, cut = path.read_bytes(), tmp_path / "cut.mcap"
    whole = replay(path).steps
    seen: set[str] = set()
    for size in [0, 5, 8, 30, *range(100, len(data), len(data) // 6), len(data) - 1]:
        cut.write_bytes(data[:size])
        done = outcome(cut)
        if isinstance(done, str):
            seen.add("refused")
            assert any(word in done for word in ("is empty", "an MCAP", "damaged before"))
        else:
            seen.add("driven")
            assert done.damage is not None
            assert done.difference is None
            assert done.steps <= whole
    assert seen == {"refused", "driven"}


def test_a_bag_with_a_byte_turned_over_is_never_taken_for_whole(
    recorded: Recorded, tmp_path: Path
) -> None:
    data, spoilt = recorded("exact")[0].read_bytes(), tmp_path / "spoilt.mcap"
    for place in range(len(data) // 3, len(data) // 2, 2001):
        spoilt.write_bytes(data[:place] + bytes([data[place] ^ 0x55]) + data[place + 1 :])
        done = outcome(spoilt)
        assert "damaged" in done if isinstance(done, str) else done.damage is not None


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is empty"),
        (b"#ROSBAG V2.0\n", "ROS 1"),
        (b"SQLite format 3\0 and so on", "folder of the rosbag2"),
        (b"hello, this is no bag at all", "an MCAP file"),
    ],
)
def test_what_is_no_bag_is_refused(content: bytes, words: str, tmp_path: Path) -> None:
    (tmp_path / "a.mcap").write_bytes(content)
    with pytest.raises(BagError, match=words):
        replay(tmp_path / "a.mcap")


def test_a_folder_without_bags_and_a_file_that_is_not_there_are_refused(tmp_path: Path) -> None:
    with pytest.raises(BagError, match="there is no such file"):
        replay(tmp_path / "none.mcap")
    with pytest.raises(BagError, match="a folder without"):
        replay(tmp_path)
    (tmp_path / "a.db3.zstd").write_bytes(b"")
    with pytest.raises(BagError, match="unpack"):
        replay(tmp_path)


def test_the_bag_of_somebody_else_is_refused_and_told_apart_from_an_empty_one(
    tmp_path: Path,
) -> None:
    for name, topics in (("others", ["/odom"]), ("empty", [])):
        with (tmp_path / f"{name}.mcap").open("wb") as out:
            writer = Writer(out)
            writer.start("ros2", "somebody")
            for topic in topics:
                number = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data")
                channel = writer.register_channel(topic, "cdr", number)
                writer.add_message(channel, 0, b"\0\1\0\0\1\0\0\0\0", 0)
            writer.finish()
    with pytest.raises(BagError, match=r"not recorded by viaspline [(]it has /odom"):
        replay(tmp_path / "others.mcap")
    with pytest.raises(BagError, match="it has no topics"):
        replay(tmp_path / "empty.mcap")


def test_steps_without_their_mission_are_refused(recorded: Recorded, tmp_path: Path) -> None:
    with recorded("driven")[0].open("rb") as file, (tmp_path / "a.mcap").open("wb") as out:
        writer = Writer(out)
        writer.start("ros2", "test")
        number = writer.register_schema(STEP, "ros2msg", BOOK.schema(STEP).encode())
        channel = writer.register_channel(STEP_TOPIC, "cdr", number)
        for _, _, message in make_reader(file).iter_messages(topics=[STEP_TOPIC]):
            writer.add_message(channel, 0, message.data, 0)
        writer.finish()
    with pytest.raises(BagError, match=r"lacks mission\.json"):
        replay(tmp_path / "a.mcap")


def test_a_bag_in_a_folder_is_read_as_well(recorded: Recorded, tmp_path: Path) -> None:
    shutil.copy(recorded("exact")[0], tmp_path / "run.mcap")
    assert replay(tmp_path).difference is None


def test_differences_are_found_wherever_they_are() -> None:
    one = {"a": [1.0, {"b": "x"}], "c": True}
    assert differs(one, {"a": [1.0, {"b": "x"}], "c": True}, 0.0) is None
    assert differs(one, {"a": [1.0, {"b": "y"}], "c": True}, 0.0) == ("a[1].b", "'x'", "'y'")
    assert differs(one, {"a": [1.0], "c": True}, 0.0) == ("a", "2 of them", "1 of them")
    assert differs(one, {"a": [1.0, {"b": "x"}], "c": False}, 0.0) == ("c", "True", "False")
