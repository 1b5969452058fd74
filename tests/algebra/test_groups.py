"""Groups as data: bases, samplers, brackets, coordinates, for several n."""

from fractions import Fraction
from random import Random

import pytest

from derive.algebra.families import group, turning_about_a_point
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
