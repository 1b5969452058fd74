"""Expressions of SymPy as what stands in quotes in a problem file: the same values, or one line."""

import subprocess
import sys
from fractions import Fraction

import mpmath
import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import derive
from derive.language.derivatives import DERIVATIVES
from derive.language.expression import ExpressionError, parse
from derive.language.values import value
from derive.problem.problem import ProblemError
from derive.python.quoted import quoted

a, b, x = sympy.symbols("a b r1_x")
AT = {a: Fraction(3, 7), b: Fraction(-5, 2)}
NAMED = {s.name: q for s, q in AT.items()}

numbers = st.one_of(
    st.integers(-9, 9).map(sympy.Integer),
    st.fractions(-9, 9, max_denominator=12).map(
        lambda q: sympy.Rational(q.numerator, q.denominator)
    ),
)
leaves = st.one_of(st.sampled_from([a, b]), numbers)


def grown(inside):
    pairs = st.tuples(inside, inside)
    return st.one_of(
        pairs.map(lambda p: p[0] + p[1]),
        pairs.map(lambda p: p[0] - p[1]),
        pairs.map(lambda p: p[0] * p[1]),
        pairs.filter(lambda p: p[1] != 0).map(lambda p: p[0] / p[1]),
        st.tuples(inside, st.integers(-3, 4))
        .filter(lambda p: p[0] != 0)
        .map(lambda p: p[0] ** p[1]),
    )


rational = st.recursive(leaves, grown, max_leaves=12)


def in_grammar(e):
    """The tree of a SymPy expression; hypothesis takes another where there is a pole."""
    text = quoted(e)
    try:
        return parse(text if isinstance(text, str) else repr(text))
    except ExpressionError as error:
        assume("division by zero" not in str(error))
        raise


@settings(max_examples=150, deadline=None)
@given(rational)
def test_fractions_stay_exact(e):
    expected = e.subs({s: sympy.Rational(q.numerator, q.denominator) for s, q in AT.items()})
    assume(expected.is_Rational)
    found = value(in_grammar(e), {}, NAMED)
    assert found == Fraction(int(expected.p), int(expected.q))


KNOWN = [getattr(sympy, name) for name in DERIVATIVES]


def functions(inside):
    return st.one_of(
        grown(inside),
        st.tuples(st.sampled_from(KNOWN), inside).map(lambda p: p[0](p[1])),
        inside.map(lambda e: sympy.sqrt(e**2 + 1) ** 3),
    )


@settings(max_examples=150, deadline=None)
@given(st.recursive(st.one_of(leaves, st.just(sympy.pi)), functions, max_leaves=6))
def test_functions_have_their_values(e):
    """To 40 of 60 digits, where the value is real, and so are all on the way."""
    with mpmath.workdps(60):
        inner = [y.subs(AT).evalf(60) for y in sympy.preorder_traversal(e)]
        assume(all(y.is_real and y.is_finite and abs(y) < 1000 for y in inner))
        number = {name: mpmath.mpf(q.numerator) / q.denominator for name, q in NAMED.items()}
        found = value(
            in_grammar(e),
            {"π": mpmath.pi},
            number,
            lambda name, z: getattr(mpmath, name)(z),
            lambda q: mpmath.mpf(Fraction(q).numerator) / Fraction(q).denominator,
        )
        assert abs(found - mpmath.mpf(str(inner[0]))) < mpmath.mpf(10) ** -40 * (1 + abs(found))


@settings(deadline=None)
@given(st.floats(allow_nan=False, allow_infinity=False).filter(lambda y: y == 0 or abs(y) > 1e-290))
def test_a_float_is_the_float_that_it_is(y):
    assume(abs(y) < 1e290)
    assert float(value(in_grammar(sympy.Float(y)), {})) == y
    assert float(value(in_grammar(sympy.Float(y) * a), {}, {"a": Fraction(1)})) == y


def test_a_fraction_is_in_parentheses_under_a_power():
    power = sympy.Pow(sympy.Rational(2, 3), 3, evaluate=False)
    assert value(in_grammar(power), {}) == Fraction(8, 27)


def of(U):
    body = derive.Points((1, [1, 0]), (2, [0, 1]))
    return derive.Problem("pair", derive.SL(2), body, [derive.Potential(U)], {"k": 1})


NO_EXPRESSIONS = {
    "unknown function f": sympy.Function("f")(x),
    "unknown function asin": sympy.asin(x),
    "is not evaluated; hand in what its .doit": sympy.Integral(sympy.exp(x**2), x),
    "complex": sympy.I * x,
    "'b' is not declared": b * x,
    "the power r1_x": sympy.cbrt(x),
    "no finite number": sympy.oo * sympy.Symbol("p", positive=True),
    "no name here": sympy.Symbol("2*k") * x,
    "the number π": sympy.Symbol("pi") * x,
    "Dummy": sympy.Dummy("k") * x,
    "EulerGamma": sympy.EulerGamma * x,
    "true or false": sympy.Eq(x, 1),
    "stands for a matrix": sympy.MatrixSymbol("A", 2, 2),
    "has no meaning": sympy.MatrixSymbol("A", 2, 2)[0, 0] * x,
}


