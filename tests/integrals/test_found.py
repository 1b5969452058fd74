"""The integrals that are found: the classical cases of the heavy top, Manakov's, and none more;
along motions of the emitted code, and beside SymPy's own brute force."""

import numpy as np
import pytest
import sympy
from scipy.integrate import solve_ivp

from derive import SO, Lagrangian, Problem, ProblemError, derive, first_integrals
from derive.pipeline import walk
from tests.support.lagrangians import LADDER, heavy, heisenberg, lagrangian, manakov, squares
from tests.support.library import module_of
from tests.support.walks import problem, repeated

PI = sympy.symbols("Pi_1:4", real=True)
GAMMA = sympy.symbols("A_31 A_32 A_33", real=True)


def real(names):
    return sympy.symbols(names, real=True)


def spanned(f, others):
    """Is a polynomial a combination of others, its coefficients functions of the parameters?"""
    x = (*PI, *GAMMA)
    columns = [sympy.Poly(y, *x).as_dict() for y in (*others, f)]
    monomials = sorted({e for c in columns for e in c})
    rows = sympy.Matrix([[c.get(e, 0) for c in columns] for e in monomials])
    return sympy.simplify(rows).rank() == len(others)


def test_euler():
    found = first_integrals("euler_top")
    assert [x.sympy() for x in found.casimirs] == [sum(x**2 for x in PI)]
    I1, I2, I3 = real("I1 I2 I3")
    assert found.energy.sympy() - PI[0] ** 2 / I1 / 2 - PI[1] ** 2 / I2 / 2 == PI[2] ** 2 / I3 / 2
    assert len(found.integrals) == 1
    assert found.integrable


def test_lagrange():
    found = first_integrals("lagrange_top")
    assert [x.sympy() for x in found.integrals[1:]] == [PI[2]]
    assert found.integrable
    assert found.rank == 4


def test_kovalevskaya():
    """|(ω₁ + iω₂)² − νγ|², γ = γ₁ + iγ₂, of a solid with moments 2, 2, 1."""
    found = first_integrals("kovalevskaya_top")
    assert found.integrable
    _, fourth = found.integrals
    moment, mgl = real("I mgl")
    p, q = (x / (2 * moment) for x in PI[:2])
    nu = mgl / moment
    published = (p**2 - q**2 - nu * GAMMA[0]) ** 2 + (2 * p * q - nu * GAMMA[1]) ** 2
    products = [found.energy.sympy() ** 2, *(c.sympy() for c in found.casimirs)]
    assert spanned(fourth.sympy(), [published, *products])
    assert not spanned(fourth.sympy(), products)


def test_kovalevskaya_is_not_of_degree_three():
    found = first_integrals("kovalevskaya_top", 3)
    assert len(found.integrals) == 1
    assert not found.integrable


def test_goryachev_and_chaplygin():
    """On the level ⟨Π, Γ⟩ = 0 alone: r(p² + q²) − νpγ₃ for moments 4, 4, 1."""
    found = first_integrals(heavy(("4*I", "4*I", "I"), "m*A_31", "I m"))
    assert len(found.integrals) == 1
    assert not found.integrable
    ((k, (third,)),) = found.levels.items()
    assert found.casimirs[k].sympy() == sum(x * y for x, y in zip(PI, GAMMA, strict=True))
    (level,) = found.found.levels
    assert level.proved.complete
    moment, m = real("I m")
    p, q, r = PI[0] / (4 * moment), PI[1] / (4 * moment), PI[2] / moment
    published = r * (p**2 + q**2) - m / moment * p * GAMMA[2]
    assert sympy.expand(third.sympy() - 16 * moment**3 * published) == 0


