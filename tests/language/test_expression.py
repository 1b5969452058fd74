"""The grammar of expressions in problem files, against Python's own arithmetic on fractions; trees
are gone through in one way."""

import math
from fractions import Fraction
from random import Random

import pytest

from derive.check.values.evaluate import Environment, evaluate
from derive.language.derivatives import derivative
from derive.language.expression import ExpressionError, names, parse
from derive.language.tree import fold, mul, nodes, operands, terms
from derive.language.tree import names as names_of
from derive.language.values import approximate

VALUES = {"a": Fraction(3, 7), "b1": Fraction(-5), "c_x": Fraction(11, 2)}
ENV = Environment(3, {}, parameters=VALUES)


def random_text(random, depth):
    """An expression as our text and as Python's."""
    kind = random.randrange(6) if depth else 5
    if kind < 4:
        left, right = (random_text(random, depth - 1) for _ in range(2))
        operator = "+-*/"[kind]
        return tuple(f"({x}){operator}({y})" for x, y in zip(left, right, strict=True))
    if kind == 4:
        ours, python = random_text(random, depth - 1)
        n = random.randint(0, 3)
        return f"({ours})^{n}", f"({python})**{n}"
    name = random.choice([*VALUES, "2", "0.25", "3"])
    return name, name if name in VALUES else f"Fraction('{name}')"


@pytest.mark.parametrize("seed", range(60))
def test_values(seed):
    ours, python = random_text(Random(seed), 4)
    try:
        expected = eval(python, {"Fraction": Fraction}, dict(VALUES))
    except ZeroDivisionError:
        return
    assert evaluate(parse(ours), ENV) == expected


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2 - 3 - 4", -5),
        ("2/3/4", Fraction(1, 6)),
        ("-2^2", -4),
        ("2^-2", Fraction(1, 4)),
        ("--3", 3),
        ("1e3 + .5", Fraction(2001, 2)),
        ("-a", Fraction(-3, 7)),
        (" ( 1 ) ", 1),
        ("2*-3", -6),
    ],
)
def test_precedence(text, value):
    assert evaluate(parse(text), ENV) == value


AT = {"x": (0.3, -1.7, 2.5), "y": (-0.9, 0.4, 2.25)}
WRITTEN = [
    ("abs(x)", abs(AT["x"][1]), 1),
    ("sign(x*y)", -1, 1),
    ("min(x, y)", -1.7, 1),
    ("max(min(x, 1), y - 3)", -1.7, 1),
    ("max(x, y)", 2.5, 2),
    ("hypot(x, 3)", math.hypot(0.3, 3), 0),
    ("hypot(x, 3, 2*x)", math.hypot(0.3, 3, 0.6), 0),
    ("atan2(y, x)", math.atan2(0.4, -1.7), 1),
    ("atan2(y, x)", math.atan2(-0.9, 0.3), 0),
    ("x^(1/2) + x^(-3/2)", 2.5**0.5 + 2.5**-1.5, 2),
]


@pytest.mark.parametrize(("text", "value", "k"), WRITTEN)
def test_functions_that_are_written_out(text, value, k):
    """Their values, and their derivatives by differences."""
    t, at = parse(text), {name: x[k] for name, x in AT.items()}
    assert approximate(t, at) == pytest.approx(value, rel=1e-14)
    for name in at:
        ends = [approximate(t, at | {name: at[name] + h}) for h in (1e-6, -1e-6)]
        slope = approximate(derivative(t, ("par", name)), at)
        assert slope == pytest.approx((ends[0] - ends[1]) / 2e-6, abs=1e-8)


def test_functions_of_numbers_that_are_written_out():
    text = "abs(-3) + 10*sign(-2) + 100*min(2, 3) + 1000*max(2, 3) + 10000*sign(0)"
    assert parse(text) == 3 - 10 + 200 + 3000


def test_names():
    assert names(parse("a*(b1 + a)^2")) == ["a", "b1", "a"]
    assert parse("k") == ("par", "k")
    assert parse("2*3") == mul(2, 3) == 6


@pytest.mark.parametrize(
    "text",
    ["", "1 +", "(1", "1)", "a b", "2a", "1/0", "0^-1", "2^a", "2^65", "2^3^4", "a.b", "f(x)",
     "__import__", "'x'", "a;b", "é", "1" * 41, "(" * 200, "1" + "+1" * 6000, "\x00", "{{ a }}",
     "hypot(a)", "min(a,)", "abs(a, b)", "sqrt(a, b)", "2,5", "a^(1/3)",
     "a^(b/2)", "max(a, b"],
)  # fmt: skip
def test_refused(text):
    with pytest.raises(ExpressionError) as caught:
        parse(text)
    assert 0 < len(str(caught.value)) <= 160  # two lines of a terminal


@pytest.mark.parametrize(
    ("text", "said"),
    [("hypot(a)", "2 expressions or more, not"), ("abs(a, b)", "1 expression, not of 2")],
)
def test_of_how_many_a_function_is(text, said):
    with pytest.raises(ExpressionError, match=said):
        parse(text)


@pytest.mark.parametrize("seed", range(60))
def test_zero_divisors_are_those_of_fractions(seed):
    """An expression is refused where Python divides by zero whatever the names are."""
    ours, python = random_text(Random(f"zero {seed}"), 3)
    ours, python = (
        f"1/({ours} - ({ours}) + {seed % 2})",
        f"1/(({python}) - ({python}) + {seed % 2})",
    )
    zero = []
    for shift in (0, 1):
        try:
            values = {name: x + shift for name, x in VALUES.items()}
            eval(python, {"Fraction": Fraction}, values)
        except ZeroDivisionError:
            zero.append(shift)
    if zero == [0, 1]:
        with pytest.raises(ExpressionError, match="division by zero"):
            parse(ours)
    elif not zero:
        parse(ours)


T = ("add", ("mul", 2, ("par", "k"), ("fun", "sin", "x")), ("pow", ("at", "r", 1), 3), "y")


def test_what_is_a_tree_in_a_tree():
    """Neither the name of a parameter or a function, nor an exponent."""
    assert operands(("par", "k")) == operands("x") == operands(Fraction(1, 2)) == ()
    assert operands(("fun", "sin", "x")) == ("x",)
    assert operands(("pow", "x", 3)) == ("x",)
    assert operands(("div", "x", 3)) == ("x", 3)
    assert terms(T) == T[1:]
    assert terms("x") == ("x",)


def test_a_fold_goes_from_the_leaves_up():
    @fold
    def depth(t, *below):
        return 1 + max(below, default=0)

    @fold
    def size(t, *below):
        return 1 + sum(below)

    assert depth(T) == 4
    assert size(T) == len(nodes(T)) == 11
    assert [*names_of(T)] == ["x", "r", "y"]
