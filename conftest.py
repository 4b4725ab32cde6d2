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


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Where several processes share the tests, those that take long aren't left to the end.

    The others would have nothing to do by then. Processes take over what is last in another one's
    queue, so that the first one goes through these.
    """
    if "PYTEST_XDIST_WORKER" in os.environ:
        items.sort(key=_sooner)


def _sooner(item: pytest.Item) -> int:
    if item.get_closest_marker("slow"):
        return 0
    return 1 if "browser" in getattr(item, "fixturenames", ()) else 2


@pytest.fixture(scope="session", autouse=True)
def _not_warmed() -> Iterator[None]:
    """Navigators don't drive small missions before their own: ``tests/warming`` has them do it."""
    nothing = SimpleNamespace(warm_up=lambda asked, tell: None)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("viaspline.robot.warmed.import_module", lambda home: nothing)
        yield