def test_what_is_in_involution_on_a_level_commutes_there():
    """Beside Goryachev and Chaplygin's top a ball, whose momenta do not; by cross products."""
    L = "4*zeta_1^2 + 4*zeta_2^2 + zeta_3^2 + zeta_4^2 + zeta_5^2 + zeta_6^2"
    found = first_integrals(lagrangian(f"({L})/2 - A1_31", "SO(3) x SO(3)"), 3)
    top, ball, gamma = (sympy.Matrix(found.x[k : k + 3]) for k in (0, 3, 6))
    (level,), ((third,),) = found.found.levels, found.levels.values()
    functions = [*(x.sympy() for x in found.integrals), third.sympy()]
    on = dict(zip(found.x, (1, 2, 3, 5, -2, 7, 3, 3, -3), strict=True))
    assert top.dot(gamma).subs(on) == 0

    def bracket(f, g):
        a, b, c = (sympy.Matrix([f.diff(v) for v in x]) for x in (top, ball, gamma))
        d, e, h = (sympy.Matrix([g.diff(v) for v in x]) for x in (top, ball, gamma))
        return top.dot(a.cross(d)) + ball.dot(b.cross(e)) + gamma.dot(a.cross(h) + c.cross(d))

    chosen = [functions[k] for k in level.proved.involution]
    assert len(chosen) == level.proved.rank // 2 == 3
    assert all(bracket(f, g).subs(on) == 0 for f in chosen for g in chosen)
    assert bracket(functions[1], functions[2]).subs(on) != 0


def test_clebsch():
    """U = ½⟨Γ, IΓ⟩: a second quadratic integral."""
    moments, parameters = ("I1", "I2", "I3"), "I1 I2 I3 k"
    U = "k*(I1*A_31^2 + I2*A_32^2 + I3*A_33^2)/2"
    found = first_integrals(heavy(moments, U, parameters), 2)
    assert found.integrable
    I1, I2, I3, k = real("I1 I2 I3 k")
    published = sum(x**2 for x in PI) / 2 - k / 2 * (
        I2 * I3 * GAMMA[0] ** 2 + I3 * I1 * GAMMA[1] ** 2 + I1 * I2 * GAMMA[2] ** 2
    )
    products = [found.energy.sympy(), *(c.sympy() for c in found.casimirs)]
    assert spanned(found.integrals[1].sympy(), [published, *products])


@pytest.mark.parametrize(("degree", "moments"), [(6, "I1 I2 I3"), (6, "I1 I1 I3")])
def test_a_heavy_top_has_none_more(degree, moments):
    parameters = " ".join({**dict.fromkeys(moments.split()), "a": 0, "c": 0})
    found = first_integrals(heavy(moments.split(), "a*A_31 + c*A_33", parameters), degree)
    assert len(found.integrals) == 1
    assert not found.levels
    assert not found.integrable
    assert "is a polynomial in it and the Casimirs" in str(found)
    assert "completely integrable" not in str(found)


def test_a_gyrostat():
    """Zhukovsky's, without weight, is integrable; with weight and all moments distinct it has none
    more; with weight on its axis it has Lagrange's."""
    L = "(I1*zeta_1^2 + I2*zeta_2^2 + I3*zeta_3^2)/2 + h1*zeta_1 + h2*zeta_2 + h3*zeta_3"
    assert first_integrals(lagrangian(L, parameters="I1 I2 I3 h1 h2 h3")).integrable
    assert len(first_integrals("gyrostat").integrals) == 1
    L = "(I1*(zeta_1^2 + zeta_2^2) + I3*zeta_3^2)/2 + h*zeta_3 - m*A_33"
    found = first_integrals(lagrangian(L, parameters="I1 I3 h m"))
    assert [x.sympy() for x in found.integrals[1:]] == [PI[2]]
    assert found.integrable


def test_manakov_of_four_dimensions():
    found = first_integrals("manakov", 2)
    assert found.integrable
    assert (len(found.casimirs), len(found.integrals), found.rank) == (2, 2, 4)


def test_manakov_of_five_dimensions():
    """Two Casimirs, and four integrals in involution, one of them of degree 4."""
    found = first_integrals(manakov((1, 2, 5, 7, 11), (3, 7, 20, 33, 41)))
    degrees = [sympy.Poly(x.sympy(), *found.x).total_degree() for x in found.integrals]
    assert degrees == [2, 2, 2, 4]
    assert found.rank == 8
    assert found.integrable
    short = first_integrals(manakov((1, 2, 5, 7, 11), (3, 7, 20, 33, 41)), 3)
    assert not short.integrable


