"""Integrals along motions of the emitted code, and beside SymPy's own brute force."""

import numpy as np
import pytest
import sympy
from scipy.integrate import solve_ivp

from derive import first_integrals
from derive.pipeline import walk
from tests.support.lagrangians import heavy
from tests.support.library import module_of
from tests.support.walks import problem, repeated

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
