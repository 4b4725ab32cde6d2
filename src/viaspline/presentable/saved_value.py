"""Values that can be written into a folder.

Tested through ``report/notebook/test_saved_results``.
"""

from __future__ import annotations

from pathlib import Path

from viaspline.presentable.upper_doors import opened


class SavedValue:
    """A value with ``save()``."""

    __slots__ = ()

    def save(
        self,
        path: str | Path,
        *,
        name: str | None = None,
        origin: tuple[float, float] | None = None,
    ) -> list[Path]:
        """Write it: into a folder the files of the command line, the same bytes every time.

        A plan goes into a single file as well, by its ending: ``.plan``, ``.waypoints``,
        ``.geojson``, ``.kml``, ``.gpx``, ``.csv``, ``.json``, ``.path.yaml`` or ``.mcap``, proven
        again as it is written: see ``vs.export``, which also says what is proven of it.

        Args:
            path: The folder, which is made if it isn't there; or the file.
            name: What the mission is called in them, as its file is on the command line. None: in
                a folder "mission" or "fleet", in a single file as that is called.
            origin: Latitude and longitude of the mission's 0, 0 [deg], for files that have them.
                None: as ``world.origin_deg`` of the mission says.

        Returns:
            What was written.

        Raises:
            OutputError: It can't be written, or there is nobody who writes such a file.
        """
        written: list[Path] = opened("save")(self, path, name, origin)
        return written
