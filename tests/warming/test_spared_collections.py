import gc
from collections.abc import Iterator

import pytest

from viaspline.warming.spared_collections import MANY, spare_collections


@pytest.fixture
def frozen_before() -> Iterator[int]:
    """How many objects are taken out of collections; none of them is afterwards."""
    gc.unfreeze()
    gc.collect()
    gc.freeze()
    yield gc.get_freeze_count()
    gc.unfreeze()


def test_much_that_stays_is_taken_out_of_later_collections(frozen_before: int) -> None:
    much = [[k] for k in range(2 * MANY)]
    gc.collect()
    spare_collections()
    assert gc.get_freeze_count() > frozen_before + MANY
    assert len(gc.get_objects(generation=2)) < MANY
    assert len(much) == 2 * MANY


def test_a_little_is_left_where_it_is(frozen_before: int) -> None:
    few = [[k] for k in range(100)]
    gc.collect()
    spare_collections()
    assert gc.get_freeze_count() <= frozen_before
    assert len(few) == 100


def test_what_went_in_a_circle_before_is_not_kept(frozen_before: int) -> None:
    class Ring:
        here = 0

        def __init__(self) -> None:
            self.itself = self
            Ring.here += 1

        def __del__(self) -> None:
            Ring.here -= 1

    much = [[k] for k in range(2 * MANY)]
    gc.collect()
    Ring()
    spare_collections()
    assert Ring.here == 0
    assert gc.get_freeze_count() > frozen_before
    assert len(much) == 2 * MANY
