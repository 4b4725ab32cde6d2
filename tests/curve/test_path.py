import numpy as np
import pytest

from viaspline.curve.path import Path, PathVia


def test_via_points_lie_at_their_distances() -> None:
    spans = [
        [[0, 0], [1, 0], [2, 0], [3, 0]],
        [[3, 0], [3, 1], [3, 2], [3, 3]],
    ]
    vias = [
        PathVia("start", (0.0, 0.0), "user", 0.0, index=0),
        PathVia("detour", (3.0, 0.0), "detour", 1.0),
        PathVia("goal", (3.0, 3.0), "user", 2.0, dwell=5.0, index=1),
    ]
    path = Path(spans, vias)
    assert path.vias == tuple(vias)
    np.testing.assert_allclose(path.via_distances, [0, 3, 6])
    for via in path.vias:
        np.testing.assert_allclose(path.evaluate(via.u), via.at)


def test_a_path_without_via_points_has_no_via_distances() -> None:
    assert Path([[[0, 0], [1, 0], [2, 0], [3, 0]]], []).via_distances.shape == (0,)


def test_the_spans_of_a_path_cannot_be_written_to() -> None:
    path = Path([[[0, 0], [1, 0], [2, 0], [3, 0]]], [])
    with pytest.raises(ValueError, match="read-only"):
        path.spans[0, 0, 0] = 5.0
