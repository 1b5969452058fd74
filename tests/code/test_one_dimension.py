"""One number: springs, distances and forces along a line; atan2 to rounding up to ±π in every
language, π at the jump; a group of one parameter that scales, which keeps its coordinate s: exp(sE)
with SciPy, the same motion as by matrices, and the files read back."""

import math

import numpy as np
import pytest
from scipy.linalg import expm

import derive
from derive.algebra.factor_charts import factor_charts
from derive.algebra.user_groups import group_of_basis
from derive.language import rational as q
from derive.motion.first_numbers import first_numbers
from tests.support.emitted_files import READ, Emission
from tests.support.library import ONE_BUILD, STEPPED, derived, library

STEPS = ("gauss", "vern9")
SPRING = '[[potential]]\nkind = "spring"\nstiffness = 4\n'
POINT = "[[point]]\nmass = {mass}\nat = {at}\nblock = {block}\n"


def text(group, points, more):
    """A problem of points (mass, at, block)."""
    listed = "".join(POINT.format(mass=m, at=at, block=b) for m, at, b in points)
    return f'name = "line"\ngroup = "{group}"\n{listed}{more}'


ONE = [(1, [0.5], 1)]
TWO = [(2, [0], 1), (1, [0.5], 2)]
PLANE = [(2, [1, 0], 1), (1, [0.5], 2)]
TAUT = SPRING + "between = [1, 2]\nlength = 1\n"
FREE = SPRING + "on = 2\nanchor = [3]\nlength = 1\n"
FAR = '[[output]]\nkind = "distance"\nname = "far"\nat = [0]\nto = [7]\n'


def pulled(x, anchor, mass, length=1.0):
    """The acceleration on a line that a spring of 4 gives."""
    gap = x - anchor
    return -4 * (gap - length * np.sign(gap)) / mass


CASES = {
    "an anchor": ("R(1)", ONE, SPRING + "on = 1\nanchor = [0]\n", lambda x: [-4 * (x[0] + 0.5)]),
    "a length": (
        "R(1)",
        ONE,
        SPRING + "on = 1\nanchor = [3]\nlength = 1\n",
        lambda x: [pulled(x[0] + 0.5, 3, 1)],
    ),
    "two on a line": (
        "R(1) x R(1)",
        TWO,
        TAUT,
        lambda x: [pulled(x[0], x[1] + 0.5, 2), pulled(x[1] + 0.5, x[0], 1)],
    ),
    "a plane beside": ("R(2) x R(1)", PLANE, FREE, lambda x: [0, 0, pulled(x[2] + 0.5, 3, 1)]),
    "a turn beside": ("SO(2) x R(1)", PLANE, FREE, lambda x: [0, pulled(x[4] + 0.5, 3, 1)]),
}
"""Group, points, forces → the accelerations by hand, of the state."""


@pytest.mark.parametrize("name", CASES)
def test_rates_on_a_line(name):
    group, points, more, known = CASES[name]
    d = derived(text(group, points, more))
    assert d.check()
    f = derive.compile(d)
    x = np.random.default_rng(5).normal(size=len(f.STATE))
    rates = np.asarray(f.rhs(0.0, x))[-len(known(x)) :]
    assert np.allclose(rates, known(x), rtol=0, atol=1e-13)
    assert not Emission(text(group, points, more)).refused({})


@pytest.mark.parametrize(("group", "points"), [("R(1)", ONE), ("R(1) x R(1)", TWO)])
def test_a_distance_on_a_line(group, points):
    d = derived(text(group, points, FAR))
    assert d.check()
    f = derive.compile(d)
    x = np.zeros(len(f.STATE))
    x[0] = 9.5
    assert np.allclose(f.outputs(0.0, x), [2.5])


FALLS = {
    "a stone": 'group = "R(2)"\n[[point]]\nmass = 1\nat = [0, 0]\n[[potential]]\nkind = "gravity"\n'
    "g = [0, -9.81]\n",
    "a Lagrangian": 'group = "R(1)"\n[lagrangian]\nL = "zeta_1^2/2 - 9.81*T_1"\n',
    "a force": 'group = "R(3)"\n[[point]]\nmass = 2\nat = [0, 0, 0]\n[[force]]\non = 1\n'
    'force = [0, 0, "-19.62"]\n',
}


@pytest.mark.parametrize(
    ("name", "build"),
    [*(("a stone", x) for x in ONE_BUILD.values()), ("a Lagrangian", "c"), ("a force", "c")],
)
@pytest.mark.parametrize("step", STEPS)
def test_from_rest_at_the_origin(name, build, step):
    found = library(build, f'name = "fall"\n{FALLS[name]}', step=STEPS)
    size = {"a stone": 2, "a Lagrangian": 1, "a force": 3}[name]
    for t in (1e-3, 2.0, 300.0):
        (*_, place) = found.follow([(f"{step}_to", t, 1e-9)], np.zeros(2 * size), [], [])
        known = np.zeros(2 * size)
        known[size - 1], known[-1] = -9.81 * t * t / 2, -9.81 * t
        assert np.allclose(place.x, known, rtol=1e-9, atol=0)