@pytest.mark.parametrize("said", NO_EXPRESSIONS)
def test_what_has_no_meaning_is_one_line(said):
    with pytest.raises(ProblemError, match=r"U'?: ") as error:
        of(NO_EXPRESSIONS[said])
    assert said in str(error.value)
    assert "\n" not in str(error.value)


def test_deep_expressions_are_refused():
    deep = x
    for _ in range(200):
        deep = sympy.sin(deep)
    with pytest.raises(ProblemError, match="nested deeper"):
        of(deep)


def same(one, other):
    one, other = derive.derive(one), derive.derive(other)
    assert one.record == other.record


def test_points_and_forces():
    k, g, t = sympy.symbols("k g t")
    bodies = [
        derive.Points((1, sympy.Matrix([1, 0])), (sympy.Rational(5, 2), [0, a])),
        derive.Points((1, [1, 0]), ("5/2", [0, "a"])),
    ]
    forces = [
        [
            derive.Spring(sympy.Integer(1), 2, k, length=a / 2),
            derive.Gravity(0, -g),
            derive.Potential(sympy.sin(t) * x),
            derive.Force("F", on=sympy.Matrix([a, 0])),
        ],
        [
            derive.Spring(1, 2, "k", length="1/2*a"),
            derive.Gravity(0, "-g"),
            derive.Potential("r1_x*sin(t)"),
            derive.Force("F", on=["a", 0]),
        ],
    ]
    parameters = [
        {
            a: sympy.Rational(3, 2),
            k: sympy.sqrt(2),
            g: {"default": sympy.Float(9.81), "unit": "m/s^2"},
        },
        {"a": 1.5, "k": 2**0.5, "g": {"default": 9.81, "unit": "m/s^2"}},
    ]
    same(
        *(
            derive.Problem("pair", derive.SL(2), *rest)
            for rest in zip(bodies, forces, parameters, strict=True)
        )
    )


def test_lagrangians_moments_and_a_basis():
    z, k = sympy.symbols("zeta_1:4"), sympy.Symbol("k")
    L = k * sympy.Symbol("A_33") * sympy.prod(y**2 for y in z)
    text = "A_33*k*zeta_1^2*zeta_2^2*zeta_3^2"
    own = [derive.Lagrangian(y) for y in (L, text)]
    own += [derive.Inertia(sympy.diag(1, k, 3), momentum=sympy.Matrix([0, 0, k]))]
    own += [derive.Inertia([[1, 0, 0], [0, "k", 0], [0, 0, 3]], momentum=[0, 0, "k"])]
    problems = [derive.Problem("top", derive.SO(3), y, parameters={"k": 2}) for y in own]
    for one, other in (problems[:2], problems[2:]):
        assert one.lagrangian == other.lagrangian
    J = sympy.Matrix([[2, a, 0], [a, 3, 0], [0, 0, 4]])
    given_as = [
        {"m": 1, "c": [0, 0, 0], "J": y} for y in (J, [[2, "a", 0], ["a", 3, 0], [0, 0, 4]])
    ]
    same(
        *(derive.Problem("s", "SO(3)", derive.Moments(**y), parameters={"a": 1}) for y in given_as)
    )
    turn = derive.Group("Turn", [sympy.Matrix([[0, -1], [1, 0]]) / 2])
    same(
        *(
            derive.Problem("turn", g, derive.Points((1, [1, 0])))
            for g in (turn, derive.Group("Turn", [[[0, "-1/2"], ["1/2", 0]]]))
        )
    )


def test_parameters():
    def one(parameters, k="k"):
        body = derive.Points((1, [1, 0]), (2, [0, 1]))
        return derive.Problem("pair", derive.SL(2), body, [derive.Spring(1, 2, k)], parameters)

    assert one({"k": sympy.pi / 2}).parameters["k"].default == pytest.approx(1.5707963267948966)
    for wrong in (a, sympy.I, sympy.nan):
        with pytest.raises(ProblemError, match=r"parameter 'k': .* is no number"):
            one({"k": wrong})
    with pytest.raises(ProblemError, match="no name here"):
        one({sympy.Symbol("é"): 1})


def test_sympy_is_not_imported():
    program = (
        "import sys, derive\n"
        "body = derive.Points((1, [1, 0]), (2, [0, 'a']))\n"
        "derive.Problem('pair', derive.SL(2), body, [derive.Gravity(0, -9.81)], {'a': 1})\n"
        "assert 'sympy' not in sys.modules\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
