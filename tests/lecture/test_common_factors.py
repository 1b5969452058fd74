"""Sums as people write them: equal at some numbers, and in the form that is meant."""

import random

import pytest

from derive.language.show import show
from derive.language.values import approximate
from derive.lecture.common_factors import tidied
from derive.lecture.lecture_text import tree
from derive.record.record import Equation

FORMS = {
    "‘mgl’ − ‘mgl’ A₃₃": "mgl·(1 − A₃₃)",
    "½ ‘a1’ ζ₁ ζ₁ + ‘b1’ ζ₁ ζ₄": "½ a1 ζ₁² + b1 ζ₁ ζ₄",
    "‘I1’ ζ_h₁²/2 + ‘I1’ ζ_h₂²/2 + 𝒱": "I1(ζ_h₁² + ζ_h₂²)/2 + 𝒱",
    "(‘a’ − ‘c’) ζ₂ ζ₃ − ‘b’ ζ₂ ζ₆ − ‘b’ ζ₃ ζ₅": "(a − c) ζ₂ ζ₃ − b(ζ₂ ζ₆ + ζ₃ ζ₅)",
    "Π₁²/(2(‘a’ − ‘b’)) − ‘c’ Π₁ Π₂/(‘a’ − ‘b’)": "Π₁(Π₁ − 2c Π₂)/(2(a − b))",
    "½ ‘a’ ζ₁² + ½ ‘b’ ζ₂² + ‘c’ ζ₁ ζ₂": "(a ζ₁² + b ζ₂²)/2 + c ζ₁ ζ₂",
    "‘R’² ‘h’³ ζ₁/5 + ‘R’⁴ ‘h’ ζ₁/20": "R²h ζ₁(4h² + R²)/20",
    "‘R’² ‘h’³ + 4 ‘R’⁴ ‘h’ + ζ₁": "R²h(h² + 4R²) + ζ₁",
}


def filled(t, values):
    if (isinstance(t, tuple) and t[0] in ("at", "entry", "par")) or t in ("𝒱", "π"):
        return values.setdefault(t, random.Random(repr(t)).randint(2, 99))
    return (t[0], *(filled(x, values) for x in t[1:])) if isinstance(t, tuple) else t


@pytest.mark.parametrize("text", FORMS)
def test_a_sum_is_equal_and_shorter(text):
    before, after = tree(text), tidied(Equation("x", tree(text))).rhs
    assert show(after) == FORMS[text]
    values = {}
    first, second = (approximate(filled(t, values), {}) for t in (before, after))
    assert first == pytest.approx(second, rel=1e-12)
    assert len(values) > 1


ORDERED = {
    "‘g’ ‘l’ ‘m’ A₁₂/‘k’": "mgl A₁₂/k",
    "‘l’² ‘m’ ζ₁ ζ₁/2": "ml² ζ₁²/2",
    "‘g’ (‘l’ − ‘m’) A₁₂": "(l − m) g A₁₂",
    "Π₁ ‘l’ π ‘m’": "πml Π₁",
    "(Π₂ A₃₁ ‘l’ − Π₁ A₃₂ ‘l’)/‘g’": "l(Π₂ A₃₁ − Π₁ A₃₂)/g",
}


@pytest.mark.parametrize("text", ORDERED)
def test_parameters_are_first_in_the_order_in_which_they_are_declared(text):
    assert show(tidied(Equation("x", tree(text)), ["m", "g", "l"]).rhs) == ORDERED[text]


@pytest.mark.parametrize("text", ["AZ + BZ", "⟨Ac, γ⟩ − Ũ", "½ Tr αJᾱ − Ũ"])
def test_matrices_keep_their_places(text):
    assert tidied(Equation("x", tree(text))).rhs == tree(text)
