"""Letters for wide sums: the equations say the same, and each fits the text."""

import math

from derive.language.tree import replaced
from derive.lecture.displays import WIDTH, NamedSums, blocks, sides
from derive.lecture.lecture_text import tree
from derive.lecture.problem_exercises import between
from derive.lecture.search_sentences import WORDS, retold
from derive.record.record import Equation
from derive.record.sentence import Sentence
from derive.views.language import LANGUAGES, language
from derive.views.printing.typeset import measure, plain

LONG = " + ".join(f"‘a_{i}{j}’ A₁{i} A₂{j}" for i in (1, 2, 3) for j in (1, 2, 3))
ROOT = Equation(tree("𝒱"), tree(f"½ ‘k’ (‘l’ − √({LONG}))² + 𝒥₁²/(1 + {LONG})"))
SHORT = Equation("ζ", tree("𝒥₁/(1 + A₁₁)"))


def test_sums_within_roots_and_quotients_have_letters_that_mean_them():
    found = NamedSums(["A", "𝒥"]).equations([ROOT, SHORT])
    first, *letters, last = found
    assert last == SHORT
    assert {e.lhs for e in letters} == {("at", "S", 1), ("at", "S", 2)}
    meant = first.rhs
    for e in letters:
        meant = replaced(meant, e.lhs, e.rhs)
    assert meant == ROOT.rhs
    assert measure(plain(sides(first).tex)) <= WIDTH < measure(plain(sides(ROOT).tex))
    assert "\\sqrt" in plain(sides(first).tex)
    assert "S_{1}" in blocks(found)


def test_a_letter_is_told_once_and_the_same_in_both_languages():
    sums = NamedSums(["S", "S_1"])
    first = sums.equations([ROOT])
    assert sums.equations((ROOT,)) == first
    again = sums.equations([SHORT, ROOT])
    assert {e.lhs for e in first[1:]} == {("at", "N", 1), ("at", "N", 2)}
    assert again == (SHORT, first[0])


def test_no_question_is_asked_of_a_motion_whose_momentum_has_no_number():
    assert between(None, None, {"h̃": 1.0, ("at", "𝒥", 1): math.nan}, None) == {}


def test_how_many_integrals_in_a_word_and_the_last_behind_and():
    equations = [Equation(("call", "d/dt", x), 0) for x in ("h̃", "J", "K")]
    places = (("half", "2"), ("numbers", "1, 2, 3"), ("rank", "4"))
    said = retold(Sentence("{half} of {numbers} at {rank}", places), equations)
    told = {x: language(x).sentence(said) for x in LANGUAGES}
    assert told["en"] == "two of h̃, J and K at 4"
    assert told["fr"] == "deux of h̃, J et K at 4"
    assert {language("fr").word(x) for x in WORDS.values()} == {"deux", "trois", "quatre"}
    assert language("fr").listed(["a"]) == "a"
