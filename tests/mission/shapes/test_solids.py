import math

from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism, RoundedSegment


def test_a_prism_that_is_given_no_heights_has_no_end_in_height() -> None:
    square = RoundedRing([[(0, 0), (1, 0), (1, 1), (0, 1)]], 0.5)
    assert Prism(square).box == (-0.5, -0.5, -math.inf, 1.5, 1.5, math.inf)


def test_a_line_with_a_radius_lies_in_its_box_whichever_way_it_runs() -> None:
    one, other = (1.0, 5.0, 2.0), (3.0, 4.0, 9.0)
    assert RoundedSegment(one, other, 1.0).box == RoundedSegment(other, one, 1.0).box
    assert RoundedSegment(one, other, 1.0).box == (0.0, 3.0, 1.0, 4.0, 6.0, 10.0)
