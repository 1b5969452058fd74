"""Exact elements of groups that have a basis of one's own."""

from fractions import Fraction
from random import Random

import pytest

from derive.algebra.families import group, so_basis
from derive.algebra.samplers import inner_sampler, one_parameter
from derive.algebra.user_groups import group_of_basis
from derive.language import rational as q


def matrix(rows):
    return tuple(tuple(Fraction(x) for x in row) for row in rows)


def sample(*basis):
    return inner_sampler([matrix(e) for e in basis])(Random(1), 50)


def test_rotations():
    g = inner_sampler(so_basis(3))(Random(2), 50)
    assert q.times(g, q.transposed(g)) == q.identity(3)
    assert q.determinant(g) == 1
    assert any(x not in (0, 1, -1) for x in q.flatten(g))


def test_a_turn_with_an_irrational_speed():
    """E = [[0, −2], [1, 0]] keeps x² + 2y²."""
    g = sample([[0, -2], [1, 0]])
    form = matrix([[1, 0], [0, 2]])
    assert q.times(q.transposed(g), q.times(form, g)) == form


def test_a_nut_on_a_screw():
    """The turn and the rise are independent of one another in polynomials."""
    g = sample([[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 0, Fraction(1, 10)], [0, 0, 0, 0]])
    assert (g[0][0] ** 2 + g[1][0] ** 2, g[2][2], g[3]) == (1, 1, (0, 0, 0, 1))
    assert g[2][3] != 0
    assert (g[0][3], g[1][3]) == (0, 0)


def test_eigenvalues_in_a_ratio():
    g = sample([[1, 0], [0, -2]])
    assert (g[0][1], g[1][0], g[0][0] ** 2 * g[1][1]) == (0, 0, 1)


def test_a_jordan_block():
    parts = one_parameter(matrix([[1, 1], [0, 1]]))
    assert parts.nilpotent == matrix([[0, 1], [0, 0]])
    g = sample([[1, 1], [0, 1]])
    assert g[1][0] == 0
    assert g[0][0] == g[1][1]


@pytest.mark.parametrize("e", [[[0, 0, 2], [1, 0, 0], [0, 1, 0]], [[1, -1], [1, 1]]])
def test_other_eigenvalues_are_refused(e):
    assert inner_sampler([matrix(e)]) is None


def test_a_group_has_them():
    screw = group_of_basis("S", "linear", [matrix([[0, -1, 0], [1, 0, 0], [0, 0, 1]])])
    assert screw.larger
    assert screw.has_inner_samples
    g = screw.sample_inside(Random(3))
    assert g[2][2] != 1
    assert q.determinant(g) == g[2][2]
    assert group("SE(3)").sample_inside(Random(4)) == group("SE(3)").sample(Random(4))
    cubic = group_of_basis("C", "linear", [matrix([[0, 0, 2], [1, 0, 0], [0, 1, 0]])])
    assert not cubic.has_inner_samples
    with pytest.raises(ValueError, match="no exact elements"):
        cubic.sample_inside(Random(5))
