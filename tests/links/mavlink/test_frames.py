"""Every message byte for byte as pymavlink has it, both ways."""

import os
import struct
from dataclasses import fields

import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.links.mavlink.common_messages import MESSAGES, Heartbeat, MissionCount
from viaspline.links.mavlink.frames import FrameReader, frame_of
from viaspline.links.mavlink.message import MavlinkMessage

os.environ["MAVLINK20"] = "1"
from pymavlink.dialects.v10 import ardupilotmega as old_dialect
from pymavlink.dialects.v20 import ardupilotmega as dialect

KINDS = sorted(MESSAGES.values(), key=lambda kind: kind.NUMBER)
NUMBERS = {
    "U8": st.integers(0, 255),
    "U16": st.integers(0, 65535),
    "I16": st.integers(-32768, 32767),
    "U32": st.integers(0, 2**32 - 1),
    "I32": st.integers(-(2**31), 2**31 - 1),
    "U64": st.integers(0, 2**64 - 1),
    "F32": st.floats(width=32, allow_nan=True),
    "Text50": st.binary(max_size=50).map(lambda text: text.ljust(50, b"\0")),
}


def messages(kind: type[MavlinkMessage]) -> st.SearchStrategy[MavlinkMessage]:
    return st.builds(kind, **{one.name: NUMBERS[one.type] for one in fields(kind)})


def peer_of(message: MavlinkMessage) -> dialect.MAVLink_message:
    """The message as pymavlink has it."""
    peer = dialect.mavlink_map[message.NUMBER]
    values = {one.name: getattr(message, one.name) for one in fields(message)}
    return peer(**{name: values[name] for name in peer.fieldnames})


def peer_frame(message: MavlinkMessage, sequence: int) -> bytes:
    link = dialect.MAVLink(None, srcSystem=245, srcComponent=190)
    link.seq = sequence
    return bytes(peer_of(message).pack(link))


def as_bytes(value: object) -> object:
    """Floats by their bytes, so that one NaN is another."""
    return struct.pack("<f", value) if isinstance(value, float) else value


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_a_kind_is_the_one_of_pymavlink(kind: type[MavlinkMessage]) -> None:
    peer = dialect.mavlink_map[kind.NUMBER]
    assert peer.crc_extra == kind.EXTRA
    assert [one.name for one in fields(kind)] == peer.ordered_fieldnames
    assert kind.PACKING.size == peer.unpacker.size
    name = peer.msgname.replace("_", "").lower()
    assert kind.__name__.lower() == name


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
@given(data=st.data(), sequence=st.integers(0, 255))
def test_a_frame_is_byte_for_byte_that_of_pymavlink(
    kind: type[MavlinkMessage], data: st.DataObject, sequence: int
) -> None:
    message = data.draw(messages(kind))
    ours = frame_of(message, system=245, component=190, sequence=sequence)
    assert ours == peer_frame(message, sequence)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
@given(data=st.data())
def test_what_pymavlink_sends_is_read_as_it_was_meant(
    kind: type[MavlinkMessage], data: st.DataObject
) -> None:
    message = data.draw(messages(kind))
    _, (heard,) = FrameReader().fed(peer_frame(message, 7))
    assert (heard.system, heard.component) == (245, 190)
    for one in fields(message):
        mine, theirs = getattr(heard.message, one.name), getattr(message, one.name)
        assert as_bytes(mine) == as_bytes(theirs), one.name


@given(
    counts=st.lists(st.integers(0, 65535), min_size=1, max_size=8),
    cuts=st.lists(st.integers(1, 20), min_size=1, max_size=60),
)
def test_a_stream_may_be_cut_anywhere(counts: list[int], cuts: list[int]) -> None:
    stream = b"".join(
        frame_of(MissionCount(count, 1, 1, 0), system=1, component=1, sequence=k)
        for k, count in enumerate(counts)
    )
    reader, found, at = FrameReader(), [], 0
    while at < len(stream):
        cut = cuts[at % len(cuts)]
        reader, heard = reader.fed(stream[at : at + cut])
        found += [one.message.count for one in heard]
        at += cut
    assert found == counts
    assert reader.rest == b""


@given(junk=st.binary(max_size=60), flip=st.integers(0, 1000))
def test_junk_and_a_broken_frame_are_passed_over(junk: bytes, flip: int) -> None:
    good = frame_of(MissionCount(51, 1, 1, 0), system=1, component=1, sequence=0)
    at = 10 + flip % (len(good) - 10)
    broken = good[:at] + bytes((good[at] ^ 0xFF,)) + good[at + 1 :]
    tail = good * 40  # junk may look like the head of a frame, and swallow what it claims to hold
    _, heard = FrameReader().fed(junk + broken + tail)
    assert heard
    assert all(one.message == MissionCount(51, 1, 1, 0) for one in heard)


def test_a_wrong_checksum_is_counted_and_nothing_is_read() -> None:
    good = frame_of(MissionCount(51, 1, 1, 0), system=1, component=1, sequence=0)
    reader, heard = FrameReader().fed(good[:-1] + bytes((good[-1] ^ 1,)))
    assert not heard
    assert reader.broken == 1


def test_frames_of_version_1_are_read() -> None:
    link = old_dialect.MAVLink(None, srcSystem=3, srcComponent=1)
    frame = bytes(old_dialect.MAVLink_heartbeat_message(10, 3, 129, 15, 4, 3).pack(link))
    assert frame[0] == 0xFE
    _, (heard,) = FrameReader().fed(frame)
    assert heard.message == Heartbeat(15, 10, 3, 129, 4, 3)


def test_signed_frames_are_read() -> None:
    link = dialect.MAVLink(None, srcSystem=3, srcComponent=1)
    link.signing.secret_key = bytes(range(32))
    link.signing.sign_outgoing = True
    frame = bytes(dialect.MAVLink_heartbeat_message(10, 3, 129, 15, 4, 3).pack(link))
    plain = frame_of(MissionCount(1, 1, 1, 0), system=1, component=1, sequence=0)
    _, heard = FrameReader().fed(frame + plain)
    assert [type(one.message) for one in heard] == [Heartbeat, MissionCount]


def test_kinds_that_nobody_needs_here_are_passed_over() -> None:
    link = dialect.MAVLink(None, srcSystem=1, srcComponent=1)
    other = bytes(dialect.MAVLink_vfr_hud_message(1.0, 2.0, 3, 4, 5.0, 6.0).pack(link))
    plain = frame_of(MissionCount(1, 1, 1, 0), system=1, component=1, sequence=0)
    _, heard = FrameReader().fed(other + plain + other)
    assert [one.message for one in heard] == [MissionCount(1, 1, 1, 0)]


def test_a_number_that_does_not_fit_is_an_error() -> None:
    with pytest.raises(struct.error):
        frame_of(MissionCount(70000, 1, 1, 0), system=1, component=1, sequence=0)
