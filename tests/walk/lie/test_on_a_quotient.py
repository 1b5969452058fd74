"""Forces and outputs of a motion on a quotient: a pendulum on a sphere, its bob in space."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive.problem.problem import ProblemError
from tests.support.library import derived

BOB = """
name = "bob"
group = "SO(3)"
[lagrangian]
L = "(zeta_1^2 + zeta_2^2)/2 - 9.81*A_33"
trivialisation = "left"
"""
DAMPED = '[[force]]\ncovector = ["-0.3*zeta_1", "-0.3*zeta_2", 0]\n'
WIND = '[[input]]\nname = "F"\nkind = "force"\nat = [0, 0, 1]\n'
READ = "".join(
    f'[[output]]\nkind = "{kind}"\nname = "{kind[0]}"\nat = [0, 0, 1]\nframe = "space"\n'
    for kind in ("place", "velocity", "acceleration")
)
READ += '[[output]]\nname = "s"\nkind = "expression"\ny = ["zeta_1^2 + zeta_2^2"]\n'
RIGHT = BOB.replace('"left"', '"right"')
SIDES = {"left": BOB, "right": RIGHT}
PULL = np.array([0.4, -1.1, 0.7])


def bob(_, y):
    """q̈ of a point on the unit sphere with weight, friction and a wind."""
    q, v = y[:3], y[3:]
    force = PULL - [0, 0, 9.81] - 0.3 * v
    return np.r_[v, force - (force @ q + v @ v) * q]


def test_a_damped_bob_in_a_wind():
    d = derived(BOB + DAMPED + WIND + READ)
    assert d.check()
    f = derive.compile(d, step="gauss")
    A, zeta = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0], [1.2, -0.7]
    A *= np.linalg.det(A)
    x = np.r_[A.flat, zeta]
    q, v = A[:, 2], A @ [zeta[1], -zeta[0], 0]
    known = bob(0, np.r_[q, v])
    assert np.allclose(f.outputs(0, x, PULL), [*q, *v, *known[3:], v @ v], atol=1e-13)
    found = solve_ivp(bob, (0, 2), np.r_[q, v], rtol=1e-12, atol=1e-12).y[:, -1]
    f.u = PULL
    end = f.begin(x).move_to(2.0, 1e-13).x
    assert np.allclose(f.outputs(2, end, PULL)[:6], found, atol=1e-9)


def test_any_covector():
    with pytest.raises(ProblemError, match="input 1: L has symmetries without kinetic energy"):
        derived(BOB + '[[input]]\nname = "u"\nkind = "covector"\n')


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(
    "covector",
    ['[0, 0, "t"]', '["zeta_1", 0, 0]', '["A_11", "A_22", 0]', '["-zeta_1", "-zeta_2", "zeta_1"]'],
)
def test_forces_that_are_of_no_quotient(side, covector):
    with pytest.raises(ProblemError, match="force 1: L has symmetries without kinetic energy"):
        derived(SIDES[side] + f"[[force]]\ncovector = {covector}\n")


def test_a_force_of_the_quotient_on_the_right():
    d = derived(RIGHT + '[[force]]\ncovector = ["-zeta_1*A_33", "-zeta_2*A_33", 0]\n')
    assert d.check()


def test_a_force_beside_the_axis():
    with pytest.raises(ProblemError, match="input 1: L has symmetries"):
        derived(BOB + WIND.replace("[0, 0, 1]", "[1, 0, 1]"))


@pytest.mark.parametrize(
    "read",
    [
        'kind = "velocity"\nat = [1, 0, 0]\nframe = "space"',
        'kind = "velocity"\nat = [0, 0, 1]\nframe = "body"',
        'kind = "place"\nat = [0, 1, 1]\nframe = "space"',
        'kind = "acceleration"\nat = [0, 1, 0]\nframe = "space"',
        'kind = "rate"',
        'kind = "expression"\ny = ["zeta_3"]',
        'kind = "expression"\ny = ["A_11 + t"]',
    ],
)
def test_outputs_that_the_motion_leaves_open(read):
    with pytest.raises(ProblemError, match="output 'y': it depends on"):
        derived(f'{BOB}[[output]]\nname = "y"\n{read}\n')
