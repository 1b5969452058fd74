"""Equilibria with square roots, beside finite differences of the emitted code and of the energy."""

from dataclasses import replace
from fractions import Fraction
from random import Random

import numpy as np
import pytest
import sympy

from derive import derive
from derive.check.checker import Checker
from derive.command.cli import main
from derive.language.expression import parse
from derive.language.tree import add, replaced
from derive.language.univariate import RootError, root, value_of
from derive.record.as_json import from_json, to_json
from derive.record.sentence import english
from derive.search.equilibria.energy_casimir import along_the_orbit, kernel, restricted, solutions
from derive.search.equilibria.stability import roots_of_squares
from derive.search.equilibria.stability_in_letters import decided, must_not_be_negative
from tests.oracles.sampling import cross_matrix
from tests.support.coadjoint_orbits import match, orbit_signature
from tests.support.lagrangians import disc, heavy, lagrangian, squares
from tests.support.library import module_of
from tests.support.walks import SEED

MOMENTS = (1, 3, 2)
TILTED = {"A_31": "sqrt(3)/2", "A_33": "1/2", "Pi_1": "sqrt(3)/2", "Pi_3": "1"}
"""Of a top with these moments, and weight ½ on its third axis: ω = Γ is in its plane 1, 3, at 60°
from the axis, for Ω²(I₃ − I₁) cos θ = m g l."""
WEIGHT = np.array([0, 0, 0.5])


def tilted(moments=MOMENTS):
    (found,) = derive(heavy([*map(str, moments)], "A_33/2", "")).equilibria(TILTED)
    return found


def point(found):
    return np.array([*map(float, found.found.about.at)])


def test_the_tilted_top_beside_its_emitted_code():
    """The eigenvalues of finite differences of the emitted rates of (Π, Γ)."""
    problem = heavy([*map(str, MOMENTS)], "A_33/2", "")
    module = module_of(problem)
    k = module.constants({})

    def rates(x):
        zeta = x[:3] / MOMENTS
        g = np.vstack([np.zeros((2, 3)), x[3:]])
        dx = module.rhs(0.0, np.concatenate([g.ravel(), zeta]), k)
        return np.concatenate([np.multiply(dx[9:], MOMENTS), dx[6:9]])

    found = tilted()
    x, step = point(found), 1e-6
    assert rates(x) == pytest.approx(np.zeros(6), abs=1e-12)
    slopes = [(rates(x + step * e) - rates(x - step * e)) / (2 * step) for e in np.eye(6)]
    expected = np.linalg.eigvals(np.array(slopes).T)
    assert match(expected, [*found.eigenvalues, 0, 0], 1e-3)
    assert np.sort(expected.real)[-1] == pytest.approx(found.growth, abs=1e-3)


@pytest.mark.parametrize("moments", [MOMENTS, (1, 4, 2), (1, "3/2", 2)])
def test_the_signature_modulo_the_stabiliser(moments):
    found = tilted(moments)
    numbers = [float(Fraction(x)) for x in moments]
    assert orbit_signature(point(found), numbers, WEIGHT) == found.signature
    form = found.found.form
    assert restricted(form.expansion.second, found.found.leaf) == along_the_orbit(
        found.found.about, found.found.leaf
    )


def test_a_gyrostat_turns_aslant():
    """Its momentum is along its velocity: (I₁√2, 0, I₁w) for ω = (√2, 0, w), w = h/(I₁ − I₃)."""
    L = "(3*zeta_1^2 + 2*zeta_2^2 + zeta_3^2)/2 + 4*zeta_3"
    (found,) = derive(lagrangian(L)).equilibria({"Pi_1": "3*sqrt(2)", "Pi_3": 6})
    pi = np.array([3 * np.sqrt(2), 0, 6])
    metric = np.diag([1 / 3, 1 / 2, 1])
    omega = metric @ (pi - [0, 0, 4])
    assert np.cross(pi, omega) == pytest.approx(np.zeros(3))
    linear = cross_matrix(pi) @ metric - cross_matrix(omega)
    assert match(np.linalg.eigvals(linear), [*found.eigenvalues, 0], 1e-9)
    assert found.verdict == ("unstable" if found.growth > 1e-9 else "stable")


