import numpy as np
import pytest
import shapely

import viaspline as vs
from viaspline.fleet.lattice_order.cell_lattice import CellLattice, lattice_over
from viaspline.fleet.lattice_order.no_lattice_order import NoLatticeOrder
from viaspline.world.world import World

ENDS = np.array([[0.5, 0.5], [3.5, 1.5], [2.5, 5.5]])


def over(world, starts=ENDS, goals=ENDS, apart=0.7, kept=0.35):
    lattice = lattice_over(world, starts, goals, apart, kept)
    assert isinstance(lattice, CellLattice)
    return lattice


def test_starts_and_goals_lie_on_cells():
    lattice = over(World(bounds=(0, 0, 6, 6)), goals=ENDS[::-1])
    assert lattice.cell == pytest.approx(1.0)
    assert lattice.places[lattice.starts] == pytest.approx(ENDS)
    assert lattice.places[lattice.goals] == pytest.approx(ENDS[::-1])
    assert len(lattice.places) == 36


def test_cells_and_the_ways_between_them_are_clear_of_the_world():
    pillars = [(1.5, 3.0, 0.3), (4.0, 3.5, 0.2), (4.5, 0.7, 0.6)]
    world = World(
        [vs.Obstacle(circle={"center": (x, y), "radius": r}) for x, y, r in pillars],
        bounds=(0, 0, 6, 6),
    )
    lattice = over(world)
    blocked = shapely.union_all([shapely.Point(x, y).buffer(r, 64) for x, y, r in pillars])
    room = shapely.box(0, 0, 6, 6)

    def is_clear(*places):
        line = shapely.LineString(places) if len(places) > 1 else shapely.Point(*places)
        return line.distance(blocked) >= 0.35 and line.within(room.buffer(-0.35 + 1e-9))

    centres = [(x + 0.5, y + 0.5) for x in range(6) for y in range(6)]
    free = {place for place in centres if is_clear(place)}
    found = {(round(x, 6), round(y, 6)) for x, y in lattice.places.tolist()}
    assert found == free
    for cell, beside in enumerate(lattice.neighbours):
        x, y = lattice.places[cell].round(6)
        near = {(x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)} & free
        expected = {place for place in near if is_clear((x, y), place)}
        assert {tuple(lattice.places[k].round(6)) for k in beside if k >= 0} == expected


def test_places_a_little_beside_the_lattice_count_as_on_it():
    jitter = np.random.default_rng(0).normal(0.0, 0.01, (25, 2))
    starts = 4.0 * np.stack(np.meshgrid(np.arange(5), np.arange(5)), -1).reshape(-1, 2) + jitter
    lattice = over(World(), starts, starts[::-1], apart=1.0)
    assert lattice.cell == pytest.approx(2.0, abs=0.01)
    off = np.hypot(*(lattice.places[lattice.starts] - starts).T)
    assert off.max() < 0.05


def test_places_on_no_lattice_give_none():
    places = np.random.default_rng(1).uniform(0.0, 20.0, (30, 2))
    found = lattice_over(World(), places, places[::-1], 2.0, 1.0)
    assert isinstance(found, NoLatticeOrder)
    assert "no square lattice" in found.reason


def test_a_start_without_room_gives_none():
    world = World([vs.Obstacle(circle={"center": (3.5, 1.9), "radius": 0.3})], bounds=(0, 0, 6, 6))
    found = lattice_over(world, ENDS, ENDS, 0.7, 0.35)
    assert isinstance(found, NoLatticeOrder)
    assert "no cell of its own" in found.reason
