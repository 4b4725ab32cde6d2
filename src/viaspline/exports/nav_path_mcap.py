"""A path as a ``nav_msgs/Path`` in an MCAP file, as ``ros2 bag play`` reads it.

Needs the package ``mcap``. The message is CDR, little endian, the schema ``ros2msg``.

Tested through ``exports/test_other_readers``.
"""

from __future__ import annotations

import io
import math
import struct
from importlib import import_module
from typing import Any, ClassVar, Final

from viaspline.errors import OutputError
from viaspline.exports.nav_path_yaml import FRAME, stamp
from viaspline.exports.path_format import Carried
from viaspline.exports.path_table import PathTable

TOPIC: Final = "/plan"

_RULE: Final = "=" * 80
SCHEMA: Final = f"""\
std_msgs/Header header
geometry_msgs/PoseStamped[] poses
{_RULE}
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
{_RULE}
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
{_RULE}
MSG: geometry_msgs/PoseStamped
std_msgs/Header header
geometry_msgs/Pose pose
{_RULE}
MSG: geometry_msgs/Pose
geometry_msgs/Point position
geometry_msgs/Quaternion orientation
{_RULE}
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
{_RULE}
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
"""


class NavPathMcap:
    """One message on the topic ``/plan`` at time 0; the poses' stamps are as in the YAML.

    What is proven, and what isn't carried, are metadata of the file.
    """

    description: ClassVar[str] = "nav_msgs/Path in MCAP"
    endings: ClassVar[tuple[str, ...]] = (".mcap",)
    carries: ClassVar[frozenset[Carried]] = frozenset({"times", "headings"})
    is_geographic: ClassVar[bool] = False
    is_driven: ClassVar[bool] = False
    spacing: ClassVar[float | None] = 0.1

    def write(self, table: PathTable) -> bytes:
        """The file of a path.

        Raises:
            OutputError: The package isn't installed.
        """
        writing = _package()
        stream = io.BytesIO()
        writer = writing.Writer(stream, compression=writing.CompressionType.NONE)
        writer.start(profile="ros2", library="viaspline")
        schema = writer.register_schema("nav_msgs/msg/Path", "ros2msg", SCHEMA.encode())
        channel = writer.register_channel(TOPIC, "cdr", schema)
        writer.add_message(channel, log_time=0, data=path_message(table), publish_time=0)
        told = {"name": table.name, "proven": table.proof_words()}
        told |= {f"not carried {k}": words for k, words in enumerate(table.lost, start=1)}
        writer.add_metadata("viaspline", told)
        writer.finish()
        return stream.getvalue()


def path_message(table: PathTable) -> bytes:
    """A path as a ``nav_msgs/Path`` in CDR."""
    data = bytearray(b"\x00\x01\x00\x00")
    _header(data, 0.0)
    _aligned(data, 4)
    data += struct.pack("<I", len(table.points))
    for at, heading, time in zip(
        table.points.tolist(), table.headings.tolist(), table.times.tolist(), strict=True
    ):
        _header(data, time)
        _aligned(data, 8)
        half = 0.5 * heading
        data += struct.pack("<7d", *(*at, 0.0)[:3], 0.0, 0.0, math.sin(half), math.cos(half))
    return bytes(data)


def _header(data: bytearray, time: float) -> None:
    _aligned(data, 4)
    name = FRAME.encode() + b"\x00"
    data += struct.pack("<iII", *stamp(time), len(name)) + name


def _aligned(data: bytearray, size: int) -> None:
    """Fill up to a multiple of a size, counted from behind the four bytes that say the encoding."""
    data += bytes(-(len(data) - 4) % size)


def _package() -> Any:
    try:
        return import_module("mcap.writer")
    except ImportError:
        problem = "MCAP files are written by the package mcap, which isn't installed"
        raise OutputError("MCAP", f"{problem}; pip install 'viaspline[ros]'") from None
