"""Groups as data: bases, samplers, brackets, coordinates, for several n; algebras by their
structure constants: Jacobi, representations, matrices that stand for them."""

from fractions import Fraction
from itertools import combinations
from random import Random

import numpy as np
import pytest
import sympy

from derive.algebra.families import group, so_basis, turning_about_a_point
from derive.algebra.samplers import inner_sampler, one_parameter
from derive.algebra.structure import (
    adjoint,
    brackets_of,
    derivations,
    dual,
    faithful,
    rank,
    require_jacobi,
    require_representation,
    table_of,
)
from derive.algebra.user_groups import group_of_basis
from derive.language import rational as q

FAMILIES = ("SO", "SE", "SL", "SAff", "Sim", "UT", "SU")
NAMES = [f"{f}({n})" for f in FAMILIES for n in (2, 3, 4)] + [
    "SO(5)", "SE(5)", "SL(5)", "GL(2)", "GL(3)", "Aff(2)", "Sp(2)", "Sp(4)", "Sp(6)", "U(1)",
    "U(3)", "SO(3) x SO(3)", "SE(2) x SL(2)", "SO(2) x SE(3) x UT(2)",
]  # fmt: skip
DIMENSIONS = {
    "SO(3)": 3, "SE(3)": 6, "SL(3)": 8, "SO(5)": 10, "SE(4)": 10, "SL(5)": 24, "SAff(3)": 11,
    "Sim(3)": 7, "UT(3)": 3, "Sp(4)": 10, "Sp(6)": 21, "U(3)": 9, "SU(3)": 8, "SO(3) x SO(3)": 6,
}  # fmt: skip
RELATIONS = {
    "SO": {"orthogonal", "unimodular"}, "SE": {"orthogonal", "unimodular"}, "SL": {"unimodular"},
    "SAff": {"unimodular"}, "GL": set(), "Aff": set(), "Sp": {"unimodular"}, "Sim": set(),
    "UT": {"unimodular"}, "U": {"orthogonal", "unimodular"}, "SU": {"orthogonal", "unimodular"},
}  # fmt: skip


@pytest.mark.parametrize("name", NAMES)
def test_basis_is_a_lie_algebra(name):
    g = group(name)
    assert g.dimension == DIMENSIONS.get(name, g.dimension)
    flat = tuple(q.flatten(e) for e in g.basis)
    assert q.rank(flat) == g.dimension
    constants = g.structure_constants
    for a, x in enumerate(g.basis):
        for b, y in enumerate(g.basis):
            assert g.hat(constants[a][b]) == q.bracket(x, y)
    assert len(g.normal_space) == g.size**2 - g.dimension
    for normal in g.normal_space:
        for e in g.basis:
            assert q.trace(q.times(q.transposed(normal), e)) == 0


@pytest.mark.parametrize("name", NAMES)
def test_coordinates(name):
    g, random = group(name), Random(name)
    zeta = tuple(Fraction(random.randint(-9, 9)) for _ in g.basis)
    Z = g.hat(zeta)
    assert g.vee(Z) == zeta
    read = tuple(sum(c * Z[i][j] for c, i, j in g.coordinate_terms(a)) for a in range(g.dimension))
    assert read == zeta
    outside = q.plus(Z, g.normal_space[0]) if g.normal_space else None
    assert outside is None or g.vee(outside) is None


def determinant(m):
    if len(m) == 1:
        return m[0][0]
    return sum(
        (-1) ** j * m[0][j] * determinant([r[:j] + r[j + 1 :] for r in m[1:]])
        for j in range(len(m))
    )


@pytest.mark.parametrize("name", NAMES)
def test_samples_are_in_the_group(name):
    """The relations hold, and the tangent space of the group is the algebra: g E g⁻¹ is in 𝔤."""
    g = group(name)
    seen = set()
    for seed in range(4):
        x = g.sample(Random(seed))
        seen.add(x)
        A = tuple(row[: g.n] for row in x[: g.n])
        if "orthogonal" in g.relations:
            assert q.times(q.transposed(A), A) == q.identity(g.n)
        if "unimodular" in g.relations:
            assert determinant(A) == 1
        if g.affine:
            assert x[-1] == (0,) * g.n + (1,)
        inverse = q.inverse(x)
        for e in g.basis:
            assert g.vee(q.times(q.times(x, e), inverse)) is not None
    assert len(seen) == 4


@pytest.mark.parametrize("name", NAMES)
def test_relations_are_read_off_the_basis(name):
    g = group(name)
    expected = {"orthogonal", "unimodular"}
    for factor in g.factors or (g,):
        found = RELATIONS[factor.name.split("(")[0]]
        expected &= found - {"orthogonal"} if factor.affine and g.factors else found
    assert g.relations == expected


@pytest.mark.parametrize("name", ["Sp(4)", "Sp(6)", "U(2)", "SU(3)"])
def test_samples_keep_the_form_of_the_group(name):
    """ĀΩA = Ω for Sp; A commutes with the complex structure for U and SU."""
    g = group(name)
    n = g.n // 2
    one, zero = q.identity(n), q.scaled(0, q.identity(n))
    top = [(*x, *y) for x, y in zip(zero, one, strict=True)]
    bottom = [(*q.scaled(-1, one)[i], *zero[i]) for i in range(n)]
    omega = (*top, *bottom)
    A = g.sample(Random(name))
    if name.startswith("Sp"):
        assert q.times(q.times(q.transposed(A), omega), A) == omega
    else:
        assert q.times(A, omega) == q.times(omega, A)


