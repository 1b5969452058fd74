"""What a step supposes is read and tried: nothing of it can be changed or added; nor of Lagrangians
that no points give."""

import json
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest

from derive.check.checker import Checker, check
from derive.check.lagrangian.lagrangian_model import LagrangianModel
from derive.check.lagrangian.reduced_by_symmetries import concludes_velocity, unforced_velocity
from derive.check.trials.model import Model
from derive.check.trials.phase_point import TangentVector
from derive.language import rational as q
from derive.record.as_json import from_json, to_data, to_json
from derive.record.record import ANY_GROUP, Equation, Hypothesis, RecordError
from tests.support.walks import SEED, record


@cache
def checker(name):
    return Checker(record(name).problem, SEED)


def told(name, label, **changes):
    step = replace(record(name)[label], **changes)
    return checker(name).check(step)


METRIC = ("metric", "J", "δ′A", "δA")
UNTRUE = {
    "no metric": ("linear.gradient", Hypothesis("nondegenerate", ("inner", "δA", "δ′A"), "T_g G")),
    "another space": ("linear.gradient", Hypothesis("nondegenerate", METRIC, "𝔤")),
    "no form": ("linear.gradient", Hypothesis("nondegenerate", "m", "T_g G")),
    "a number": ("so3.euler", Hypothesis("nonzero", "I")),
    "zero": ("so3.euler", Hypothesis("nonzero", ("add", "m", ("mul", -1, "m")))),
    "not positive": ("so3.euler", Hypothesis("positive", ("mul", -1, "m"))),
    "singular": ("so3.euler", Hypothesis("invertible", ("mul", "c", ("T", "c")))),
    "not symmetric": ("so3.euler", Hypothesis("semidefinite", ("hat", "c"))),
    "some members": ("so3.euler", Hypothesis("positive", ("entry", "c", "i"))),
    "no name": ("so3.euler", Hypothesis("positive", "Q")),
    "no head": ("so3.euler", Hypothesis("positive", ("call", ("mul", -1, "L"), "t"))),
    "too large": ("so3.euler", Hypothesis("positive", ("pow", ("pow", 777, 64), 64**3))),
}


@pytest.mark.parametrize("case", UNTRUE)
def test_a_hypothesis_that_is_not_so_is_refused(case):
    label, wrong = UNTRUE[case]
    step = record("so3")[label]
    found = told("so3", label, hypotheses=(*step.hypotheses, wrong))
    assert not found.holds
    assert "the sides differ" not in found.reason
    assert "\n" not in found.reason


def on_a_line():
    """The record of another body for one on a line through the fixed point."""
    data = json.loads(json.dumps(to_data(record("so3"))))
    points = [{"mass": m, "at": [0, 0, z], "block": 1} for m, z in ((1, 1), (2, 3))]
    data["problem"]["body"] = {"kind": "points", "points": points}
    return data


def test_a_tensor_that_has_no_inverse_is_refused():
    found = {v.label: v for v in check(from_json(json.dumps(on_a_line())), 1)}
    for label in ("so3.second_order", "so3.euler", "so3.motion"):
        assert "singular" in found[label].reason


UNKNOWN = {
    "another number": Equation("δt", 2),
    "a variation": Equation("δA", 0),
    "half of it": Equation("δ′α", 0),
    "another velocity": Equation(("call", "δA", "X"), ("mul", 2, "α")),
    "another part": Equation(("call", "δA", "X"), "Z"),
    "a statement": Equation("J", ("one",)),
    "moments in another order": Equation("I", ("matrix", ("row", ("entry", "λ", 2), 0, 0))),
}


@pytest.mark.parametrize("case", UNKNOWN)
@pytest.mark.parametrize("label", ["linear.vertical", "linear.second_order"])
def test_what_cannot_be_tried_is_not_given(label, case):
    step = record("so3")[label]
    found = told("so3", label, given=(*step.given, UNKNOWN[case]))
    assert not found.holds
    assert "is not one that can be tried" in found.reason


@pytest.mark.parametrize("x", [Equation("Ω′", 0), Equation("δ′T", 0), Equation("η′", 0)])
def test_what_is_given_of_a_group_that_has_it_not(x):
    given = record("sl3")["linear.vertical"].given
    for more in ((*given, x), (x, *given)):
        found = told("sl3", "linear.vertical", given=more)
        assert not found.holds
        assert "cannot be tried" in found.reason


EXISTS = {
    "no multiplier": ("sl3.motion", 3, ("Ż",), "is no multiplier"),
    "not there": ("sl3.motion", 0, ("θ",), "it says nothing of θ"),
    "twice": ("sl3.multiplier", 0, ("θ", "θ"), "it says nothing of θ"),
}


@pytest.mark.parametrize("case", EXISTS)
def test_what_is_not_found_is_not_said_to_exist(case):
    label, k, names, why = EXISTS[case]
    step = record("sl3")[label]
    k = min(k, len(step.equations) - 1)
    changed = replace(step.equations[k], exists=names)
    found = told("sl3", label, equations=(*step.equations[:k], changed, *step.equations[k + 1 :]))
    assert not found.holds
    assert why in found.reason