def test_a_free_solid_scales_with_its_momentum():
    for spin in ("sqrt(2)", "3/5*sqrt(5) - 1"):
        verdicts = [derive("euler_top").equilibria({f"Pi_{a}": spin})[0] for a in (1, 2, 3)]
        assert [x.verdict for x in verdicts] == ["stable", "unstable", "stable"]
        one = derive("euler_top").equilibria({"Pi_2": 1})[0].growth
        assert verdicts[1].growth == pytest.approx(one * abs(float(value_of(parse(spin)))))


CHANGES = {
    "another root": lambda t: replaced(t, ROOT, ("fun", "sqrt", 5)),
    "its square": lambda t: add(t, ROOT),
    "no root": lambda t: replaced(t, ROOT, Fraction(1732, 1000)),
}
ROOT = ("fun", "sqrt", 3)


def test_the_checker_knows_the_root():
    record = derive(heavy([*map(str, MOMENTS)], "A_33/2", "")).equilibria(TILTED).record
    checker = Checker(record.problem, SEED)
    rates, form = (record[x] for x in ("equilibrium_1", "energy_casimir_1"))
    assert [checker.check(s).reason for s in (rates, form)] == ["", ""]
    for change in CHANGES.values():
        (e,) = form.equations
        assert checker.check(replace(form, equations=(replace(e, rhs=change(e.rhs)),))).reason
    first, *others = rates.equations
    wrong = (replace(first, rhs=CHANGES["its square"](first.rhs)), *others)
    assert checker.check(replace(rates, equations=wrong)).reason
    assert from_json(to_json(record)).steps == record.steps


def test_a_singular_leaf():
    """Of a solid in a fluid that turns without impulse: Euler's three axes, on a sphere in
    dimension 6, whose stabiliser is not compact; of so(4)*, points with a compact one."""
    turning = [*derive("kirchhoff").equilibria()][:3]
    assert [x.verdict for x in turning] == ["stable on the leaf", "unstable", "stable on the leaf"]
    assert [x.signature for x in turning] == [(0, 2), (1, 1), (2, 0)]
    solid = derive(lagrangian(squares(3, 5, 11, 13, 17, 19), "SO(4)"))
    kept, lost = (
        solid.equilibria({x: 1, y: 1})[0] for x, y in (("Pi_1", "Pi_6"), ("Pi_2", "Pi_5"))
    )
    assert (kept.verdict, kept.signature, len(kept.found.leaf.free)) == ("stable", (0, 2), 2)
    assert (lost.verdict, lost.signature) == ("unstable", (1, 1))


def test_a_solid_at_rest():
    """The leaf is a point; of a ball that would fall, beyond the leaf."""
    (rest,) = derive("euler_top").equilibria({"Pi_1": 0})
    assert (rest.verdict, rest.signature) == ("stable", (0, 0))
    odd = lagrangian("zeta_1^2 + 2*zeta_2^2 - 3*zeta_3^2")
    (rest,) = derive(odd).equilibria({"Pi_1": 0})
    assert rest.verdict == "stable"  # |Π|² is kept


@pytest.mark.parametrize(
    "text", ["sqrt(3)/2", "3/5*sqrt(2) - 1", "(1 + sqrt(5))^3/7", "1/sqrt(12)"]
)
def test_numbers(text):
    own, other = value_of(parse(text)), sympy.sympify(text.replace("^", "**"))
    assert float(own) == pytest.approx(float(other))
    assert (own > 1) == bool(other > 1)
    assert own * own - own / 3 + 1 == value_of(parse(f"({text})^2 - ({text})/3 + 1"))
    assert (1 - own) / (1 - own) == 1


def test_roots_that_are_none():
    assert root(Fraction(9, 4)) == Fraction(3, 2)
    for text in ("sqrt(2) + sqrt(3)", "sqrt(1 + sqrt(2))", "sin(1)"):
        with pytest.raises(RootError):
            value_of(parse(text))
    with pytest.raises(RootError):
        root(-2)


def test_linear_algebra_over_a_quadratic_field():
    two = root(2)
    ((x, y),) = kernel([[two, Fraction(2)]], 2)
    assert x / y == -two
    start, free = solutions([[two], [Fraction(1)]], [Fraction(2)])
    assert start[0] * two + start[1] == 2
    assert len(free) == 1


def random_roots(random):
    """Roots with their multiplicities, some of them 0, and pairs of complex ones; by name."""
    pool = [*map(Fraction, range(-4, 4)), Fraction(-1, 3), Fraction(2, 5)]
    reals = {random.choice(pool): random.randint(1, 3) for _ in range(random.randint(0, 3))}
    pairs = {(random.randint(-2, 2), random.randint(1, 2)) for _ in range(random.randint(0, 2))}
    return reals, {x: random.randint(1, 2) for x in pairs}


