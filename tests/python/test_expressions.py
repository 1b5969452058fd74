"""The equations handed to users as SymPy expressions are those of the emitted code."""

import numpy as np
import pytest
import sympy

import derive
from tests.support.library import module_of

PROBLEMS = ("so3", "se3", "top", "gl3", "saff3", "comet", "two_tops")


@pytest.mark.parametrize("name", PROBLEMS)
def test_the_same_numbers(name):
    code, e = module_of(name), derive.derive(name).expressions()
    assert [str(x) for x in (*e.x, *e.p, *e.u)] == [*code.STATE, *code.PARAMETERS, *code.INPUTS]
    rng = np.random.default_rng(5)
    p = np.array([code.DEFAULTS.get(x, rng.uniform(0.5, 1.5)) for x in code.PARAMETERS])
    x, u, t = rng.normal(size=len(e.x)), rng.normal(size=len(e.u)), 0.3
    k = code.constants(p)
    rhs = sympy.lambdify([e.t, e.x, e.p, e.u], e.rhs.subs(e.k), cse=True)(t, x, p, u)
    energy = sympy.lambdify([e.t, e.x, e.p], e.energy.subs(e.k), cse=True)(t, x, p)
    np.testing.assert_allclose(np.ravel(rhs), code.rhs(t, x, k, u), rtol=1e-11, atol=1e-11)
    assert energy == pytest.approx(code.energy(t, x, k), rel=1e-11)


def test_principal_axes_of_a_free_body():
    """I ω̇ = Iω ∧ ω in principal axes: J is diagonal, there are no other terms (Euler)."""
    e = derive.derive("so3").expressions()
    named = {s.name: s for s in (*e.p, *e.u, *e.x)}
    still = {named[x]: 0 for x in ("c_1", "c_2", "c_3", "J_12", "J_13", "J_23", "u_1")}
    found = sympy.factor(e.rhs[9].subs(e.k).subs(still))
    J2, J3, y, z = (named[x] for x in ("J_22", "J_33", "zeta_2", "zeta_3"))
    I2, I3 = named["J_11"] + J3, named["J_11"] + J2
    assert sympy.simplify(found - (I2 - I3) / (J2 + J3) * y * z) == 0


def test_pi_is_a_symbol():
    """The mass of an ellipsoid is ⁴⁄₃π ρ a b c."""
    e = derive.derive("ellipsoid").expressions()
    text = str([*e.k.values(), *e.rhs])
    assert "pi" in text
    assert not any(x.is_Float for y in (*e.k.values(), *e.rhs) for x in sympy.preorder_traversal(y))
