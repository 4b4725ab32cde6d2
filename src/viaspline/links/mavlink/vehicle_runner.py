"""The loop around a drive: it reads the clock, moves messages and leaves the vehicle stopped."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Final

from viaspline.errors import LinkError
from viaspline.links.mavlink.conversation import Conversation
from viaspline.links.mavlink.drive_orders import Ended
from viaspline.links.mavlink.preparation import Preparation
from viaspline.links.mavlink.telemetry import Telemetry
from viaspline.links.mavlink.vehicle import Vehicle
from viaspline.links.mavlink.vehicle_drive import LOST_S, VehicleDrive

PERIOD_S: Final = 0.05
"""Between two commands."""

STOPPING_S: Final = 1.5
"""How long a broken-off drive waits for the vehicle to say that it holds."""

_LOOK_S: Final = 0.05

Tell = Callable[[str], object]


def prepared(
    conversation: Conversation, vehicle: Vehicle, patience: float, tell: Tell
) -> Telemetry:
    """What a vehicle says as soon as it is ready to be driven.

    Args:
        conversation: On its link.
        vehicle: It.
        patience: How long it is waited for [s].
        tell: Is told what is lacking, in words.

    Raises:
        LinkError: It isn't ready in that time, or the link breaks.
    """
    preparation, began, told = Preparation(vehicle), conversation.now(), ""
    conversation.forget()
    while True:
        now = conversation.now()
        lacking = preparation.lacking(now)
        if not lacking:
            return preparation.telemetry
        words = "; ".join(lacking)
        if now - began > patience:
            problem = f"{vehicle} isn't ready after {patience:g} s: {words}"
            text = preparation.telemetry.text
            problem += f" (it says “{text}”)" if text else ""
            remedy = "wait for its GPS and its EKF, or look at it with a ground station"
            raise LinkError(conversation.name, problem, remedy)
        if words != told and now - began > 1.0:
            tell(f"waiting: {words} …")
            told = words
        with conversation.breaking():
            preparation, said = preparation.waited(now)
            conversation.say(said)
            for message in conversation.said_by(vehicle, conversation.listen(_LOOK_S)):
                preparation = preparation.heard(message, conversation.now())


class VehicleRunner:
    """Carries out a drive.

    Args:
        conversation: On the vehicle's link.
        drive: At its beginning.
        tell: Is told what happens, in words.
    """

    def __init__(self, conversation: Conversation, drive: VehicleDrive, tell: Tell) -> None:
        self._conversation = conversation
        self.drive = drive
        self._tell = tell

    def run(self) -> Ended:
        """Drive to the end.

        However it ends, by an exception too, the vehicle is told to stop and to hold, unless it
        isn't driven from here any more.

        Raises:
            LinkError: The link broke, for longer than a moment.
        """
        self.drive = self.drive.begun(self._conversation.now())
        try:
            return self._until(lambda: False)
        except BaseException:
            self.drive = self.drive.interrupted(self._conversation.now())
            end = self._conversation.now() + STOPPING_S
            with suppress(OSError, LinkError):
                self._until(lambda: self._conversation.now() > end)
            ended = self.drive.ended
            self._tell("it may not have heard that it is to stop" if ended is None else ended.words)
            raise

    def stop_at_once(self) -> None:
        """Tell the vehicle to stop and to hold, whatever else goes on in this process."""
        _, said = self.drive.interrupted(self._conversation.now()).ticked(self._conversation.now())
        for _ in range(3):
            self._conversation.say(said)

    def _until(self, is_enough: Callable[[], bool]) -> Ended:
        talk = self._conversation
        due, works_at = talk.now(), talk.now()
        while True:
            now = talk.now()
            try:
                if now >= due:
                    due = max(due + PERIOD_S, now + 0.5 * PERIOD_S)
                    self.drive, said = self.drive.ticked(now)
                    for words in self.drive.news:
                        self._tell(words)
                    talk.say(said)
                for message in talk.said_by(self.drive.vehicle, talk.listen(max(due - now, 0.0))):
                    self.drive = self.drive.heard(message, talk.now())
                works_at = now
            except OSError as error:
                if now - works_at > LOST_S or self.drive.phase == "take over":
                    why = (error.strerror or str(error)).lower()
                    remedy = "it has stopped by its own failsafe, if it has one; look at the link"
                    raise LinkError(talk.name, f"the link broke ({why})", remedy) from None
                talk.rest(PERIOD_S)
            ended = self.drive.ended
            if ended is not None:
                return ended
            if is_enough():
                assert self.drive.ending is not None
                return self.drive.ending