def test_principal_moments_are_no_multiplier():
    step = record("so3")["so3.principal"]
    changed = replace(step.equations[0], exists=("λ",))
    found = told("so3", "so3.principal", equations=(changed, *step.equations[1:]))
    assert "it is no multiplier" in found.reason


BROKEN = {
    "a phrase": ({"given": ["any X"]}, "expected an object"),
    "given for all": (
        {"given": [{"lhs": "δt", "rhs": 1, "for_all": ["t"]}]},
        "what is given has no quantifiers",
    ),
    "a property": ({"hypotheses": [{"is": "pretty", "of": "I"}]}, "key 'is' must be one of"),
    "of nothing": ({"hypotheses": [{"is": "invertible"}]}, "key 'of' is missing"),
    "a space": (
        {"hypotheses": [{"is": "nondegenerate", "of": "I", "on": "R"}]},
        "key 'on' is of a form",
    ),
    "no space": ({"hypotheses": [{"is": "nondegenerate", "of": "I"}]}, "key 'on' is of a form"),
    "a space of a number": (
        {"hypotheses": [{"is": "nonzero", "of": "m", "on": "𝔤"}]},
        "key 'on' is of a form",
    ),
    "driven by 1": ({"driven": 1}, "key 'driven' must be a bool"),
}


@pytest.mark.parametrize("case", BROKEN)
def test_what_is_no_supposition_is_not_read(case):
    changes, why = BROKEN[case]
    data = json.loads(json.dumps(to_data(record("so3"))))
    data["steps"][-1].update(changes)
    with pytest.raises(RecordError, match=why) as caught:
        from_json(json.dumps(data))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("name", ["linear", "affine"])
def test_the_metric_tells_the_velocity_of_a_vector_of_the_kernel(name):
    """dϖ(X, δ′) = −⟨g⁻¹δg(X) − Z, δ′Z⟩ for a vertical δ′: what is given of X in the next step."""
    step = record(name)[f"{name}.contraction"]
    own = checker(name)
    for g in own.groups(ANY_GROUP):
        model, _ = own.point(g, step, 9)
        away = g.vee(q.minus(model.motion.xi, model.Z))
        still = q.scaled(0, model.Z)
        for row, e in zip(model.metric, g.basis, strict=True):
            found = model.exterior(model.motion, TangentVector(Fraction(0), still, e))
            assert found == -sum(x * y for x, y in zip(row, away, strict=True))


@pytest.mark.parametrize("name", ["so3", "se3", "lagrange_top"])
def test_the_velocity_of_the_motion_is_forced(name, monkeypatch):
    """Where variations of the velocity alone did not see that of X, it would not be."""
    d = record(name)
    steps = [s for s in d.steps if concludes_velocity(s)]
    assert [v for v in map(Checker(d.problem, SEED).check, steps) if not v.holds] == []
    for kind in (Model, LagrangianModel):
        monkeypatch.setattr(kind, "exterior", blind(kind.exterior))
    reasons = [v.reason for v in map(Checker(d.problem, SEED).check, steps)]
    assert len(reasons) >= 1
    assert {*reasons} == {"variations of the velocity do not pair with that of X by the metric"}


def blind(exterior):
    """dϖ without what variations of the velocity alone see."""

    def seen(model, a, b):
        still = b.time == 0 and all(x == 0 for x in q.flatten(b.xi))
        return 0 if still else exterior(model, a, b)

    return seen


def test_a_singular_metric_forces_nothing():
    d = record("rod")
    checker, step = Checker(d.problem, SEED), d["explicit"]
    (group,) = checker.groups(step.scope)
    assert unforced_velocity(checker.point(group, step)[0])


def test_a_degenerate_metric_is_seen():
    """Of a body on a line through the fixed point, where nothing else is wrong with a step."""
    d = from_json(json.dumps(on_a_line()))
    own, step = Checker(d.problem, SEED), d["so3.cartan"]
    assert own.check(step).holds
    regular = Hypothesis("nondegenerate", METRIC, "T_g G")
    assert "false" in own.check(replace(step, hypotheses=(regular,))).reason


def test_another_matrix_with_an_inverse_is_no_metric():
    found = told("so3", "so3.second_order", hypotheses=(Hypothesis("invertible", "J"),))
    assert "it does not suppose that the metric" in found.reason


def refused(name, change, labels):
    """Those of some steps that are refused once the data of a record are changed."""
    data = json.loads(to_json(record(name)))
    change(data)
    d = from_json(json.dumps(data))
    own = Checker(d.problem, SEED)
    return {x for x in labels if not own.check(d[x]).holds}


def step(data, label):
    return next(s for s in data["steps"] if s["label"] == label)


def test_the_other_side():
    """What is said on the left is not so on the right."""

    def turn(data):
        data["problem"]["lagrangian"]["trivialisation"] = "right"

    labels = {f"left.{x}" for x in ("trivialisation", "structure", "coadjoint")}
    labels |= {f"gyrostat.{x}" for x in ("coordinates", "coadjoint", "mass")}
    assert refused("gyrostat", turn, labels) == labels
