"""What a record tells of integrals: checked without brackets, refused where it is false; problems
whose integrals are not searched, in one line."""

import json
import re

import pytest

from derive import first_integrals
from derive.check.checker import check
from derive.command.cli import main
from derive.language.limits import LISTENER
from derive.language.tree import neg, replaced
from derive.problem.toml import load, problem_of
from derive.record.as_json import decode, encode, from_json, to_json
from derive.record.sentence import english
from derive.search.integrals import all_integrals, integral_steps
from derive.search.integrals.all_integrals import found
from derive.search.integrals.degree_search import TooLargeError
from derive.search.integrals.reduced import NotReducedError, reduced
from tests.support.corpus import LEVEL
from tests.support.lagrangians import lagrangian
from tests.support.walks import SEED


def refused(found, label, place, change):
    """The labels that are refused once the argument of d/dt in an equation is changed."""
    data = json.loads(to_json(found.record))
    step = next(s for s in data["steps"] if s["label"] == label)
    side = step["equations"][place]
    _, head, argument = decode(side["lhs"], "")
    side["lhs"] = encode(("call", head, change(argument)))
    return [v.label for v in check(from_json(json.dumps(data)), SEED) if not v.holds]


PI_1 = ("at", "Π", 1)
CHANGES = {
    "a coefficient": lambda t: ("add", *t[1:-1], neg(t[-1])),
    "a term": lambda t: ("add", *t[1:], ("pow", PI_1, 4)),
    "a place": lambda t: replaced(t, PI_1, ("at", "Π", 3)),
    "an entry": lambda t: replaced(t, ("entry", "A", 3, 1), ("entry", "A", 1, 3)),
    "a function": lambda t: ("fun", "sin", t),
    "a variation": lambda t: ("add", t, "δt"),
    "a division": lambda t: ("div", t, PI_1),
    "a form": lambda t: ("call", "ϖ", "δy"),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_false_integral_is_refused(change):
    found = first_integrals("kovalevskaya_top")
    label = "kovalevskaya_top.first_integrals"
    assert label in refused(found, label, 1, CHANGES[change])


def test_a_false_casimir_and_a_false_level_are_refused():
    found = first_integrals(LEVEL, 3)
    assert "x.casimirs" in refused(found, "x.casimirs", 0, CHANGES["a coefficient"])
    assert "x.level" in refused(found, "x.level", 0, CHANGES["a coefficient"])


def test_a_false_rate_is_refused():
    data = json.loads(to_json(first_integrals("lagrange_top", 1).record))
    step = next(s for s in data["steps"] if s["label"] == "lagrange_top.poisson")
    rate = step["equations"][1]
    rate["rhs"] = encode(("mul", 2, decode(rate["rhs"], "")))
    verdicts = check(from_json(json.dumps(data)), SEED)
    wrong = [v.label for v in verdicts if not v.holds]
    assert wrong == ["lagrange_top.poisson", "lagrange_top.first_integrals"]  # what it claims, too


def test_one_integral_is_told_as_one():
    """Of a ball the energy is the Casimir, and one more integral is enough."""
    d = first_integrals(lagrangian("zeta_1^2 + zeta_2^2 + zeta_3^2"), 2).record
    said = " ".join(english(s.prose) for s in d.steps)
    assert "and the integral of number 2 is independent of the Casimirs" in said
    assert "of numbers" not in said


def test_at_the_defaults_the_command_has_their_numbers(capsys):
    assert main(["integrals", "lagrange_top", "--at-defaults", "--format", "markdown"]) == 0
    assert r"\mathsf{I}" not in capsys.readouterr().out


SQUARE = "zeta_1^2 + zeta_2^2 + zeta_3^2"
LAGRANGIANS = {
    "the time": (SQUARE + " - t*A_33", "depends on the time"),
    "a metric that changes": ("(2 + A_33)*zeta_1^2 + zeta_2^2 + zeta_3^2", "depends on g"),
    "a fourth power": (SQUARE + " + zeta_1^4", "is not quadratic"),
    "a cube": (SQUARE + " + zeta_1^2*zeta_2", "is not quadratic"),
    "a function": (SQUARE + " - sin(A_33)", "a function, sin"),
    "a quotient": (SQUARE + " - 1/(2 + A_33)", "is no polynomial"),
    "a negative power": (SQUARE + " - (2 + A_33)^-2", "is no polynomial"),
}


@pytest.mark.parametrize("name", LAGRANGIANS)
def test_a_lagrangian(name):
    L, said = LAGRANGIANS[name]
    with pytest.raises(NotReducedError, match=said) as error:
        reduced(lagrangian(L))
    assert "\n" not in str(error.value)


def test_a_degree_that_is_too_large():
    with pytest.raises(TooLargeError, match="unknowns; at most"):
        found(reduced(lagrangian(SQUARE, parameters="")), 2000)


def test_a_group_with_too_many_variables():
    with pytest.raises(NotReducedError, match="variables in the reduced equations; at most"):
        reduced(problem_of({"name": "x", "group": "GL(7)", "lagrangian": {"L": squares(49)}}))


def squares(n):
    return " + ".join(f"zeta_{a}^2" for a in range(1, n + 1))


WIDE = (
    "zeta_1^2 + 2*zeta_2^2 + 3/2*zeta_3^2 + zeta_4^2 + zeta_5^2/2 + 3*zeta_6^2 + zeta_1*zeta_5/3"
    " + zeta_1*zeta_2/5 + zeta_2*zeta_3/7 + zeta_1*zeta_4/4 + zeta_3*zeta_6/2 + zeta_2*zeta_4/9"
    " - 2*T_3 - A_33*T_2 - A_31*A_22 - T_3^2 - A_31 - A_23*T_3"
)


def test_a_degree_that_code_does_not_wait_for(tmp_path, capsys):
    """Two rows of an element of SE(3), of 14 variables: degree 4 has thousands of monomials."""
    path = tmp_path / "wide.toml"
    path.write_text(f'name = "wide"\ngroup = "SE(3)"\n[lagrangian]\nL = "{WIDE}"\n')
    assert main(["emit", str(path), "--conserved", "--out", str(tmp_path)]) == 0
    first, *others = capsys.readouterr().err.splitlines()
    assert re.fullmatch(
        r"derive: note: wide: integrals of degree 4 are not sought, \d{4} unknowns in one linear "
        "system; derive integrals seeks them",
        first,
    )
    assert not others
    told = []
    before = LISTENER.set(told.append)
    assert [*integral_steps.first_integrals(load(path))] == [
        "energy",
        *(f"casimir_{k}" for k in range(1, 5)),
    ]
    LISTENER.reset(before)
    assert [x.partition(",")[0] for x in told] == ["wide: integrals of degree 4 are not sought"]


def test_a_word_while_it_works(monkeypatch, capsys):
    monkeypatch.setattr(all_integrals, "LONG", 10)
    assert main(["integrals", "lagrange_top"]) == 0
    told = capsys.readouterr().err.splitlines()
    assert re.fullmatch(
        r"derive: note: Casimirs of degree \d are sought: \d\d unknowns in one linear system",
        told[0],
    )
    assert any(x.startswith("derive: note: integrals of degree 4 are sought: ") for x in told)


@pytest.mark.parametrize(
    ("L", "group", "said"),
    [
        ("(zeta_1^2 + zeta_2^2 + 3*zeta_3^2)/2 - A_13^2 - A_23^2", "SO(3)", True),
        ("(zeta_1^2 + zeta_2^2)/2 - T_1^4 - T_2^4", "R(2)", False),
        ("(zeta_1^2 + zeta_2^2 + 3*zeta_3^2)/2", "SO(3)", False),
    ],
)
def test_that_relations_of_the_group_are_not_used_is_said_where_there_are_some(L, group, said):
    """A₁₃² + A₂₃² is 1 − A₃₃² on SO(3), where the momentum about axis 3 of space is kept."""
    reduced = next(
        s for s in first_integrals(lagrangian(L, group)).record.steps if s.rule == "reduction"
    )
    assert ("by the relations of the group" in english(reduced.prose)) == said
