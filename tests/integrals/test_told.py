"""What a record tells of integrals: checked without brackets, refused where it is false, and
nothing said that is not proved."""

import json

import pytest

from derive import first_integrals
from derive.check.checker import check
from derive.command.cli import main
from derive.language.tree import neg, replaced
from derive.record.as_json import decode, encode, from_json, to_json
from derive.record.sentence import english
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
