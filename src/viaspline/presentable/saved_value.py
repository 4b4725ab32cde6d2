"""Values that can be written into a folder.

Tested through ``report/notebook/test_saved_results``.
"""

from __future__ import annotations

from pathlib import Path

from viaspline.presentable.upper_doors import opened


class SavedValue:
    """A value with ``save()``."""

    __slots__ = ()

    def save(self, path: str | Path) -> list[Path]:
        """Write it: into a folder the files that the command line writes.

        A plan goes into a single file as well, by its ending: ``.plan``, ``.waypoints``,
        ``.geojson``, ``.kml``, ``.gpx``, ``.csv``, ``.json``, ``.yaml`` or ``.mcap``, proven again
        as it is written.

        Args:
            path: The folder, which is made if it isn't there; or the file.

        Returns:
            What was written.

        Raises:
            OutputError: It can't be written, or there is nobody who writes such a file.
        """
        written: list[Path] = opened("save")(self, path)
        return written