def test_another_metric_of_four_dimensions():
    """No metric (b_i − b_j)/(a_i − a_j): none more up to degree 4."""
    L = " + ".join(f"{x}*zeta_{a}^2" for a, x in enumerate((3, 5, 7, 11, 13, 17), 1))
    found = first_integrals(lagrangian(L, "SO(4)"))
    assert len(found.integrals) == 1
    assert not found.integrable


def test_a_ball():
    """All momenta are kept, and not all in involution; with the field of weight they are not."""
    found = first_integrals(lagrangian("zeta_1^2 + zeta_2^2 + zeta_3^2"))
    assert {x.sympy() for x in found.integrals[1:]} == {*PI}
    assert found.integrable
    assert found.found.proved.involution in ((1,), (2,), (3,))


def test_the_other_side():
    """On the right the columns of g move: the first column in place of the third row."""
    L = "(I1*(zeta_1^2 + zeta_2^2) + I3*zeta_3^2)/2 - m*A_33"
    found = first_integrals(lagrangian(L, parameters="I1 I3 m", side="right"))
    assert [str(x) for x in found.x[3:]] == ["A_13", "A_23", "A_33"]
    assert [x.sympy() for x in found.integrals[1:]] == [PI[2]]


def test_an_affine_group():
    """A disc in the plane that falls: T_2 moves with A_21 and A_22; the heights are kept from the
    left, and from the right the momentum across."""
    L = "(zeta_1^2 + zeta_2^2 + zeta_3^2)/2 - g*T_2"
    left = first_integrals(lagrangian(L, "SE(2)", "g"), 2)
    assert [str(x) for x in left.x[3:]] == ["A_21", "A_22", "A_23"]
    right = first_integrals(lagrangian(L, "SE(2)", "g", side="right"), 2)
    assert all(v.holds for x in (left, right) for v in x.check(1))


def test_a_product_of_groups():
    """Two free solids: two Casimirs, and the energy of each."""
    L = "(zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2 + zeta_4^2 + 3*zeta_5^2 + 4*zeta_6^2)/2"
    found = first_integrals(lagrangian(L, "SO(3) x SO(3)"), 2)
    assert (len(found.casimirs), len(found.integrals)) == (2, 2)
    assert found.integrable


def test_entries_that_no_element_varies_are_no_variables():
    """In a magnetic field Π₂ along the centre of Heisenberg's group, by springs."""
    found = first_integrals(heisenberg())
    assert [str(x) for x in found.x] == ["Pi_1", "Pi_2", "Pi_3", "A_12", "A_23"]
    p, field, q, x, y = found.x
    second = p**2 + x**2 + field**2 * (x**2 + 2 * y**2) + 4 * field * p * y - 2 * field * q * x
    with_others = second - 2 * field**2 * found.energy.sympy() + field**4
    assert sympy.expand(found.integrals[1].sympy() + with_others) == 0
    assert [c.sympy() for c in found.casimirs] == [field]
    assert found.integrable
    scaled = first_integrals(
        lagrangian("zeta_1^2 + zeta_2^2 + zeta_3^2 - A_13^2", LADDER, side="right")
    )
    assert [str(x) for x in scaled.x[3:]] == ["A_13"]
    nut = first_integrals("screw")
    assert [str(x) for x in nut.x] == ["Pi_1", "A_34"]
    assert all(v.holds for x in (found, scaled, nut) for v in x.check(1))


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_rank_of_the_poisson_tensor(side):
    """On se(3)* the Casimirs are |p|² and ⟨ℓ, p⟩; on so(5)*, of dimension 10, there are two, of
    degrees 2 and 4: beside one of them the rank, which is even, is at most 8, too."""
    none, found = (
        first_integrals(lagrangian(squares(3, 5, 11, 13, 19, 29), "SE(3)", side=side), n)
        for n in (1, 2)
    )
    assert (len(none.casimirs), none.rank, none.found.proved.proved) == (0, 4, False)
    assert (len(found.casimirs), found.rank, found.found.proved.proved) == (2, 4, True)
    short, whole = (
        first_integrals(lagrangian(squares(*range(2, 12)), "SO(5)", side=side), n) for n in (3, 4)
    )
    assert (len(short.casimirs), short.rank, short.found.proved.proved) == (1, 8, True)
    assert (len(whole.casimirs), whole.rank, whole.found.proved.proved) == (2, 8, True)