@pytest.mark.parametrize("scale", [1, root(2)])
def test_roots_are_counted(scale):
    """Of q(λ²) with known roots, times a number: by name, and by NumPy where none is multiple."""
    random, seen = Random(7), set()
    for _ in range(200):
        reals, pairs = random_roots(random)
        factors = [[1, -x * scale] for x, k in reals.items() for _ in range(k)]
        factors += [
            [1, -2 * a * scale, (a * a + b * b) * scale**2]
            for (a, b), k in pairs.items()
            for _ in range(k)
        ]
        q = [Fraction(1)]
        for f in factors:
            q = [
                sum((f[j] * q[i - j] for j in range(len(f)) if 0 <= i - j < len(q)), Fraction(0))
                for i in range(len(q) + len(f) - 1)
            ]
        found = roots_of_squares([y for x in q for y in (x, Fraction(0))][:-1])
        nonzero = [x for x in reals if x]
        expected = (reals.get(0, 0), sum(x < 0 for x in nonzero), len(nonzero) + 2 * len(pairs))
        assert (found.at_zero, found.negative, found.distinct) == expected
        if {*reals.values(), *pairs.values()} <= {1}:
            near = np.roots([float(x) for x in q])
            real = near[np.abs(near.imag) < 1e-6].real
            assert found.negative == sum(real < -1e-6)
        seen.add((found.at_zero > 0, found.negative < found.distinct))
    assert len(seen) == 4


@pytest.mark.parametrize("terms", [1, 12])
def test_signs_that_say_where_roots_are(terms):
    """Of λ⁴ + bλ² + c in letters: a discriminant that is left out leaves b = c = 1 open."""
    letters = sympy.QQ.frac_field(*(f"x{k}" for k in range(terms + 1))).field.gens
    b, c = sum(letters[:-1]), letters[-1]
    signs = must_not_be_negative([b.field.one, b, c])
    at = dict.fromkeys(map(str, letters), Fraction(1, terms)) | {str(c): 1}
    shown = [Fraction(str(x.as_expr().subs(at))) for x in signs]
    assert decided([b.field.one, b, c]) is (terms == 1)
    assert all(x >= 0 for x in shown) is not decided([b.field.one, b, c])
    assert decided([b.field.one, b, c**2])


NAMED = {
    "a disc in a fluid, edge-on": ((1, 0, "-2/3", 0, 0), 2, True),
    "a ball beside Euler's top": ((1, 0, "-1/12", 0, 0), 2, True),
    "three and a zero": ((1, 0, -3, 0, 0), 2, True),
    "imaginary, and 0": ((1, 0, 5, 0, 0), 2, False),
    "imaginary twice": ((1, 0, 2, 0, 1), 0, False),
    "0 alone": ((1, 0, 0, 0, 0), 4, False),
    "no root": ((1,), 0, False),
}


@pytest.mark.parametrize("name", NAMED)
def test_a_root_0_is_no_other(name):
    coefficients, zeros, grows = NAMED[name]
    found = roots_of_squares([*map(Fraction, coefficients)])
    assert (2 * found.at_zero, found.negative < found.distinct) == (zeros, grows)
    assert grows == any(x.real > 1e-6 for x in np.roots([*map(float, map(Fraction, coefficients))]))


BALL = squares("1/2", "1/2", "1/2", "1/2", 1, "3/2")
UNSTABLE = {
    "disc": (disc(), {"Pi_4": 1}),
    "ball": (lagrangian(BALL, "SO(3) x SO(3)"), {"Pi_1": 1, "Pi_5": 1}),
}


@pytest.mark.parametrize("name", UNSTABLE)
def test_unstable_beside_a_zero(name):
    problem, at = UNSTABLE[name]
    found = derive(problem).equilibria(at)
    assert (found[0].verdict, found[0].found.squares.at_zero) == ("unstable", 1)
    assert found[0].growth > 0.2
    assert "all eigenvalues are imaginary" not in english(found.record.steps[-1].prose)


def test_the_eigenvalues_are_printed(capsys):
    assert main(["equilibria", "euler_top", "--at", "Pi_2=sqrt(2)"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "The eigenvalues are about ±" in shown
    assert "Their squares are exactly" in shown
