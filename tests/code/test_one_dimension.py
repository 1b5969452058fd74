"""Springs, distances and forces along a line: vectors of one number."""

import numpy as np
import pytest

import derive
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from tests.support.library import ONE_BUILD, derived, library

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
    files = d.emit(languages=("c", "python"))
    (report, *_) = EmittedFiles(files, "line", Chart()).reports(d.record)
    assert report.holds


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
