"""Elastic quadratic programmes, beside scipy's solvers."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import lsq_linear, minimize
from scipy.sparse import csr_array, vstack

from viaspline.planning.corridor.quadratic_program import Programme, solve


def programme(hessian, gradient, rows, floors, price=1e4, equal=None, values=()):
    size = len(gradient)
    tied = csr_array((0, size)) if equal is None else csr_array(equal)
    return Programme(
        csr_array(hessian), np.array(gradient), csr_array(rows), np.array(floors, float), price,
        tied, np.array(values, float),
    )  # fmt: skip


@pytest.mark.parametrize("seed", range(8))
def test_within_a_box_it_is_scipys_bounded_least_squares(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=(30, 12)), rng.normal(size=30)
    low, high = -rng.uniform(0, 0.1, 12), rng.uniform(0, 0.1, 12)
    found = solve(
        programme(
            a.T @ a,
            -a.T @ b,
            vstack((csr_array(np.eye(12)), csr_array(-np.eye(12)))),
            [*low, *-high],
        ),
        gap=1e-15,
    )
    right = lsq_linear(a, b, (low, high), tol=1e-13).x
    np.testing.assert_allclose(found, right, atol=2e-5)


@pytest.mark.parametrize("seed", range(4))
def test_with_rows_and_equalities_it_is_scipys_slsqp(seed: int) -> None:
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(6, 6))
    hessian, gradient = root.T @ root + np.eye(6), rng.normal(size=6)
    rows, floors = rng.normal(size=(5, 6)), rng.normal(size=5) - 1.0
    equal, values = rng.normal(size=(2, 6)), rng.normal(size=2)
    found = solve(programme(hessian, gradient, rows, floors, equal=equal, values=values), gap=1e-15)
    right = minimize(
        lambda x: 0.5 * x @ hessian @ x + gradient @ x,
        np.zeros(6),
        jac=lambda x: hessian @ x + gradient,
        constraints=[
            {"type": "ineq", "fun": lambda x: rows @ x - floors},
            {"type": "eq", "fun": lambda x: equal @ x - values},
        ],
        method="SLSQP", options={"ftol": 1e-12, "maxiter": 500},
    )  # fmt: skip
    assert right.success
    np.testing.assert_allclose(found, right.x, atol=2e-5)
    np.testing.assert_allclose(equal @ found, values, atol=1e-9)


def test_constraints_that_contradict_each_other_are_broken_as_little_as_possible() -> None:
    # x >= 1, x >= 1 and x <= 0: two against one
    found = solve(programme([[1e-6]], [0.0], [[1.0], [1.0], [-1.0]], [1.0, 1.0, 0.0]))
    assert found[0] == pytest.approx(1.0, abs=1e-5)


def test_what_no_constraint_touches_is_the_free_minimum() -> None:
    found = solve(programme([[2.0, 0.0], [0.0, 4.0]], [-2.0, 4.0], [[1.0, 0.0]], [-50.0]))
    np.testing.assert_allclose(found, [1.0, -1.0], atol=1e-6)
