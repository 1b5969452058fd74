"""Groups as data: bases, samplers, brackets, coordinates, for several n."""

from fractions import Fraction
from random import Random

import pytest

from derive.algebra import rational as q
from derive.algebra.groups import group

NAMES = [f"{f}({n})" for f in ("SO", "SE", "SL") for n in (2, 3, 4, 5)] + ["GL(2)", "Aff(2)"]
DIMENSIONS = {"SO(3)": 3, "SE(3)": 6, "SL(3)": 8, "SO(5)": 10, "SE(4)": 10, "SL(5)": 24}


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
    read = tuple(sum(c * Z[i][j] for c, i, j in g.reading(a)) for a in range(g.dimension))
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


def test_so3_basis_is_j():
    g = group("SO(3)")
    x, y = (1, 2, 3), (-4, 5, 7)
    cross = (2 * 7 - 3 * 5, 3 * -4 - 1 * 7, 1 * 5 - 2 * -4)
    assert q.times(g.hat(x), tuple((v,) for v in y)) == tuple((v,) for v in cross)
    assert g.vee(q.bracket(g.hat(x), g.hat(y))) == cross


@pytest.mark.parametrize("name", ["SO(1)", "SO(x)", "SO3", "", "SU(2)", "SL(99)", "SO(3) "])
def test_names(name):
    if name.strip() == "SO(3)":
        assert group(name).name == "SO(3)"
    else:
        with pytest.raises(ValueError, match=r"known|from"):
            group(name)
