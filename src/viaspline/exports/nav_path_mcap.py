"""A path as a ``nav_msgs/Path`` in an MCAP file, as ``ros2 bag play`` reads it.

Needs the package ``mcap``. The message is CDR, little endian, the schema ``ros2msg``.

Tested through ``exports/test_other_readers``.
"""

from __future__ import annotations

import io
from importlib import import_module
from typing import Any, ClassVar, Final

from viaspline.errors import OutputError
from viaspline.exports.nav_path_yaml import FRAME
from viaspline.exports.path_format import Carried
from viaspline.exports.path_table import PathTable
from viaspline.report.proven_reference import PROVEN_KEY
from viaspline.ros_messages.message_book import standard_book
from viaspline.ros_messages.pose_message import pose_stamped
from viaspline.ros_messages.stamps import header

TOPIC: Final = "/plan"

MESSAGE: Final = "nav_msgs/msg/Path"


class NavPathMcap:
    """One message on the topic ``/plan`` at time 0; the poses' stamps are as in the YAML.

    What is proven, and what isn't carried, are metadata of the file.
    """

    description: ClassVar[str] = "nav_msgs/Path in MCAP"
    endings: ClassVar[tuple[str, ...]] = (".mcap",)
    carries: ClassVar[frozenset[Carried]] = frozenset({"times", "headings"})
    is_geographic: ClassVar[bool] = False
    is_cut_at_180: ClassVar[bool] = False
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
        book = standard_book()
        schema = writer.register_schema(MESSAGE, "ros2msg", book.schema(MESSAGE).encode())
        channel = writer.register_channel(TOPIC, "cdr", schema)
        rows = zip(
            table.times.tolist(), table.points.tolist(), table.headings.tolist(), strict=True
        )
        poses = [pose_stamped(time, FRAME, at, heading) for time, at, heading in rows]
        data = book.encoded(MESSAGE, {"header": header(0.0, FRAME), "poses": poses})
        writer.add_message(channel, log_time=0, data=data, publish_time=0)
        told = {"name": table.name, "proven": table.proof_words(), **PROVEN_KEY}
        told |= {f"not carried {k}": words for k, words in enumerate(table.lost, start=1)}
        writer.add_metadata("viaspline", told)
        writer.finish()
        return stream.getvalue()


def _package() -> Any:
    try:
        return import_module("mcap.writer")
    except ImportError:
        problem = "MCAP files are written by the package mcap, which isn't installed"
        raise OutputError("MCAP", f"{problem}; pip install 'viaspline[bags]'") from None
