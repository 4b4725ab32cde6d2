"""For all tests and all examples in the sources."""

from collections.abc import Iterator
from types import SimpleNamespace

import pytest


@pytest.fixture(scope="session", autouse=True)
def _not_warmed() -> Iterator[None]:
    """Navigators don't drive small missions before their own: ``tests/warming`` has them do it."""
    nothing = SimpleNamespace(warm_up=lambda asked, tell: None)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("viaspline.robot.warmed.import_module", lambda home: nothing)
        yield
