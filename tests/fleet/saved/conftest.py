"""Fleets of every kind, planned and saved once for all tests of what is saved."""

import pytest
from fleets_to_save import ASKED, Saved, unpainted

import viaspline as vs


@pytest.fixture(scope="session")
def saved(tmp_path_factory: pytest.TempPathFactory) -> Saved:
    """By name, the folder and the plan that was saved there."""
    folders = {}
    with unpainted():
        for name, asked in ASKED.items():
            folder = tmp_path_factory.mktemp(name)
            made = vs.plan_fleet(vs.Fleet.model_validate(asked))
            made.save(folder)
            folders[name] = (folder, made)
    return folders
