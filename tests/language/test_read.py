"""Formulas as they are printed, and their trees: each way is the inverse of the other."""

import random
from fractions import Fraction

import pytest

from derive.language.read import (
    FAMILIES,
    FUNCTIONS,
    IN_THE_BASIS,
    NUMBERED,
    OF_FIELDS,
    FormulaError,
    read,
)
from derive.language.show import FIELD_OPERATORS, in_quotes, show
from derive.language.tree import add, mul, neg, nodes
from derive.record.vocabulary import VOCABULARY
from tests.support.walks import ESTIMATES, NAMES, OTHERS, record


def first(t):
    """Of the trees that print as t does, the one that is read: see the head of ``read``."""
    return 1 if t == ("one",) else _inside(t)


def _inside(t):
    if not isinstance(t, tuple):
        return t
    t = tuple(_inside(x) for x in t)
    if t[0] == "entry" and (name := "_".join(map(str, t[1:]))) in NUMBERED:
        return name
    if t[0] == "pow" and t[2] == -1:
        return ("inv", t[1])
    if t[:2] == ("mul", -1) and len(t) == 3 and t[2][0] == "div":
        return ("div", neg(t[2][1]), t[2][2])
    return t


def trees_of(found):
    """All trees of a record, parameters called like letters of the walk in quotes."""
    for step in found.steps:
        sides = (x for e in (*step.equations, *step.given) for x in (e.lhs, e.rhs))
        for t in (*sides, *(h.of for h in step.hypotheses)):
            yield in_quotes(t, VOCABULARY)


@pytest.mark.parametrize("name", NAMES + OTHERS + ESTIMATES)
def test_all_that_is_printed_is_read(name):
    found = {*trees_of(record(name))}
    parameters = {s[1] for t in found for s in nodes(t) if isinstance(s, tuple) and s[0] == "par"}
    parameters = sorted(x for x in parameters if not x.startswith("‘"))
    for t in found:
        back = read(show(t), *parameters)
        assert back == first(t)
        assert show(back) == show(t)


LETTERS = ["A", "T", "α", "Z", "ξ′", "δA", "δ′Z", "ζ̇", "ℓ_b", "I_c", "Ũ", "h̃", ("hat", "Ω")]
INDEXED = [("at", "r", "i"), ("at", "d", 3), ("at", "E", "a"), ("entry", "J", 1, 2)]
INDEXED += [("entry", "ζ", "a"), ("entry", "ζ̇", 11), ("entry", ("at", "χ", 2), 1)]
CALLED = [("call", "ϖ", "δy"), ("call", ("at", "r", 2), "t"), ("call", "δA", "X")]
GIVEN = [("par", x) for x in ("k", "rho", "x1", "c_1", "J_23")]
LEAVES = [*LETTERS, *INDEXED, *CALLED, *GIVEN]


def tree(draw, depth):
    """A random tree, as those who build them with ``add`` and ``mul`` get it."""
    if not depth or draw.random() < 0.2:
        return draw.choice(LEAVES)
    deeper = [tree(draw, depth - 1) for _ in range(3)]
    a, b, c = deeper
    number = Fraction(draw.randint(-5, 5) or 1, draw.randint(1, 4))
    return draw.choice(
        [
            *[add(a, b, c), add(a, neg(b)), mul(number, a, b), mul(a, b, c), mul(a, b)] * 3,
            *[("T", a), ("inv", a), ("tr", mul(a, b)), ("inner", a, b), ("metric", "J", a, b)],
            *[("wedge", a, b), ("bracket", a, b), ("norm2", a), ("norm2", "I", a)],
            *[("pow", a, 3), ("div", a, mul(2, b)), ("sum", "i", a), ("fun", "sin", a)],
            *[("matrix", ("row", a), ("row", b)), ("call", "∫", a), ("call", "dŨ", a, b)],
        ]
    )


def test_random_trees():
    """What is read is what was printed, but where trees print alike."""
    draw = random.Random("formulas")
    for _ in range(3000):
        t = tree(draw, 3)
        back = read(show(t), *(x for _, x in GIVEN))
        assert back == first(t)
        assert show(back) == show(t)


def test_names_are_read_as_they_stand():
    for name in VOCABULARY.keys() - {"∫"}:
        assert read(name) == name
        assert read(show(("T", name))) == ("T", name)


