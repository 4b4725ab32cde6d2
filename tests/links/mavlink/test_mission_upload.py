"""The upload as a value: messages and time in, messages out."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from viaspline.links.mavlink.common_messages import (
    MissionAck,
    MissionClearAll,
    MissionCount,
    MissionItemInt,
    MissionRequest,
    MissionRequestInt,
)
from viaspline.links.mavlink.exchange import RETRIES, TIMEOUT_S, Failure
from viaspline.links.mavlink.mission_upload import MissionUpload
from viaspline.links.mavlink.vehicle import Vehicle

VEHICLE = Vehicle(1, 1, 3, 10)
ITEM = MissionItemInt(0.0, 0.0, 0.0, 0.0, 471000000, 82000000, 5.0, 0, 16, 1, 1, 3, 0, 1, 0)
ITEMS = tuple(replace(ITEM, seq=k) for k in range(3))


def test_it_begins_with_the_count_and_gives_what_is_asked_for() -> None:
    upload, said = MissionUpload(VEHICLE, 0, ITEMS).begun(0.0)
    assert said == (MissionCount(3, 1, 1, 0),)
    for ask in (MissionRequestInt, MissionRequest):  # the old request is answered in the new way
        _, said = upload.heard(ask(2, 245, 190, 0), 0.1)
        assert said == (ITEMS[2],)


def test_it_is_done_only_after_the_last_item() -> None:
    upload, _ = MissionUpload(VEHICLE, 0, ITEMS).begun(0.0)
    upload, _ = upload.heard(MissionAck(245, 190, 0, 0), 0.1)
    assert not upload.is_over
    for k in range(3):
        upload, _ = upload.heard(MissionRequestInt(k, 245, 190, 0), 0.1)
    assert not upload.is_over
    upload, _ = upload.heard(MissionAck(245, 190, 0, 0), 0.2)
    assert upload.is_done


def test_other_lists_and_items_that_are_not_there_are_none_of_its_business() -> None:
    upload, _ = MissionUpload(VEHICLE, 0, ITEMS).begun(0.0)
    for message in (
        MissionRequestInt(0, 245, 190, 1), MissionRequestInt(3, 245, 190, 0),
        MissionAck(245, 190, 4, 2), MissionAck(245, 190, 13, 0),
    ):  # fmt: skip
        after, said = upload.heard(message, 0.1)
        assert (after, said) == (upload, ())


def test_silence_is_answered_by_saying_it_again_and_then_given_up() -> None:
    upload, first = MissionUpload(VEHICLE, 0, ITEMS).begun(0.0)
    now = 0.0
    for _ in range(RETRIES):
        upload, said = upload.waited(now + 0.9 * TIMEOUT_S)
        assert said == ()
        now += TIMEOUT_S
        upload, said = upload.waited(now)
        assert said == first
    upload, said = upload.waited(now + TIMEOUT_S)
    assert upload.failure == Failure(None, None)
    assert said == ()


def test_no_items_are_a_list_that_is_cleared() -> None:
    upload, said = MissionUpload(VEHICLE, 1, ()).begun(0.0)
    assert said == (MissionClearAll(1, 1, 1),)
    upload, _ = upload.heard(MissionAck(245, 190, 0, 1), 0.1)
    assert upload.is_done


@given(
    steps=st.lists(
        st.one_of(
            st.builds(MissionRequestInt, st.integers(0, 5), st.just(245), st.just(190), st.just(0)),
            st.builds(
                MissionAck, st.just(245), st.just(190), st.integers(0, 16), st.integers(0, 2)
            ),
            st.just(None),
        ),
        max_size=40,
    )
)
def test_whatever_comes_it_says_only_its_items_and_ends_once(
    steps: list[MissionRequestInt | MissionAck | None],
) -> None:
    upload, _ = MissionUpload(VEHICLE, 0, ITEMS).begun(0.0)
    for k, message in enumerate(steps):
        was_over = upload.is_over
        after, said = (
            upload.waited(float(k)) if message is None else upload.heard(message, float(k))
        )
        assert set(said) <= {*ITEMS, MissionCount(3, 1, 1, 0)}
        assert not (was_over and (said or after != upload))
        assert not (after.is_done and after.failure)
        upload = after
