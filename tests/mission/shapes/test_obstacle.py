"""Every kind of obstacle, by what all of them answer."""

from __future__ import annotations

import io
import re
from typing import Any

import pytest
import shapely
from ruamel.yaml import YAML

from viaspline.mission.shapes.obstacle import KINDS, SHAPES, Obstacle
from viaspline.mission.shapes.shape_protocol import Shape


def example(kind: type[Shape]) -> dict[str, Any]:
    """The example of a kind as data, with places for each [x, y]."""
    places = iter(("[0, 0]", "[4, 0]", "[4, 3]"))
    text = re.sub(r"\[x, y\]", lambda _: next(places), kind.EXAMPLE)
    data: dict[str, Any] = YAML(typ="safe").load(io.StringIO(text))
    return data


@pytest.mark.parametrize("key", KINDS)
def test_the_example_of_a_kind_is_one_sound_obstacle_of_it(key: str) -> None:
    obstacle = Obstacle.model_validate(example(KINDS[key]))
    [(given, shape)] = obstacle.shapes()
    assert given == key
    assert isinstance(shape, KINDS[key])
    assert type(shape).faults([((), shape)]) == []
    assert obstacle.ring == shape.ring()


@pytest.mark.parametrize("key", KINDS)
def test_the_outline_of_a_kind_is_an_area(key: str) -> None:
    ring = Obstacle.model_validate(example(KINDS[key])).ring
    assert ring is not None
    outline = ring.outline()
    assert outline.geom_type == "Polygon"
    assert outline.is_valid
    assert outline.area > 0
    assert shapely.box(*ring.box).buffer(1e-9).covers(outline)


def test_an_obstacle_without_a_shape_has_no_ring() -> None:
    assert Obstacle().ring is None
    assert list(Obstacle().shapes()) == []


def test_an_obstacle_of_two_shapes_tells_both() -> None:
    both = example(KINDS["circle"]) | example(KINDS["polygon"])
    assert [key for key, _ in Obstacle.model_validate(both).shapes()] == ["circle", "polygon"]


def test_every_key_of_a_shape_is_a_field() -> None:
    assert set(SHAPES) <= Obstacle.model_fields.keys()
