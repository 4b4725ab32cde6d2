"""Reads MCAP files from their beginning, as far as they are whole.

Tested through ``bags/test_replay``.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from viaspline.bags.bag_writer import check_mcap
from viaspline.bags.raw_message import BagExtent, RawMessage, Wanted
from viaspline.errors import BagError
from viaspline.ros_messages.message_types import full_name

MAGIC: Final = b"\x89MCAP0\r\n"
OTHERS: Final = (
    (b"#ROSBAG", "is a bag of ROS 1; convert it: rosbags-convert --src … --dst …"),
    (b"SQLite format 3", "is a database; give the folder of the rosbag2 that it belongs to"),
)


def read_mcap(path: Path, wanted: Wanted, extent: BagExtent) -> Iterator[RawMessage]:
    """The messages of a file in their order there.

    A file that is cut short or damaged is read up to there; ``extent.damage`` says why.

    Args:
        path: The file.
        wanted: Which topics are read.
        extent: Is filled in with what else is found.

    Raises:
        BagError: The file isn't MCAP, or can't be read.
        OutputError: The extra isn't installed.
    """
    check_mcap(path)
    check_magic(path)
    with path.open("rb") as file:
        yield from _messages(file, wanted, extent)


def check_magic(path: Path) -> None:
    """Refuse what isn't MCAP, by its first bytes.

    Raises:
        BagError: It isn't, or it can't be read.
    """
    try:
        with path.open("rb") as file:
            start = file.read(16)
    except OSError as error:
        raise BagError(path, f"can't be read: {(error.strerror or str(error)).lower()}") from None
    if not start:
        raise BagError(path, "is empty; nothing was recorded in it")
    for magic, words in OTHERS:
        if start.startswith(magic):
            raise BagError(path, words)
    if not start.startswith(MAGIC):
        raise BagError(path, "isn't an MCAP file; give a .mcap, or the folder of a rosbag2")


def _messages(file: Any, wanted: Wanted, extent: BagExtent) -> Iterator[RawMessage]:
    from mcap.records import Attachment, Channel, Footer, Message, Metadata, Schema
    from mcap.stream_reader import StreamReader

    schemas: dict[int, Schema] = {}
    channels: dict[int, Channel] = {}
    read: dict[int, tuple[str, str, str, str]] = {}
    records = iter(StreamReader(file, validate_crcs=True).records)
    whole = False
    while True:
        try:
            record = next(records)
        except StopIteration:
            break
        except Exception as error:  # any that mcap and its decompressors know: it is damaged here
            extent.damage = str(error) or type(error).__name__
            return
        if isinstance(record, Message):
            extent.ended_at = max(extent.ended_at, record.log_time / 1e9)
            about = read.get(record.channel_id)
            if about is not None:
                yield RawMessage(*about, record.log_time, record.data)
        elif isinstance(record, Schema):
            schemas[record.id] = record
        elif isinstance(record, Channel) and record.id not in channels:
            channels[record.id] = record
            schema = schemas.get(record.schema_id)
            if schema is None:
                continue
            kind = full_name(schema.name)
            extent.topics[record.topic] = kind
            if wanted(record.topic, kind):
                text = schema.data.decode("utf-8", "replace")
                definition = text if schema.encoding == "ros2msg" else ""
                read[record.id] = record.topic, kind, definition, record.message_encoding
        elif isinstance(record, Attachment):
            extent.attachments[record.name] = record.data
        elif isinstance(record, Metadata):
            extent.notes[record.name] = record.metadata
        elif isinstance(record, Footer):
            whole = True
    if not whole:
        extent.damage = "it has no end"
