"""For all tests and all examples in the sources."""

import gc
import os
from collections.abc import Iterator
from types import SimpleNamespace

import pytest

# Before numpy is loaded: threads of its linear algebra wait for each other in loops, on cores that
# other tests have. With two of them a fit of a drive took four times as much of the processor.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    """All that is imported and collected stays: nobody looks through it for garbage meanwhile."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()


KERNELS_APART = ("tests/kernels/space/", "tests/kernels/fleet/", "tests/kernels/turning/")
"""Tests of kernels that have little in common, nor with those that the studio needs for a plan."""


@pytest.hookimpl(trylast=True)  # those that are left out are gone by then
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Where several processes share the tests, each begins with others, and none takes long late.

    At first kernels are compiled, and who needs one that another process compiles has to wait for
    it. In the end the others would have nothing to do while one goes on with what takes long.
    """
    if "PYTEST_XDIST_WORKER" in os.environ:
        items.sort(key=_sooner)
        items[:] = _apart(items, int(os.environ["PYTEST_XDIST_WORKER_COUNT"]))


def _sooner(item: pytest.Item) -> int:
    if item.get_closest_marker("slow"):
        return 0
    return 1 if _is_in_browser(item) else 2


def _apart(items: list[pytest.Item], count: int) -> list[pytest.Item]:
    """Tests so that their equal parts, of which each process gets one, begin with other kernels.

    Processes take over what is last in another one's part, so that each goes through its first.
    """
    first: list[list[pytest.Item]] = [[] for _ in range(count)]
    rest: list[pytest.Item] = []
    for item in items:
        of = [k for k, room in enumerate(KERNELS_APART, 1) if item.nodeid.startswith(room)]
        part = 0 if _is_in_browser(item) else of[0] % count if of else None
        (rest if part is None else first[part]).append(item)
    made: list[pytest.Item] = []
    for k, begun in enumerate(first):
        more = max((len(items) - len(made)) // (count - k) - len(begun), 0)
        made += begun + rest[:more]
        del rest[:more]
    return made + rest


def _is_in_browser(item: pytest.Item) -> bool:
    return "browser" in getattr(item, "fixturenames", ())


@pytest.fixture(scope="session", autouse=True)
def _not_warmed() -> Iterator[None]:
    """Navigators don't drive small missions before their own: ``tests/warming`` has them do it."""
    nothing = SimpleNamespace(warm_up=lambda asked, tell: None)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("viaspline.robot.warmed.import_module", lambda home: nothing)
        yield
