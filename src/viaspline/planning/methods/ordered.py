"""The methods of laying a path, in the order in which they are asked.

A new one is a file beside this one and a line here.
"""

from __future__ import annotations

from dataclasses import replace

from viaspline.kernels.arrays import Floats
from viaspline.planning.methods.at_radii import AtRadii
from viaspline.planning.methods.bent_gently import BentGently
from viaspline.planning.methods.gaps_for_body import GapsForBody
from viaspline.planning.methods.hybrid_astar_search import HybridAStar
from viaspline.planning.methods.joint_headings import JointHeadings
from viaspline.planning.methods.nearby_headings import NearbyHeadings
from viaspline.planning.methods.next_homotopy_classes import NextHomotopyClasses
from viaspline.planning.methods.other_sides import OtherSides
from viaspline.planning.methods.rounder_turns import RounderTurns
from viaspline.planning.methods.spline_as_is import SplineAsItIs
from viaspline.planning.methods.spline_led_round import SplineLedRound
from viaspline.planning.methods.turns_on_shortest import TurnsOnShortest
from viaspline.planning.problem.heights import climbs_upright
from viaspline.planning.problem.method import Method
from viaspline.planning.problem.requirements import Requirements
from viaspline.planning.problem.spline_path import SplinePath
from viaspline.planning.turning.driven_problem import DrivenProblem

PathMethod = Method[DrivenProblem, SplinePath]

SPLINE_METHODS: tuple[PathMethod, ...] = (SplineLedRound(),)
"""For the paper's curve, and for one that climbs nearly upright: turns are flat."""

FEW_HEADINGS = JointHeadings(max_rows=200, max_pushed_rows=30, max_pushed_pairs=16, headings=16)
NEARBY_HEADINGS = NearbyHeadings(
    replace(FEW_HEADINGS, max_rows=60, max_pushed_rows=20, max_pushed_pairs=4)
)

DISC_METHODS: tuple[PathMethod, ...] = (
    SplineAsItIs(),
    BentGently(OtherSides((
        RounderTurns(TurnsOnShortest(), NEARBY_HEADINGS),
        RounderTurns(AtRadii((NEARBY_HEADINGS,)), FEW_HEADINGS),
        AtRadii((FEW_HEADINGS,)),
        SplineLedRound(),
    ), NEARBY_HEADINGS)),
)  # fmt: skip
"""For a disc that can follow any curve; none of them takes long."""

BODY_METHODS: tuple[PathMethod, ...] = (
    SplineAsItIs(),
    BentGently(OtherSides((
        RounderTurns(TurnsOnShortest(), NEARBY_HEADINGS),
        AtRadii((
            NextHomotopyClasses(),
            JointHeadings(settled_within=1.05),
            GapsForBody(),
            HybridAStar(),
        )),
    ), NEARBY_HEADINGS)),
)  # fmt: skip
"""For a robot with a turning circle or a long body."""


def methods_for(requirements: Requirements, places: Floats) -> tuple[PathMethod, ...]:
    """The methods that lay paths for a robot.

    Args:
        requirements: What it has to keep.
        places: Its via points [m], (v, 2) or with heights (v, 3).
    """
    is_disc = requirements.is_free_disc
    if requirements.is_cardinal or (is_disc and climbs_upright(places)):
        return SPLINE_METHODS
    return DISC_METHODS if is_disc else BODY_METHODS


def roomy_methods_for(requirements: Requirements, places: Floats) -> tuple[PathMethod, ...]:
    """The methods that lay paths that keep more than they must: where it is easily done."""
    is_spline = methods_for(requirements, places) is SPLINE_METHODS
    return SPLINE_METHODS if is_spline else DISC_METHODS
