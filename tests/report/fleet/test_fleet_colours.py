"""Colours are told apart on white paper, by every common kind of eyes."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.timelines import ActivitySpan, Timeline
from viaspline.mission.fleet.fleet import Fleet
from viaspline.report.fleet.fleet_colours import (
    KIND_COLOURS,
    MAX_HIGHLIGHTED,
    ROBOT_COLOURS,
    FleetColours,
    colours_of,
    fleet_colours,
)

TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
DEUTERANOPIA = np.array(  # Machado, Oliveira and Fernandes 2009, severity 1
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
     [-0.011820, 0.042940, 0.968881]]
)  # fmt: skip


def lab(colour: str, eyes: NDArray[np.float64]) -> NDArray[np.float64]:
    """CIELAB of a colour as some eyes see it."""
    rgb = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    xyz = TO_XYZ @ np.clip(eyes @ linear, 0, 1) / np.array([0.9505, 1.0, 1.089])
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def nearest(colours: tuple[str, ...], eyes: NDArray[np.float64]) -> float:
    seen = [lab(colour, eyes) for colour in colours]
    return min(float(np.linalg.norm(a - b)) for a, b in combinations(seen, 2))


def test_any_two_colours_differ() -> None:
    assert nearest(ROBOT_COLOURS, np.eye(3)) > 25.0


def test_the_first_colours_differ_without_green_as_well() -> None:
    assert nearest(ROBOT_COLOURS[:6], DEUTERANOPIA) > 15.0


def test_no_colour_is_too_pale_for_a_line_on_white_paper() -> None:
    assert max(lab(colour, np.eye(3))[0] for colour in ROBOT_COLOURS) < 75.0


def test_the_pale_colours_of_kinds_are_taken_for_no_robots_own() -> None:
    eyes = np.eye(3)
    apart = [
        float(np.hypot.reduce(lab(one, eyes) - lab(other, eyes)))
        for one in KIND_COLOURS
        for other in ROBOT_COLOURS[:MAX_HIGHLIGHTED]
    ]
    assert min(apart) > 20.0


def fleet_of(count: int) -> Fleet:
    kinds = {"cart": {"radius_m": 0.3}, "lift": {"radius_m": 0.4}}
    return Fleet.model_validate(
        {
            "robots": kinds,
            "fleet": [
                {"name": f"r{i}", "robot": "lift" if i % 3 else "cart",
                 "route": {"start": [5 * i, 0], "goal": [5 * i, 9]}}
                for i in range(count)
            ],
        }
    )  # fmt: skip


def coloured(
    count: int, waits: list[tuple[int, int, float]], pair: tuple[str, str] | None = None
) -> FleetColours:
    names = [f"r{i}" for i in range(count)]
    timelines = [
        Timeline(
            name,
            tuple(
                ActivitySpan(0.0, s, "waits", f"r{j}", s) for i, j, s in waits if f"r{i}" == name
            ),
            0.0,
        )
        for name in names
    ]
    return fleet_colours(
        names, fleet_of(count), timelines, FleetCertificate(1.0, 1.0, pair, 0.0, None)
    )


def test_up_to_twenty_robots_have_a_colour_each() -> None:
    found = coloured(20, [])
    assert found.all_told
    assert len(set(found.of.values())) == 20
    assert not found.kinds


def test_of_a_larger_fleet_the_nearest_two_and_who_waits_longest_have_colours_of_their_own() -> (
    None
):
    found = coloured(40, [(7, 3, 1.0), (9, 2, 8.0)], ("r30", "r31"))
    assert found.told == ("r2", "r3", "r7", "r9", "r30", "r31")
    assert len({found.of[name] for name in found.told}) == 6
    others = {found.of[name] for name in found.of if name not in found.told}
    assert others == set(found.kinds.values()) == set(KIND_COLOURS[:2])
    assert list(found.of) == [f"r{i}" for i in range(40)]


@given(st.lists(st.tuples(st.integers(0, 29), st.integers(0, 35), st.floats(0.1, 9)), max_size=60))
def test_no_more_robots_are_told_apart_than_there_are_colours_for(
    waits: list[tuple[int, int, float]],
) -> None:
    found = coloured(30, waits)
    assert len(found.told) <= MAX_HIGHLIGHTED
    assert len({found.of[name] for name in found.told}) == len(found.told)
    if waits:
        i, j, _ = max(waits, key=lambda one: one[2])
        assert f"r{i}" in found.told
        assert f"r{j}" in found.told or j > 29


def test_one_robot_has_the_first_colour() -> None:
    assert colours_of(0) == []
    assert coloured(1, []).of == {"r0": ROBOT_COLOURS[0]}
