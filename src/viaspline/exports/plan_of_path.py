"""A path as QGroundControl's ``.plan``.

Format: https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/plan.html
"""

from __future__ import annotations

from typing import ClassVar

from viaspline.exports.flown_over import flown_over, without
from viaspline.exports.path_format import Carried
from viaspline.exports.path_items import path_itinerary
from viaspline.exports.path_table import PathTable
from viaspline.formats.outgoing import itinerary_of
from viaspline.formats.qgc_plan import plan_text
from viaspline.report.files.json_text import plain


class PlanOfPath:
    """The points of a path as way points, with what is on the map as fences.

    Round what a flight passes over or under there is none: a vehicle would refuse to cross it.

    What is proven, and what of the plan isn't in the file, stands under a key of viaspline's own,
    which others pass over.
    """

    description: ClassVar[str] = "QGroundControl's plan"
    endings: ClassVar[tuple[str, ...]] = (".plan",)
    carries: ClassVar[frozenset[Carried]] = frozenset({"speeds", "dwells", "headings", "fences"})
    is_geographic: ClassVar[bool] = True
    is_cut_at_180: ClassVar[bool] = False
    is_driven: ClassVar[bool] = True
    spacing: ClassVar[float | None] = None

    def write(self, table: PathTable) -> bytes:
        """The file of a path."""
        fenced = without(table.mission, flown_over(table.mission, table.points))
        fences = itinerary_of(fenced, table.origin).fences
        proof = table.proof
        own = {
            "origin": table.origin,
            "heights": table.has_heights,
            "path": {
                "name": table.name,
                "clearance_m": proof.clearance,
                "required_clearance_m": proof.required,
                "chord_error_m": proof.chord_error,
                "acceptance_radius_m": proof.acceptance,
                "not_carried": table.lost,
                "notes": table.notes,
            },
        }
        itinerary = path_itinerary(table, fences)
        return plan_text(itinerary, plain(own), rotors=table.mission.is_spatial).encode()