def test_a_degree_of_halves():
    """U of degree 4 in γ: its entries count as of degree ½."""
    found = first_integrals(heavy(("1", "2", "3"), "A_31^4", ""), 2)
    assert {*found.found.grading.degree[3:]} == {0.5}
    assert found.casimirs[0].sympy() == sum(x**2 for x in GAMMA)


def test_default_values():
    found = first_integrals("kovalevskaya_top", at_defaults=True)
    assert not found.p
    assert found.integrals[1].sympy().subs(dict.fromkeys(PI, 0)) == -36 * GAMMA[2] ** 2
    assert all(v.holds for v in found.check(1))


def test_from_a_derivation():
    top = Problem("ball", SO(3), Lagrangian("zeta_1^2 + zeta_2^2 + zeta_3^2/2"))
    found = derive(top).integrals(2)
    assert found.integrals[1].sympy() == PI[2]
    assert repr(found) == "<first integrals of ball: 2>"
    with pytest.raises(ProblemError):
        first_integrals(Problem("none", SO(3), Lagrangian("zeta_1^2 + 2*zeta_2^2")))


def test_an_input_is_left_out():
    problem = lagrangian(
        "zeta_1^2 + 2*zeta_2^2 + 3*zeta_3^2", input=[{"name": "u", "kind": "covector"}]
    )
    assert "The inputs are left out" in str(first_integrals(problem, 1))


def test_points_have_the_integrals_of_their_lagrangian():
    """A top of solids: those of Lagrange's; points on SU(2), under a spring that does nothing."""
    top = first_integrals("top")
    assert (top.integrable, len(top.casimirs), len(top.integrals)) == (True, 2, 2)
    (spin,) = (x.sympy() for x in top.integrals[1:])
    assert spin == PI[2]
    assert [v for v in top.check() if not v.holds] == []
    assert first_integrals("su2", 2).integrable


def test_points_with_numbers():
    found = first_integrals("se3", 1, at_defaults=True)
    assert "The inputs are left out" in " ".join(str(found).split())
    assert [v for v in found.check() if not v.holds] == []


SPREAD, TIME = 1e-9, 50.0


def motion(found):
    """A motion of an emitted module from a rotation by an irrational angle: g, ζ at many times."""
    k, basis = found.constants(found.DEFAULTS), np.array(found.BASIS, float)
    n, d = basis.shape[1], len(basis)
    Z = np.tensordot(np.sin(np.arange(1, d + 1)), basis, 1)
    g = np.linalg.solve(np.eye(n) - Z / 2, np.eye(n) + Z / 2)  # Cayley's
    x = np.array([*g.ravel(), *np.cos(np.arange(1, d + 1))])
    run = solve_ivp(found.rhs, (0, TIME), x, "DOP853", rtol=1e-12, atol=1e-12, args=(k,))
    assert run.success
    return [(y[: n * n].reshape(n, n), y[n * n :]) for y in run.y.T]


def lagrange(p, g, z):
    return p["I3"] * z[2]


def kovalevskaya(p, g, z):
    nu = p["mgl"] / p["I"]
    one = z[0] ** 2 - z[1] ** 2 - nu * g[2, 0]
    two = 2 * z[0] * z[1] - nu * g[2, 1]
    return one**2 + two**2


def euler(p, g, z):
    return sum((p[f"I{a + 1}"] * z[a]) ** 2 for a in range(3))


PLANES = ((3, 4), (2, 4), (2, 3), (1, 4), (1, 3), (1, 2))
"""Those in which the elements of the basis of so(4) turn."""


def four_dimensions(p, g, z):
    """Σ (c_i − c_j)/(b_i − b_j) M_ij² is kept for every c (Manakov): here c = b²."""
    total = 0.0
    for (i, j), zeta in zip(PLANES, z, strict=True):
        momentum = (p[f"b{i}"] - p[f"b{j}"]) / (p[f"a{i}"] - p[f"a{j}"]) * zeta
        total += (p[f"b{i}"] + p[f"b{j}"]) * momentum**2
    return total


PUBLISHED = {
    "euler_top": euler,
    "lagrange_top": lagrange,
    "kovalevskaya_top": kovalevskaya,
    "manakov": four_dimensions,
}


