"""The form of Kirillov, Kostant and Souriau, beside a level of the other momentum in floats."""

import numpy as np
import pytest
from scipy.linalg import expm

from derive.algebra import forms
from derive.algebra.words import inner, word
from derive.language.show import show
from derive.pipeline import lagrangian_road
from derive.walk.chapter import Chapter
from derive.walk.lie.any_lagrangian import orbit_form
from derive.walk.spine.alphabet import Alphabet

STEP = 1e-3


def hat(x):
    return np.cross(np.eye(3), x) * -1


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
    start = expm(hat(random.normal(size=3)))

    def point(s, r):
        return start @ expm(hat(s * x + r * y + s * r * constant))

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
        orbit_form(alone, a, forms.left, told("left"), c)
