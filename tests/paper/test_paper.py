"""The paper's numbered equations: what is misprinted, and that nothing else is; line by line its
labels are steps, and every numbered line of it has its row."""

import json
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
import sympy

from derive.command.cli import main
from derive.command.showing import ready_made
from derive.language.show import show
from derive.record.record import AMENDED
from derive.views.paper import findings as paper
from derive.views.paper.findings import PAPER, VERDICTS
from derive.views.text import text
from tests.support.walks import record


@cache
def findings():
    return {f.number: f for f in paper.compare([record(name) for name in paper.PROBLEMS])}


def test_all_numbers():
    assert list(findings()) == list(range(1, 40))
    assert [p.number for p in PAPER] == list(range(1, 40))


def test_verdicts():
    found = {v: {n for n, f in findings().items() if f.verdict == v} for v in VERDICTS}
    assert found["misprint"] == {20, 29, 31, 32}
    assert found["sign convention"] == {25, 26}
    assert found["omission"] == {35}
    assert found["misprint"] | found["sign convention"] | found["omission"] == AMENDED
    assert sum(map(len, found.values())) == len(PAPER)
    for p in PAPER:
        if not p.claim:
            assert findings()[p.number].verdict == "definition"


@pytest.mark.parametrize("number", sorted(AMENDED))
def test_misprints_have_a_correction_and_a_counterexample(number):
    f = findings()[number]
    assert f.derived
    assert f.remark
    left, right = list(f.counterexample.values())[-2:]
    assert left != right


def with_equations(number, change):
    """A print with other right sides, and what becomes of it."""
    p = PAPER[number - 1]
    p = replace(p, means=",  ".join(f"{show(e.lhs)} = {show(change(e.rhs))}" for e in p.equations))
    return "confirmed" if all(paper.holds(p, e) for e in p.equations) else paper._cause(p)


def test_the_verdict_is_found():
    """Other prints of the same equations: the number does not decide what is said of them."""
    from derive.language.tree import mul, neg

    assert with_equations(25, neg) == "confirmed"
    assert with_equations(25, lambda t: mul(2, t)) == "misprint"
    assert with_equations(29, lambda t: neg(CORRECTIONS[29](t))) == "sign convention"
    assert (
        with_equations(29, lambda t: replace_all(CORRECTIONS[29](t), "f", ("mul", 0, "f")))
        == "omission"
    )
    assert with_equations(31, CORRECTIONS[31]) == "confirmed"
    assert with_equations(35, lambda t: mul(2, t)) == "misprint"
    assert with_equations(32, neg) == "confirmed"
    assert with_equations(32, lambda t: "J") == "misprint"


CORRECTIONS = {
    20: lambda t: replace_all(t, ("mul", "τ", ("T", "c")), ("mul", "c", ("T", "τ"))),
    29: lambda t: replace_all(replace_all(t, "f′", "f"), "δ′Z", ("T", "δ′Z")),
    31: lambda t: replace_all(t, "φ′", "φ"),
}


def replace_all(t, old, new):
    if t == old:
        return new
    return tuple(replace_all(x, old, new) for x in t) if isinstance(t, tuple) else t


def corrected(p, e):
    from derive.language.tree import add, neg
    from derive.record.record import Equation

    if p.number in (25, 26, 32):
        return Equation(e.lhs, neg(e.rhs))
    if p.number == 35:
        return Equation(e.lhs, add(("entry", "φ", e.lhs[2]), e.rhs))
    return Equation(e.lhs, CORRECTIONS[p.number](e.rhs))


@pytest.mark.parametrize("number", sorted(AMENDED))
def test_the_print_with_the_misprint_mended_holds(number):
    """Each misprint is exactly what the remark says: mending it makes the print true."""
    p = PAPER[number - 1]
    assert any(not paper.holds(p, e) for e in p.equations)
    assert all(paper.holds(p, corrected(p, e)) for e in p.equations)