@pytest.mark.parametrize("name", repeated(PUBLISHED))
def test_along_a_motion(name):
    """What is found, and what was published, keep their values along a motion of the emitted code;
    another polynomial does not."""
    found = module_of(name)
    parameters = found.DEFAULTS
    path = motion(found)
    integrals = first_integrals(name)
    values = [parameters[str(x)] for x in integrals.p]
    kept = [*integrals.casimirs, *integrals.integrals]
    functions = [sympy.lambdify([integrals.x, integrals.p], x.sympy()) for x in kept]
    states = [variables(integrals, name, parameters, g, z) for g, z in path]
    for f in functions:
        assert spread([f(x, values) for x in states]) < SPREAD
    assert spread([PUBLISHED[name](parameters, g, z) for g, z in path]) < SPREAD
    assert spread([x[0] for x in states]) > 0.1


def spread(values):
    return (max(values) - min(values)) / max(1, max(map(abs, values)))


MOMENTS = {
    "euler_top": lambda p: (p["I1"], p["I2"], p["I3"]),
    "lagrange_top": lambda p: (p["I1"], p["I1"], p["I3"]),
    "kovalevskaya_top": lambda p: (2 * p["I"], 2 * p["I"], p["I"]),
    "manakov": lambda p: [(p[f"b{i}"] - p[f"b{j}"]) / (p[f"a{i}"] - p[f"a{j}"]) for i, j in PLANES],
}
"""The moments of inertia, whose products with ζ are the momenta."""


def variables(integrals, name, p, g, z):
    """The variables of the reduced equations: momenta, and the third row of g where it occurs."""
    momenta = [x * y for x, y in zip(MOMENTS[name](p), z, strict=True)]
    return [*momenta, *g[2]][: len(integrals.x)]


@pytest.mark.parametrize(("moments", "several"), [((1, 2, 3), 1), ((1, 1, 3), 3)])
def test_brute_force(moments, several):
    """SymPy solves for all coefficients of a heavy top's integrals of degree at most 2 at once: H;
    and where two moments are equal, Π_3 and its square besides."""
    x = sympy.symbols("p:3 g:3")
    p, g = sympy.Matrix(x[:3]), sympy.Matrix(x[3:])
    turning = sympy.Matrix([y / sympy.Integer(k) for y, k in zip(p, moments, strict=True)])
    rates = [*(p.cross(turning) + 5 * sympy.Matrix([0, 0, 1]).cross(g)), *g.cross(turning)]
    monomials = sorted({*sympy.itermonomials(x[:3], 2), *x[3:]} - {sympy.Integer(1)}, key=str)
    unknown = sympy.symbols(f"k:{len(monomials)}")
    F = sum(k * y for k, y in zip(unknown, monomials, strict=True))
    rate = sympy.expand(sum(sympy.diff(F, y) * z for y, z in zip(x, rates, strict=True)))
    rows, _ = sympy.linear_eq_to_matrix(sympy.Poly(rate, *x).coeffs(), unknown)
    assert len(unknown) - rows.rank() == several
    found = first_integrals(heavy([*map(str, moments)], "-5*A_33", ""), 2)
    assert len(found.integrals) == (1 if several == 1 else 2)


def test_rates_are_those_of_euler_and_poisson():
    """By vectors: Π̇ = Π ∧ Ω + Γ ∧ ∂U/∂Γ, Γ̇ = Γ ∧ Ω."""
    found = first_integrals(heavy(("A", "B", "C"), "u*A_31 + v*A_32 + w*A_33", "A B C u v w"), 1)
    p, g = sympy.Matrix(found.x[:3]), sympy.Matrix(found.x[3:])
    A, B, C, *slope = sympy.symbols("A B C u v w", real=True)
    turning = sympy.Matrix([p[0] / A, p[1] / B, p[2] / C])
    expected = [*(p.cross(turning) + g.cross(sympy.Matrix(slope))), *g.cross(turning)]
    assert [sympy.simplify(x - y) for x, y in zip(found.rates, expected, strict=True)] == [0] * 6


def test_the_walk_is_the_same():
    found = first_integrals("lagrange_top", 1)
    own = walk(problem("lagrange_top"))
    assert found.record.steps[: len(own.steps)] == own.steps
