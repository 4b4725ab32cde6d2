"""Reads bags of ROS 2: a folder with ``metadata.yaml`` and MCAP files or SQLite databases.

Tested through ``bags/test_read_drive``.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any, Final

from viaspline.bags.mcap_reader import read_mcap
from viaspline.bags.raw_message import BagExtent, RawMessage, Wanted
from viaspline.bounded_file import is_folder, is_there
from viaspline.errors import BagError
from viaspline.ros_messages.message_types import full_name

SUFFIXES: Final = (".mcap", ".db3")
NO_SUCH_BAG: Final = "there is no such file; give a .mcap, or the folder of a rosbag2"


def read_bag(path: Path, wanted: Wanted, extent: BagExtent) -> Iterator[RawMessage]:
    """The messages of a bag: of an MCAP file, of a database, or of a folder of either.

    Args:
        path: The file or the folder.
        wanted: Which topics are read.
        extent: Is filled in with what else is found.

    Raises:
        BagError: It is none of these, or can't be read.
        OutputError: It needs the extra, which isn't installed.
    """
    if not is_folder(path):
        if not is_there(path):
            raise BagError(path, NO_SUCH_BAG)
        yield from _file(path, wanted, extent)
        return
    files = sorted(one for one in path.iterdir() if one.suffix in SUFFIXES)
    if not files:
        packed = any(one.suffix in (".zstd", ".zst") for one in path.iterdir())
        remedy = "unpack its files: zstd -d *.zstd" if packed else "give the folder of a rosbag2"
        raise BagError(path, f"is a folder without .mcap and .db3; {remedy}")
    for file in files:
        yield from _file(file, wanted, extent)


def _file(path: Path, wanted: Wanted, extent: BagExtent) -> Iterator[RawMessage]:
    if path.suffix == ".db3":
        return _database(path, wanted, extent)
    return read_mcap(path, wanted, extent)


def _database(path: Path, wanted: Wanted, extent: BagExtent) -> Iterator[RawMessage]:
    try:
        uri = f"{path.resolve().as_uri()}?mode=ro"
        with closing(sqlite3.connect(uri, uri=True)) as database:
            yield from _rows(database, wanted, extent)
    except sqlite3.DatabaseError as error:
        if not extent.topics:
            raise BagError(path, f"isn't a rosbag2 database: {error}") from None
        extent.damage = str(error)


def _rows(database: sqlite3.Connection, wanted: Wanted, extent: BagExtent) -> Iterator[RawMessage]:
    definitions = _definitions(database)
    read: dict[int, tuple[str, str, str, str]] = {}
    topics: Any = database.execute("SELECT id, name, type, serialization_format FROM topics")
    for number, name, kind, encoding in topics.fetchall():
        extent.topics[name] = full_name(kind)
        if wanted(name, full_name(kind)):
            read[number] = name, full_name(kind), definitions.get(full_name(kind), ""), encoding
    if not read:
        return
    marks = ", ".join("?" * len(read))
    rows = database.execute(
        f"SELECT topic_id, timestamp, data FROM messages WHERE topic_id IN ({marks}) "
        "ORDER BY timestamp, id",
        tuple(read),
    )
    for number, logged, data in rows:
        extent.ended_at = max(extent.ended_at, logged / 1e9)
        yield RawMessage(*read[number], logged, data)


def _definitions(database: sqlite3.Connection) -> dict[str, str]:
    """The definitions of types, which databases since Iron have."""
    tables = database.execute("SELECT name FROM sqlite_master WHERE type = 'table'").fetchall()
    if ("message_definitions",) not in tables:
        return {}
    rows = database.execute(
        "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions"
    )
    return {full_name(kind): text for kind, encoding, text in rows if encoding == "ros2msg"}
