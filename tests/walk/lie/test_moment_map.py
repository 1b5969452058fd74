"""The momentum that g carries to the other side, and the energy: where they are said to be kept;
the form of Kirillov, Kostant and Souriau on a level of it."""

import numpy as np
import pytest
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
