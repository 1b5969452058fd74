"""What a sentence of a step says by an equation holds where the step does, as the checker finds.

Left are those of which no value is known there, and those that a sentence supposes.
"""

import re
from dataclasses import replace
from itertools import takewhile

from derive.check.checker import checker_of
from derive.language.read import FormulaError, read
from derive.language.tree import neg
from derive.record.record import Equation
from derive.record.sentence import english
from tests.support.walks import FLUIDS, NAMES, OTHERS, SEED, record

SUPPOSED = {
    *("δ′A = α", "δ′T = τ", "δt = 1", "J = 𝟏", "j(ζ) = 0", "ζ = 0", "Ω′ = ζ", "η′ = w", "c = 0"),
    *(
        "δt = 0",
        "ξ′ = E_a",
        "Ż = 0",
        "C = 𝟏",
        "θ = 0",
        "𝐦 + 𝐧 = 0",
        "η′ = u",
        "η = u",
        "δg = Gϑ",
        "δu = 0",
        "Z² = θC⁻¹J⁻¹",
    ),
}
FORMULAS = ("Tr", "det", "Du")
UNKNOWN = r"no value for|says nothing|is of |no index|lists no point|no function|must suppose"


def formula(words):
    """The words up to the first that is one of the language, or a sign ends."""
    found = []
    for word in words:
        if re.fullmatch(r"[A-Za-z]{2,}\W?", word) and word not in FORMULAS:
            break
        found.append(word)
        if word[-1] in ".,;:":
            break
    return found


def stated():
    """Each equation in a sentence, as text and as that of the step, once for each sentence."""
    known = set()
    for name in dict.fromkeys((*NAMES, *OTHERS, *FLUIDS)):
        for step in record(name).steps:
            for sentence in re.split(r"(?<=[.:;])\s", english(step.prose)):
                if (step.label.partition(".")[2], sentence) not in known:
                    known.add((step.label.partition(".")[2], sentence))
                    for text, equation in equations(sentence.split()):
                        yield record(name), step, text, equation


def equations(words):
    for k in (k for k, word in enumerate(words) if word == "="):
        before = [*takewhile(lambda x: x[-1] not in ".,;:", words[:k][::-1])]
        left, right = formula(before)[::-1], formula(words[k + 1 :])
        text = " ".join(left), " ".join(right).rstrip(".,;:")
        try:
            yield " = ".join(text), Equation(*map(read, text))
        except FormulaError:
            continue


def fault(step, equation, checker):
    """Why an equation is not so where a step is; "" where it is."""
    verdict = checker.check(replace(step, equations=(equation,), hypotheses=()))
    return verdict.reason


def test_what_sentences_state_holds():
    wrong, held, checkers = [], set(), {}
    for d, step, text, equation in stated():
        checker = checkers.setdefault(d.name, checker_of(d.problem, SEED))
        why = fault(step, equation, checker)
        if not why:
            held.add(text)
            assert fault(step, replace(equation, rhs=neg(equation.rhs)), checker) or "= 0" in text
        elif text not in SUPPOSED and not re.search(UNKNOWN, why):
            wrong.append(f"{step.label}: {text}: {why}")
    assert wrong == []
    assert len(held) > 10
