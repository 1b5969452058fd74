"""The momentum that g carries to the other side, and the energy, along motions in floats; the form
of Kirillov, Kostant and Souriau on a level of it."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from derive.algebra import calculus
from derive.algebra.words import inner, word
from derive.language.show import show
from derive.pipeline import lagrangian_road
from derive.problem.toml import problem_of
from derive.python.derived import derive
from derive.walk.chapter import Chapter
from derive.walk.lie.any_lagrangian import orbit_form
from derive.walk.spine.alphabet import Alphabet
from tests.oracles.sampling import cross_matrix
from tests.support.lagrangians import lagrangian, squares
from tests.support.library import module_of

SIDES = {"left": "⟨Π, A⁻¹ξ′A⟩", "right": "⟨Π, Aξ′A⁻¹⟩"}
HEISENBERG = {"algebra": {"brackets": [[1, 2, 3, 1]]}, "lagrangian": {"L": squares(1, 2, 3)}}
OF_A_CUBIC = {"name": "Spiral", "basis": [[[0, 1, 0], [0, 0, 1], [1, 1, 0]]]}


def laws(d):
    found = [s for s in d.record.steps if s.label == "x.conserved"]
    return {show(e.lhs) for s in found for e in s.equations if e.rhs == 0}


def holds(d):
    verdicts = {v.label: v for v in d.check(seed=5)}
    assert all(v.holds for v in verdicts.values())
    return {*verdicts}


def test_what_depends_on_more_keeps_less():
    free = squares(1, 2, 3)
    assert laws(derive(lagrangian(f"({free})*(2 + cos(t))"))) == {"Π̇_o"}
    assert laws(derive(lagrangian(f"{free} - A_33"))) == {"ḣ"}
    assert laws(derive(lagrangian(f"{free} - t*A_33"))) == set()


def test_an_algebra_alone():
    d = derive(problem_of({"name": "x", **HEISENBERG}))
    assert "x.conserved" in holds(d)
    assert laws(d) == {"ḣ", "Π̇_o"}


def test_a_group_of_which_no_exact_element_is_known():
    d = derive(lagrangian("zeta_1^2", OF_A_CUBIC))
    assert "x.conserved" in holds(d)
    assert laws(d) == {"ḣ"}


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize("group", ["SL(2)", "SE(2)"])
def test_it_is_constant_along_the_motion(side, group):
    """⟨Π, A⁻¹E_aA⟩, or ⟨Π, AE_aA⁻¹⟩, by the basis of the emitted code."""
    L = "zeta_1^2/2 + zeta_2^2 + 3*zeta_3^2/2 + zeta_1*zeta_2/3"
    code = module_of(lagrangian(L, group, side=side))
    k = code.constants(code.DEFAULTS)
    E = np.array(code.BASIS, float)
    M = np.array([[1, 1 / 3, 0], [1 / 3, 2, 0], [0, 0, 3]])
    n = E.shape[1]

    def element(x):
        if group == "SL(2)":
            return x[:4].reshape(2, 2), x[4:]
        return np.block([[x[:4].reshape(2, 2), x[4:6, None]], [np.zeros((1, 2)), 1]]), x[6:]

    def other(x):
        g, zeta = element(x)
        back = np.linalg.inv(g)
        carried = [back @ e @ g if side == "left" else g @ e @ back for e in E]
        by_E = np.linalg.lstsq(E.reshape(3, n * n).T, np.reshape(carried, (3, -1)).T, rcond=None)[0]
        return (M @ zeta) @ by_E

    start = np.r_[1, 0, 0, 1, [0] * (group == "SE(2)") * 2, 0.3, 0.5, -0.4]
    run = solve_ivp(lambda t, x: code.rhs(t, x, k), (0, 2), start, rtol=1e-11, atol=1e-11)
    found = np.array([other(x) for x in run.y.T])
    assert np.ptp(np.array([M @ element(x)[1] for x in run.y.T]), axis=0).max() > 0.05
    assert np.abs(found - found[0]).max() < 1e-7


STEP = 1e-3


def axis(skew):
    return np.array([skew[2, 1], skew[0, 2], skew[1, 0]])


def told(side):
    steps = lagrangian_road(side)["steps"]
    return next(s for s in steps if s.label == f"{side}.kks")


def test_the_sign_is_that_of_the_structure_equation():
    shown = {side: show(told(side).equations[1].lhs) for side in ("left", "right")}
    assert shown == {
        "left": "dϖ(δy, δ′y) − ⟨Π, [ξ, ξ′]⟩",
        "right": "dϖ(δy, δ′y) + ⟨Π, [ξ, ξ′]⟩",
    }


@pytest.mark.parametrize(("side", "epsilon"), [("left", 1), ("right", -1)])
def test_on_a_level_of_the_other_momentum_it_is_what_is_said(side, epsilon):
    """ϖ on SO(3) at constant time, where Π is a constant of the other side carried by g; dϖ by
    differences on a surface of the group."""
    random = np.random.default_rng(8)
    x, y, constant = random.normal(size=(3, 3))
    start = expm(cross_matrix(random.normal(size=3)))

    def point(s, r):
        return start @ expm(cross_matrix(s * x + r * y + s * r * constant))

    def form(s, r, along):
        g = point(s, r)
        ahead, behind = (point(s + k * along[0], r + k * along[1]) for k in (STEP, -STEP))
        rate = (ahead - behind) / (2 * STEP)
        carried = g.T @ rate if side == "left" else rate @ g.T
        momentum = (g.T if side == "left" else g) @ constant
        return momentum @ axis((carried - carried.T) / 2), momentum, axis(carried)

    first, second = (1, 0), (0, 1)
    ahead = form(STEP, 0, second)[0] - form(-STEP, 0, second)[0]
    aside = form(0, STEP, first)[0] - form(0, -STEP, first)[0]
    _, momentum, xi = form(0, 0, first)
    *_, xi_prime = form(0, 0, second)
    expected = epsilon * momentum @ np.cross(xi, xi_prime)
    assert (ahead - aside) / (2 * STEP) == pytest.approx(expected, rel=1e-4)


def test_a_wrong_bracket_is_no_orbit_form():
    """What is left of ⟨δΠ, ξ′⟩ by itself is none."""
    a, c = Alphabet("n", affine=False), Chapter("left")
    alone = inner(word(a.Pi.d_momentum), word(a.Z.xi_prime))
    with pytest.raises(ValueError, match="neither the expression nor its opposite"):
        orbit_form(alone, a, calculus.left, told("left"), c)