def test_the_reader_knows_what_the_vocabulary_says():
    def heads(name):
        return [use.type for use in VOCABULARY[name].uses if isinstance(use.type, tuple)]

    families = {x for x in VOCABULARY for t in heads(x) if t[0] == "family"}
    assert families == FAMILIES
    functions = {x for x in VOCABULARY if "function" in {use.role for use in VOCABULARY[x].uses}}
    assert functions - {"r", "∫", *FIELD_OPERATORS, *OF_FIELDS} == FUNCTIONS
    assert {x for x in VOCABULARY if x[-1].isdigit()} == NUMBERED
    assert all(any({"d", "basis"} & {*t} for t in heads(x)) for x in IN_THE_BASIS)


@pytest.mark.parametrize(
    ("text", "as_shown"),
    [
        ("⟨δA − αδt, δ′α − F̃δ′t⟩_J", "⟨δA − α δt, δ′α − F̃ δ′t⟩_J"),
        ("Tr(ξ′ − Zδ′t)J(δZ̄ − f̄δt)", "Tr (ξ′ − Z δ′t) J(δZ̄ − f̄ δt)"),
        ("Σ_i m_ir_i", "Σᵢ mᵢ rᵢ"),
        ("  αr_i+τ ", "α rᵢ + τ"),
        ("A⁻¹δA", "A⁻¹ δA"),
    ],
)
def test_formulas_may_be_written_as_by_hand(text, as_shown):
    assert show(read(text)) == as_shown


@pytest.mark.parametrize(
    ("text", "tree", "other"),
    [
        ("1", 1, ("one",)),
        ("m", "m", ("par", "m")),
        ("F₁", ("at", "F", 1), ("entry", "F", 1)),
        ("m⁻¹", ("inv", "m"), ("pow", "m", -1)),
        ("‖a‖²", ("norm2", "a"), ("pow", ("fun", "sqrt", ("norm2", "a")), 2)),
        ("−a/b", ("div", ("mul", -1, "a"), "b"), ("mul", -1, ("div", "a", "b"))),
    ],
)
def test_where_two_trees_print_alike(text, tree, other):
    assert show(tree) == show(other) == text
    assert read(text) == tree


@pytest.mark.parametrize(
    ("text", "tree"),
    [
        ("d₁₁", ("at", "d", 11)),
        ("(d₁)₁", ("entry", ("at", "d", 1), 1)),
        ("M₁,₁₁", ("entry", "M", 1, 11)),
        ("[a, b]", ("bracket", "a", "b")),
        ("[a, b;]", ("matrix", ("row", "a", "b"))),
        ("Σᵢ a ∧ b", ("sum", "i", ("wedge", "a", "b"))),
        ("(Σᵢ a) ∧ b", ("wedge", ("sum", "i", "a"), "b")),
        ("(a ∧ b)/c", ("div", ("wedge", "a", "b"), "c")),
        ("m |t| m", ("mul", "m", ("fun", "sqrt", ("pow", "t", 2)), "m")),
        (
            "|(m |t|)|",
            ("fun", "sqrt", ("pow", ("mul", "m", ("fun", "sqrt", ("pow", "t", 2))), 2)),
        ),
    ],
)
def test_what_is_printed_apart_is_read_apart(text, tree):
    assert show(tree) == text
    assert read(text) == tree


@pytest.mark.parametrize(
    ("text", "told", "tree"),
    [
        ("ab", (), ("mul", "a", "b")),
        ("ab", ("ab",), ("par", "ab")),
        ("ab", ("b",), ("mul", "a", ("par", "b"))),
        ("c₁ + c₂", ("c_1",), ("add", ("par", "c_1"), ("entry", "c", 2))),
        ("‘m’m", (), ("mul", ("par", "‘m’"), "m")),
        ("k(a + b)", ("k",), ("mul", ("par", "k"), ("add", "a", "b"))),
        ("2m1", (), ("mul", 2, "m", ("one",))),
        ("2 m1", ("m1",), ("mul", 2, ("par", "m1"))),
    ],
)
def test_parameters_are_told(text, told, tree):
    assert read(text, *told) == tree


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("", "a factor is expected at the end"),
        ("a + ", "a factor is expected at the end"),
        ("(a", ") is expected at the end"),
        ("a) b", "the end is expected at )b"),
        ("‖a", "‖ is expected at the end"),
        ("|a", "| is expected at the end"),
        ("[a; b", "] is expected at the end"),
        ("⟨a⟩", ", is expected at ⟩"),
        ("⟨a, b, c⟩", "⟩ is expected at ,c⟩"),
        ("(a, b)", ") is expected at ,b)"),
        ("∫ r", "dm is expected at the end"),
        ("a//b", "a factor is expected at /b"),
    ],
)
def test_what_is_no_formula(text, what):
    with pytest.raises(FormulaError, match=r"^'") as caught:
        read(text)
    assert str(caught.value).endswith(what)