def test_places_of_a_product():
    g = group("SE(2) x SL(2)")
    assert [(offset, f.name) for offset, f in g.places] == [(0, "SE(2)"), (3, "SL(2)")]
    assert not g.affine
    assert group("SE(3)").free_translations
    assert not turning_about_a_point().free_translations


def test_so3_basis_is_j():
    g = group("SO(3)")
    x, y = (1, 2, 3), (-4, 5, 7)
    cross = (2 * 7 - 3 * 5, 3 * -4 - 1 * 7, 1 * 5 - 2 * -4)
    assert q.times(g.hat(x), tuple((v,) for v in y)) == tuple((v,) for v in cross)
    assert g.vee(q.bracket(g.hat(x), g.hat(y))) == cross


@pytest.mark.parametrize(
    "name",
    [
        "SO(1)",
        "SO(x)",
        "SO3",
        "",
        "Spin(3)",
        "SL(99)",
        "SO(3) ",
        "Sp(3)",
        "U(5)",
        "SO(3) x",
        "SO(8) x SO(8)",
    ],
)
def test_names(name):
    if name.strip() == "SO(3)":
        assert group(name).name == "SO(3)"
    else:
        with pytest.raises(ValueError, match=r"known|from|at most"):
            group(name)


# -- structure constants ----------------------------------------------------------------------


ONE = Fraction(1)
ALGEBRAS = {  # dimension, rows
    "so(3)": (3, [(1, 2, 3, ONE), (2, 3, 1, ONE), (3, 1, 2, ONE)]),
    "Heisenberg": (3, [(1, 2, 3, ONE)]),
    "Heisenberg in R^5": (5, [(1, 2, 5, ONE), (3, 4, 5, Fraction(2))]),
    "oscillator": (4, [(1, 2, 3, ONE), (4, 1, 2, ONE), (4, 2, 1, -ONE)]),
    "abelian": (4, []),
    "line": (1, []),
    "ax + b": (2, [(1, 2, 2, ONE)]),
    "with a centre": (4, [(1, 2, 3, ONE), (2, 3, 1, ONE), (3, 1, 2, ONE)]),
    "filiform": (5, [(1, 2, 3, ONE), (1, 3, 4, ONE), (1, 4, 5, ONE)]),
}


@pytest.mark.parametrize("name", ALGEBRAS)
def test_matrices_that_stand_for_an_algebra(name):
    """They are independent, and their commutators are the brackets: by NumPy."""
    dimension, rows = ALGEBRAS[name]
    brackets = brackets_of(rows)
    require_jacobi(brackets, dimension)
    E = np.array(faithful(brackets, dimension), float)
    assert np.linalg.matrix_rank(E.reshape(dimension, -1)) == dimension
    table = np.array(table_of(brackets, dimension), float)
    for a, b in combinations(range(dimension), 2):
        assert np.allclose(E[a] @ E[b] - E[b] @ E[a], np.tensordot(table[a, b], E, 1))


@pytest.mark.parametrize("name", ALGEBRAS)
def test_the_adjoint_and_its_dual(name):
    dimension, rows = ALGEBRAS[name]
    brackets = brackets_of(rows)
    for found in (adjoint(brackets, dimension), dual(adjoint(brackets, dimension))):
        require_representation(found, brackets)


@pytest.mark.parametrize("name", ALGEBRAS)
def test_derivations(name):
    """As many as SymPy finds, and each is one."""
    dimension, rows = ALGEBRAS[name]
    brackets = brackets_of(rows)
    c = np.array(table_of(brackets, dimension), float)
    found = derivations(brackets, dimension)
    for D in np.array(found, float).reshape(len(found), dimension, dimension):
        moved = np.einsum("abk,ik->abi", c, D)
        assert np.allclose(moved, np.einsum("ia,ibk->abk", D, c) + np.einsum("ib,aik->abk", D, c))
    d = sympy.Matrix(dimension, dimension, lambda i, j: sympy.Symbol(f"d_{i}_{j}"))
    conditions = [
        sum(int(c[a, b, k] * 2) * d[i, k] for k in range(dimension))
        - sum(
            int(c[j, b, i] * 2) * d[j, a] + int(c[a, j, i] * 2) * d[j, b] for j in range(dimension)
        )
        for a, b in combinations(range(dimension), 2)
        for i in range(dimension)
    ]
    system = sympy.Matrix([[x.coeff(y) for y in d] for x in map(sympy.expand, conditions) if x])
    assert len(found) == dimension**2 - (system.rank() if len(system) else 0)


def test_jacobi_names_the_triple():
    rows = [(1, 2, 3, ONE), (2, 3, 2, ONE), (3, 1, 2, ONE)]
    with pytest.raises(ValueError, match=r"fails for E_1, E_2, E_3: .* is −E_3, not 0"):
        require_jacobi(brackets_of(rows), 3)


def test_an_algebra_that_is_not_seen():
    """Characteristically nilpotent, of dimension 7: no derivation moves the centre."""
    rows = [(1, i, i + 1) for i in range(2, 7)] + [(2, 3, 6), (2, 4, 7), (2, 5, 7)]
    brackets = brackets_of([*((*row, ONE) for row in rows), (3, 4, 7, -ONE)])
    require_jacobi(brackets, 7)
    with pytest.raises(ValueError, match="give it by a basis of matrices"):
        faithful(brackets, 7)


def test_rank_counts_independent_matrices():
    assert rank([((1, 2), (0, 0)), ((2, 4), (0, 0)), ((0, 0), (0, 0)), ((0, 1), (0, 0))]) == 2


# -- elements in a basis of one's own ---------------------------------------------------------


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
