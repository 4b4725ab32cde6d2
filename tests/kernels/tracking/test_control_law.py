"""The control law: by itself against scipy's integrator, and what it asks of a body."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from viaspline.kernels.tracking.actuators import Actuators
from viaspline.kernels.tracking.control_law import (
    HEADING_ERROR,
    LAST_TIME,
    MEMORY,
    NOTED_ACROSS,
    NOTED_ALONG,
    NOTED_TURN,
    decide,
    turn_law,
)
from viaspline.kernels.tracking.drive_model import DriveModel
from viaspline.kernels.tracking.drive_motion import ACROSS, ALONG, HEADING, STATE, X, Y
from viaspline.kernels.tracking.reference_path import ReferencePath
from viaspline.kernels.tracking.reference_timing import SpeedProfile

INF = math.inf


@pytest.mark.parametrize("aside", [0.2, -1.5, 4.0])
@pytest.mark.parametrize("heading", [0.0, 0.6, -0.6])
def test_it_leads_back_to_a_straight_line_over_a_few_distances(
    aside: float, heading: float
) -> None:
    def slope(_: float, state: np.ndarray) -> list[float]:
        y, angle = state
        return [math.sin(angle), turn_law(0.0, y, angle, 0.8)]

    end = solve_ivp(slope, (0.0, 25.0), [aside, heading], rtol=1e-8).y
    assert np.abs(end[:, -1]).max() < 1e-3
    assert np.abs(end[1]).max() <= 1.6


def test_on_the_path_it_asks_for_the_curvature_of_the_path() -> None:
    assert turn_law(0.7, 0.0, 0.0, 0.3) == pytest.approx(0.7)


def told(
    actuators: Actuators, *, heading: float, aside: float, stands: float | None = None
) -> np.ndarray:
    """What is noted of a robot on its way along the x axis at 1 m/s, by pose.

    Or of one that should stand at its origin, and is so far beyond it.
    """
    model = DriveModel(
        actuators, INF, INF, 2.0, INF, 0.0, 0.0, 1.0, 0.6, 0.3, 1.0, 2.0, 0.05, 0.15, 0.0, 0.0
    )
    along = np.linspace(0.0, 10.0, 41)
    zeros = np.zeros(41)
    reference = ReferencePath(along, along.copy(), zeros, zeros.copy(), zeros.copy())
    profile = SpeedProfile(np.array([0.0, 10.0]), np.ones(2), np.array([0.0, 10.0]), np.zeros(2))
    memory, pose = np.zeros(MEMORY), np.zeros(STATE)
    memory[LAST_TIME] = 0.0
    pose[Y], pose[HEADING] = aside, heading
    pose[ALONG], pose[ACROSS] = math.cos(heading), -math.sin(heading)
    if stands is not None:
        profile = SpeedProfile(np.zeros(2), np.zeros(2), np.array([0.0, 10.0]), np.zeros(2))
        pose[X], pose[ALONG], pose[ACROSS] = stands, 0.0, 0.0
    return decide(model, reference, profile, memory, pose, 0.0, 0.0, 0.05, np.empty((0, 4)))


@pytest.mark.parametrize("held", [0.0, 1.0, -2.5])
def test_a_body_that_keeps_its_heading_is_sent_along_the_path_in_its_own_frame(held: float) -> None:
    note = told(
        Actuators(max_along=2.0, max_across=2.0, held_heading=held), heading=held, aside=0.0
    )
    east = note[NOTED_ALONG] * math.cos(held) - note[NOTED_ACROSS] * math.sin(held)
    north = note[NOTED_ALONG] * math.sin(held) + note[NOTED_ACROSS] * math.cos(held)
    assert (east, north) == pytest.approx((1.0, 0.0), abs=1e-9)
    assert (note[NOTED_TURN], note[HEADING_ERROR]) == (0.0, 0.0)


def test_beside_its_path_it_is_sent_back_without_a_turn() -> None:
    actuators = Actuators(max_along=2.0, max_across=2.0, held_heading=0.0)
    left = told(actuators, heading=0.0, aside=0.3)
    assert left[NOTED_ACROSS] < -0.1
    assert left[NOTED_TURN] == 0.0
    turned = told(actuators, heading=0.2, aside=0.0)
    assert turned[NOTED_TURN] == pytest.approx(-0.4)


def test_a_body_that_looks_where_it_goes_is_never_sent_across() -> None:
    note = told(Actuators(track=0.5), heading=0.2, aside=0.3)
    assert note[NOTED_ACROSS] == 0.0
    assert note[NOTED_TURN] < 0.0


@pytest.mark.parametrize(("short", "goes"), [(0.1, True), (0.35, False), (2.5, False)])
def test_one_that_turns_where_it_should_stand_goes_there_if_it_is_near(
    short: float, goes: bool
) -> None:
    """One that was pushed far beside its path backed into a post as it turned."""
    note = told(Actuators(track=0.5), heading=0.3, aside=0.0, stands=short)
    assert note[NOTED_TURN] < 0.0
    assert (abs(note[NOTED_ALONG]) > 0.05) == goes
