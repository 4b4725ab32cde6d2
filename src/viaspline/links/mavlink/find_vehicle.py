"""Who is there: the vehicles of a link by their heartbeats, and which of them is meant.

Tested through ``links/mavlink/test_upload_mission``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from viaspline.errors import LinkError
from viaspline.links.mavlink.common_messages import Heartbeat
from viaspline.links.mavlink.frames import Heard
from viaspline.links.mavlink.mav_words import GROUND_STATION, NO_AUTOPILOT
from viaspline.links.mavlink.vehicle import Vehicle

LISTEN_S: Final = 2.5
"""So long others are listened for after the first heartbeat: each comes once a second."""


@dataclass(frozen=True)
class VehicleSearch:
    """Who has been heard so far.

    Attributes:
        wanted: The system that is meant; None: the only one.
        vehicles: By their systems.
        beats: The last heartbeat of each.
        first_at: When the first one was heard [s]; None before that.
    """

    wanted: int | None
    vehicles: Mapping[int, Vehicle] = field(default_factory=dict)
    beats: Mapping[int, Heartbeat] = field(default_factory=dict)
    first_at: float | None = None

    def heard(self, heard: Heard, now: float) -> VehicleSearch:
        """Take a message: only heartbeats of autopilots count."""
        beat = heard.message
        if not isinstance(beat, Heartbeat) or beat.autopilot == NO_AUTOPILOT:
            return self
        known = self.vehicles.get(heard.system)
        if beat.type == GROUND_STATION or (known and known.component != heard.component):
            return self
        vehicle = Vehicle.of(heard.system, heard.component, beat)
        return VehicleSearch(
            self.wanted, {**self.vehicles, heard.system: vehicle},
            {**self.beats, heard.system: beat}, now if self.first_at is None else self.first_at,
        )  # fmt: skip

    def found(self, link: object, now: float) -> tuple[Vehicle, Heartbeat] | None:
        """The vehicle that is meant, and its last heartbeat; None while that can't be said.

        Args:
            link: How the link is called in messages.
            now: [s].

        Raises:
            LinkError: There is more than one and nobody says which is meant.
        """
        if self.wanted is not None:
            return self._met(self.wanted) if self.wanted in self.vehicles else None
        if self.first_at is None or now - self.first_at < LISTEN_S:
            return None
        if len(self.vehicles) > 1:
            names = ", ".join(str(self.vehicles[system]) for system in sorted(self.vehicles))
            problem = f"{len(self.vehicles)} autopilots are on this link: {names}"
            raise LinkError(link, problem, "say which with --system")
        return self._met(next(iter(self.vehicles)))

    def nobody(self, link: object, waited: float) -> LinkError:
        """Why nobody was found, in words.

        Args:
            link: How the link is called in messages.
            waited: For how long it was listened [s].
        """
        if self.vehicles and self.wanted is not None:
            names = ", ".join(str(self.vehicles[system]) for system in sorted(self.vehicles))
            problem = f"no system {self.wanted} in {waited:g} s, only {names}"
            return LinkError(link, problem, "give one of these to --system")
        remedy = "is it powered, is this its link (and its baud rate), and does it send MAVLink?"
        return LinkError(link, f"no autopilot was heard in {waited:g} s", remedy)

    def _met(self, system: int) -> tuple[Vehicle, Heartbeat]:
        return self.vehicles[system], self.beats[system]