# ---------------------------------------------------------------- angles

ANGLE = """
name = "turned"
group = "R(2)"
[[point]]
mass = 1
at = [0, 0]
[[output]]
kind = "expression"
name = "angle"
y = ["atan2(T_2, T_1)"]
[[potential]]
kind = "expression"
U = "atan2(r1_y, r1_x)"
"""
TINY = [1.0, 1e-4, 1.5e-8, 3e-9, 1e-12, 1e-16, 1e-40, 1e-120]


def around():
    rng = np.random.default_rng(4)
    for size in TINY:
        for x, y in rng.normal(size=(12, 2)) * [1, size]:
            yield x, y
            yield y, x


@pytest.mark.parametrize("build", [ONE_BUILD[x] for x in STEPPED])
def test_it_is_the_angle(build):
    found = library(build, ANGLE)
    k = found.constants([])[1]

    def angle(x, y):
        return found.said("outputs", np.array([x, y, 0.0, 0.0]), 0.0, k=k)[0]

    for x, y in [*around()][:: 1 if build == "c" else 16]:
        assert abs(angle(x, y) - math.atan2(y, x)) <= 1e-15
    for x, y, known in [(-2, 0, math.pi), (2, 0, 0), (0, 3, math.pi / 2), (-1e20, 0, math.pi)]:
        assert angle(x, y) == known


def test_its_slope_near_the_jump():
    found = library("c", ANGLE)
    k = found.constants([])[1]
    for x, y in around():
        if abs(y) > 1e-100 < abs(x):
            rate = np.ravel(found.rhs(0.0, np.array([x, y, 0.0, 0.0]), k, np.zeros(0)))[-2:]
            r = math.hypot(x, y)
            assert np.abs(rate - np.array([y, -x]) / r / r).max() <= 1e-14 / r


# ---------------------------------------------------------------- scalings

BASES = {
    "dilation": "[[[1, 0], [0, 1]]]",
    "contraction": '[[["-2/3", 0], [0, "-2/3"]]]',
    "boost": '[[[0, "1/2"], ["1/2", 0]]]',
    "weights": "[[[2, 0], [0, -1]]]",
    "one axis": "[[[3, 3], [0, 0]]]",
}
BODY = """
name = "test"
[group]
name = "G"
action = "linear"
basis = {basis}
[[point]]
mass = 1
at = [1, 0.5]
[[point]]
mass = 2
at = [-0.5, 1]
[[potential]]
kind = "spring"
on = 1
anchor = [1, 1]
stiffness = 2
[initial]
exp = [0.7]
zeta_1 = 0.4
"""


def made(basis, attitude):
    several = READ if basis == BASES["boost"] else ("python",)
    return Emission(BODY.format(basis=basis), several, attitude=attitude, jacobian=("state",))


@pytest.mark.parametrize("name", BASES)
def test_the_coordinate_is_that_of_the_exponential(name):
    chart = made(BASES[name], "angle")
    angle, matrices, compiled = chart.module, made(BASES[name], "matrix").module, chart.program
    assert compiled.state == ("s_1", "zeta_1")
    E = np.array(compiled.basis[0], float)
    k, other = angle.constants([]), matrices.constants([])
    for s in (-1.3, 0, 0.8):
        x, A = np.array([s, 0.4]), expm(s * E)
        y = np.array([*A.ravel(), 0.4])
        assert np.allclose(angle.to_matrix(x), y, rtol=1e-13, atol=1e-14)
        wanted = matrices.rhs(0.0, y, other)[-1]
        assert np.allclose(angle.rhs(0.0, x, k), [0.4, wanted], rtol=1e-12)
        assert np.isclose(angle.energy(0.0, x, k), matrices.energy(0.0, y, other), rtol=1e-13)
    assert np.allclose(first_numbers(compiled, chart.problem, {}).x, [0.7, 0.4], rtol=1e-14)
    assert not chart.refused({})


@pytest.mark.parametrize(
    "rows", [[[0, 2], [1, 0]], [[2, 0], [0, 3]], [[1, 1], [0, 1]], [[1, -1], [1, 1]]]
)
def test_what_has_none(rows):
    """Irrational eigenvalues, none of which all are multiples, a shear beside, a spiral."""
    assert not factor_charts(group_of_basis("G", "linear", [q.matrix(rows)]), "angle")
