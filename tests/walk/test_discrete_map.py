"""The discrete motion as a map, from the equations of its record: symplectic in 40 digits, its
momenta kept, of order 2; its notes are of it alone."""

import re
import tomllib
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import pairwise

import mpmath
import pytest

from derive.check.checker import check
from derive.command.cli import main
from derive.language import rational as q
from derive.pipeline import discrete
from derive.problem.toml import problem_of
from derive.views.rendering import render
from tests.support.corpus import driven, record
from tests.support.discrete_maps import DiscreteMap, real
from tests.support.walks import SEED, problem

DIGITS = 60  # so many that differences of 1e-20 leave 40
TINY = mpmath.mpf(10) ** -20


@cache
def undriven(name):
    return replace(problem(name), inputs=())


def map_of(given, h, number=real, tiny=TINY):
    """The map of a problem at the defaults of its parameters."""
    known = given.parameters.items()
    values = {k: Fraction(str(1 if p.default is None else p.default)) for k, p in known}
    return DiscreteMap(discrete(given), given.group, values, h, number, tiny)


def start(m, scale):
    """Two elements, a step of some size apart."""
    d, one = m.group.dimension, m.matrix(q.identity(m.size))
    place = [m.number(k % 3 - 1) / (k + 3) for k in range(d)]
    speed = [m.number((-1) ** k * (k + 2)) / (3 * k + 5) * scale for k in range(d)]
    g = m.moved(one, place)
    return g, m.moved(g, speed)


def defect(m):
    """The largest entry of D̄ Ω(g₁, g₂) D − Ω(g₀, g₁), for D the derivative of the map; and of the
    conservation laws."""
    g_0, g_1 = start(m, m.h)
    g_2, theta = m.next(g_0, g_1)
    D = m.tangent(g_0, g_1, g_2, theta)
    carried = q.times(q.transposed(D), q.times(m.form(g_1, g_2), D))
    here = m.form(g_0, g_1)
    assert max(map(abs, q.flatten(here))) > 0.1
    names = m.names(g_0, g_1, g_2)
    kept = m.step("conserved")
    laws = [e for e in kept.equations if e.rhs == 0] if kept else []
    values = [m.of(e.lhs, names) for e in laws]
    entries = [x for v in values for x in (q.flatten(v) if isinstance(v, tuple) else [v])]
    return max(map(abs, q.flatten(q.minus(carried, here)))), max(map(abs, entries), default=0)


SLOW = pytest.mark.dist
GROUPS = ["so3", "heisenberg", *(pytest.param(x, marks=SLOW) for x in ("se3", "sl3", "sp4"))]


@pytest.mark.parametrize("name", GROUPS)
def test_the_map_is_symplectic_and_keeps_momenta(name):
    with mpmath.workdps(DIGITS):
        form, momenta = defect(map_of(undriven(name), mpmath.mpf("0.1")))
        assert form < mpmath.mpf(10) ** -30
        assert momenta < mpmath.mpf(10) ** -30


def test_damping_is_not_symplectic():
    """What the test above measures is not 0 by itself."""
    text = driven("SO(3)").replace("length = 1 ", "length = 0 ")
    given = replace(problem_of(tomllib.loads(text)), inputs=(), potentials=())
    defaults = {k: replace(p, default=1) for k, p in given.parameters.items()}
    with mpmath.workdps(DIGITS):
        form, _ = defect(map_of(replace(given, parameters=defaults), mpmath.mpf("0.1")))
        assert form > 1e-3


def halfway(name, steps, time=0.4):
    """Where the motion is at the end: the middle of two elements about that time, which started in
    the middle of two about 0."""
    m = map_of(undriven(name), time / steps, float, 1e-6)
    one, d = m.matrix(q.identity(m.size)), m.group.dimension
    speed = [(-1) ** k * (k + 2) / (3 * k + 5) * m.h / 2 for k in range(d)]
    pair = m.moved(one, [-x for x in speed]), m.moved(one, speed)
    for _ in range(steps):
        pair = pair[1], m.next(*pair)[0]
    return [(a + b) / 2 for a, b in zip(*map(q.flatten, pair), strict=True)]


@pytest.mark.parametrize("name", GROUPS)
def test_the_map_is_of_order_2(name):
    ends = [halfway(name, n) for n in (4, 8, 16)]
    first, second = (max(abs(x - y) for x, y in zip(a, b, strict=True)) for a, b in pairwise(ends))
    assert 3.5 < first / second < 4.5


NAMES = ("so3", "se3", "sl3", "gl3", "saff3")


def test_a_discrete_record_holds_but_not_without_its_mark():
    d = record("discrete top")
    assert all(v.holds for v in check(d, SEED))
    plain = replace(d, problem={k: x for k, x in d.problem.items() if k != "discrete"})
    assert not all(v.holds for v in check(plain, SEED))


@pytest.mark.parametrize("name", NAMES)
def test_no_letter_is_lost_in_latex(name):
    for lang in ("en", "fr"):
        shown = render(record(f"discrete {name}"), "latex", lang)
        assert "?" not in re.sub(r"solides(~|\\,| |\\thinspace)*\?", "", shown)


@pytest.mark.parametrize("lang", ["en", "fr"])
def test_notes_are_of_discrete_motions(tmp_path, lang):
    """Of both actions in one text, each step once."""
    for end in (".tex", ".html"):
        out = tmp_path / f"notes{end}"
        assert main(["notes", "so3", "se3", "--discrete", "--lang", lang, "--out", str(out)]) == 0
        text = out.read_text(encoding="utf-8")
        label = r"\label{{{}}}" if end == ".tex" else 'id="{}"'
        for step in ("discrete.balance", "discrete_affine.blocks", "so3.turning", "se3.centre"):
            assert text.count(label.format(step)) == 1
        assert r"\Theta^" not in re.sub(r'data-tex="[^"]*"', "", text) or end == ".tex"
