"""The explicit methods have their orders: every condition of every rooted tree, in 40 digits."""

from __future__ import annotations

from collections.abc import Iterator
from decimal import Decimal, localcontext

import pytest

from derive.code.step.tableaux import Tableau, rk4, vern9
from tests.oracles.rooted_trees import Weights, trees

SMALL, CLEAR = Decimal(10) ** -40, Decimal(10) ** -9
"""What rounding may leave of a condition that holds, and the least of one that does not."""

METHODS = {"rk4": rk4(), "vern9": vern9()}


@pytest.fixture(autouse=True)
def digits() -> Iterator[None]:
    """The tableaux have 60 digits, whatever the context is in which they are asked for first."""
    with localcontext() as context:
        context.prec = 70
        yield


@pytest.fixture(params=METHODS)
def method(request: pytest.FixtureRequest) -> Tableau:
    """Each method."""
    return METHODS[request.param]


def test_the_trees_are_all_there() -> None:
    """Their numbers are those of Cayley (OEIS A000081)."""
    assert [len(trees(n)) for n in range(1, 11)] == [1, 1, 2, 4, 9, 20, 48, 115, 286, 719]


def test_a_row_sums_to_its_node(method: Tableau) -> None:
    """c_i = Σ_j a_ij, so that time may be a number of the state."""
    for c, row in zip(method.c, method.a, strict=True):
        assert abs(c - sum(row, Decimal(0))) < SMALL


def test_the_method_has_its_order_and_no_higher(method: Tableau) -> None:
    """b, and b̂ where there is one."""
    weights = Weights(method.a)
    for b, order in ((method.b, method.order), (method.embedded, method.embedded_order)):
        for n in range(1, order + 1):
            assert weights.defect(b, n) < SMALL, n
        assert not b or weights.defect(b, order + 1) > CLEAR


@pytest.mark.parametrize("theta", ["0.1", "0.5", "0.77", "1", "1.25"])
def test_the_polynomial_has_its_order_and_no_higher(method: Tableau, theta: str) -> None:
    """b(θ), at times within the step and one after it."""
    weights, x = Weights(method.a), Decimal(theta)
    b = [sum((d * x ** (k + 1) for k, d in enumerate(row)), Decimal(0)) for row in method.dense]
    for n in range(1, method.dense_order + 1):
        assert weights.defect(b, n, x) < SMALL, n
    if x != 1:
        assert weights.defect(b, method.dense_order + 1, x) > CLEAR / 100


def test_the_polynomial_ends_where_the_step_does(method: Tableau) -> None:
    """b_i(1) = b_i, so that the trajectory is continuous."""
    for i, row in enumerate(method.dense):
        b = method.b[i] if i < method.stages else Decimal(0)
        assert abs(sum(row, Decimal(0)) - b) < SMALL


def test_the_conditions_see_a_wrong_digit() -> None:
    """One number of one row off by 1e-30."""
    method = vern9()
    rows = [list(row) for row in method.a]
    rows[13][8] += Decimal(10) ** -30
    assert max(Weights(rows).defect(method.b, n) for n in range(1, 10)) > SMALL


def test_the_pair_is_verner_s() -> None:
    """Some of the numbers that he published, in 40 digits."""
    method, close = vern9(), Decimal(10) ** -39
    published = {
        "0.6590650618730998549405331618649220295334": method.c[11],
        "0.7404185470631561083004100761798676215811": method.c[17],
        "-0.3915211862331339089410228267288242030810": method.b[7],
        "-13.93734253810777678786523664804936051203": method.a[14][5],
        "0.04834231373823958314376726739772871714902": -method.error[15],
        "0.09517712399458336651642257453589397190702": method.a[20][7],
    }
    for text, found in published.items():
        assert abs(Decimal(text) - found) < close * max(1, abs(found)) * 10, text