def test_the_two_signs_contradict_each_other():
    """(25) against (29) with its bars mended: one of them has the wrong sign, whatever dϖ is."""
    from derive.check.values.evaluate import evaluate

    p25, p29 = PAPER[24], PAPER[28]
    env = paper.point(p29, 9, 1)
    a = evaluate(p25.equations[0].rhs, env)
    b = evaluate(corrected(p29, p29.equations[0]).rhs, env)
    assert a == -b != 0


def test_json(capsys):
    assert main(["paper", "--format", "json"]) == 0
    data = json.loads(capsys.readouterr().out)
    assert [x["number"] for x in data] == list(range(1, 40))
    keys = {"number", "verdict", "printed", "derived", "holds", "counterexample"}
    assert all(keys <= set(x) for x in data)
    told = {x["verdict"]: x["holds"] for x in data}
    assert told["omission"] == "where there are no forces"
    assert "−dϖ" in told["sign convention"]
    assert {told[x] for x in ("confirmed", "definition", "misprint")} == {None}


def test_the_views_mark_what_is_misprinted():
    shown = text(record("so3"))
    assert "paper (29)*" in shown
    assert "paper (28)\n" in shown


def test_counterexamples_can_be_followed():
    """Most of their numbers are 0."""
    for f in findings().values():
        if f.counterexample:
            found = [x for v in f.counterexample.values() for x in re.findall(r"[-\d/]+", v)]
            assert sum(x != "0" for x in found) <= 14, f.number


def moments_of(example):
    """J of a counterexample, from its tensor of inertia or principal moments where it has those."""
    if "λ" in example:
        λ = sympy.diag(*map(sympy.Rational, example["λ"].strip("[]").split(";")))
        return λ.trace() / 2 * sympy.eye(3) - λ
    rows = example["J" if "J" in example else "I"].strip("[]").split(";")
    given = sympy.Matrix([[sympy.Rational(x.strip()) for x in row.split(",")] for row in rows])
    return given if "J" in example else given.trace() / 2 * sympy.eye(3) - given


@pytest.mark.parametrize("number", sorted(AMENDED))
def test_the_body_of_a_counterexample_is_one_of_the_paper(number):
    """Before (22) it has J positive definite."""
    J = moments_of(findings()[number].counterexample)
    assert J == J.T
    assert J.is_positive_definite


def test_31_holds_with_the_force_in_place_of_its_prime():
    p = next(p for p in PAPER if p.number == 31)

    def unprimed(t):
        return "φ" if t == "φ′" else tuple(map(unprimed, t)) if isinstance(t, tuple) else t

    (printed,) = p.equations
    assert not paper.holds(p, printed)
    assert paper.holds(p, replace(printed, rhs=unprimed(printed.rhs)))


TEXT = (Path(__file__).parents[2] / "docs" / "paper.md").read_text(encoding="utf-8")
ROWS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in TEXT.splitlines()
    if line.startswith("|") and not line.startswith(("|-", "| the note"))
]
NUMBERED = {int(first.strip("()")): where for first, _, where in ROWS if first.startswith("(")}
LABEL = re.compile(r"`(\w+)\.(\w+)`")


def steps(where):
    """Those that a row names; of the two actions, the first word names the text about any group."""
    return [record(name)[f"{name}.{step}"] for name, step in LABEL.findall(where)]


def test_every_numbered_line_has_a_row():
    assert [*NUMBERED] == [*range(1, 40)]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0] + row[1])
def test_a_row_names_steps_that_there_are(row):
    names = {name for name, _ in LABEL.findall(row[2])}
    assert names <= {*ready_made()}
    told = [*steps(row[2])]  # KeyError for one that is not there
    assert told or "not walked" in row[2] or "`derive list`" in row[2]


@pytest.mark.parametrize("number", NUMBERED)
def test_a_numbered_row_names_the_steps_that_carry_the_number(number):
    """In the texts that it speaks of, those steps and no others, but for what is said besides."""
    carrying = {
        s.label
        for name, _ in LABEL.findall(NUMBERED[number])
        for s in record(name).steps
        if number in s.paper and s.label.startswith(f"{name}.")
    }
    named = {s.label for s in steps(NUMBERED[number])}
    assert carrying <= named
    assert carrying or number == 4  # the letters of (3), all at once
