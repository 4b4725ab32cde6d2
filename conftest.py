"""For all tests and all examples in the sources."""

from types import SimpleNamespace

import pytest


@pytest.fixture(autouse=True)
def _not_warmed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Navigators don't drive small missions before their own: ``tests/warming`` has them do it."""
    nothing = SimpleNamespace(warm_up=lambda asked, tell: None)
    monkeypatch.setattr("viaspline.robot.warmed.import_module", lambda home: nothing)
