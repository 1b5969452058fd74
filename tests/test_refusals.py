"""Every refusal of a problem file says where and why: those that no other test brings about."""

import json
import re
import tomllib
from dataclasses import replace

import pytest

from derive.code.options import Options
from derive.mechanics.problem import ProblemError
from derive.mechanics.toml import problem_of
from derive.record.arithmetic import EvaluationError
from derive.record.check import Checker
from derive.record.record import Equation, RecordError, from_json, to_json
from tests.walks import record

HEAD = 'name = "test"\ngroup = "{}"\n'
POINTS = "".join(f"[[point]]\nmass = 1\nat = {[int(i == j) for j in range(3)]}\n" for i in range(3))
BODY = '[body]\nmoments = "symbolic"\n'
BOX = '[[solid]]\nkind = "box"\ndensity = 1\nsides = [1, 1, 1]\n'
GIVEN = "[body]\ngiven = {{ m = 1, c = [0, 0, 0], {} }}\n"
ONE = "[1, 0, 0], [0, 1, 0], [0, 0, 1]"
PRODUCT = "SO(3) x SO(2)"
MIXED = POINTS + "[[point]]\nmass = 1\nat = [1, 0]\nblock = 2\n"
ANY = 'name = "test"\ngroup = "any"\naction = "linear"\n'


def potential(text):
    return f"[[potential]]\n{text}\n"


CASES = [
    ("any", ANY + BODY, "has no body of its own"),
    ("any", ANY + potential('kind = "gravity"\ng = [1, 0, 0]'), "no potential of its own"),
    ("any", ANY + '[[input]]\nname = "F"\nkind = "force"\non = 1', "no points to push"),
    ("any", ANY + "[[damping]]\ncoefficient = 1\nat = [1, 0, 0]", "no points to damp"),
    ("SO(3)", BODY + BOX, "either one table .body. or the tables ..solid.."),
    (PRODUCT, BODY, "a product moves ..point.. tables alone"),
    ("SO(3)", POINTS + BODY, "either ..point.. tables or moments"),
    ("SO(4)", BOX, "a solid is in R.3, and SO.4. moves points of R.4"),
    ("SO(3)", GIVEN.format(f"J = [{ONE}], I = [{ONE}]"), "give J, or in R.3 the tensor"),
    ("SO(3)", GIVEN.format("J = [[1, 0, 0]]"), "J: expected a list of 3 rows"),
    ("SO(3)", BOX + "rotation = 1", "axis, angle . or a list of 3 rows"),
    ("SO(3)", BOX + "rotation = [1, 2, 3]", "3 rows of 3 numbers"),
    ("SO(3)", BOX + 'rotation = [["pi", 0, 0], [0, 1, 0], [0, 0, 1]]', "must be numbers"),
    ("SO(3)", '[[solid]]\nkind = "tetrahedron"\ndensity = 1\nvertices = [1]', "a list of 4 points"),
    ("SO(3)", "", "no body: give"),
    ("SO(3)", 'action = "affine"\n' + POINTS, "'action' belongs into|acts by linear maps"),
    ("SO(3)", "parameters = 1\n" + POINTS, "'parameters' must be a table"),
    ("SO(3)", POINTS + "[parameters]\nk = [1]", "expected a number or a table"),
    ("SO(3)", POINTS + '[parameters]\nk = { default = "1" }', "'default' must be a number"),
    ("SO(3)", POINTS + "[parameters]\n" + "".join(f"k{i} = 1\n" for i in range(5000)), "more than"),
    ("SO(3)", "[[point]]\nmass = 1\nat = [1, 0, 0]\n" * 3000, "more than .* give their moments"),
    ("SO(3)", BODY + '[[input]]\nname = "F"\nkind = "force"\non = 1', "to number"),
    ("SO(3)", POINTS + '[[input]]\nname = "F"\nkind = "force"\non = 1\nat = [1, 0, 0]', "'on' or"),
    (PRODUCT, MIXED + potential('kind = "gravity"\ng = [1, 0, 0]'), "blocks of one dimension"),
    ("SO(3)", BODY + potential('kind = "attraction"\nstrength = 1'), "attraction needs a body"),
    (PRODUCT, MIXED + potential('kind = "attraction"\nstrength = 1'), "attraction needs blocks"),
    (
        "SO(3)",
        POINTS + potential('kind = "spring"\nstiffness = 1\nbetween = [1, 2]\nanchor = [1, 0, 0]'),
        "either 'between' or an end",
    ),
    ("SO(3)", POINTS + potential('kind = "spring"\nstiffness = 1\nbetween = [1]'), "two points"),
    (PRODUCT, MIXED + potential('kind = "spring"\nstiffness = 1\nbetween = [1, 4]'), "two dimens"),
    ("SO(3)", BODY + potential('kind = "expression"\nU = "r1_x"'), "no ..point.. tables to number"),
    ("SO(3)", BODY + "[[damping]]\ncoefficient = 1", "give a place of the body under 'at'"),
]


@pytest.mark.parametrize(("group", "text", "reason"), CASES, ids=[x[2] for x in CASES])
def test_a_problem_is_refused(group, text, reason):
    head = "" if text.startswith("name") else HEAD.format(group)
    with pytest.raises(ProblemError, match=reason):
        problem_of(tomllib.loads(head + text))


BASES = [
    ("basis = 1", "must list at most"),
    (f"basis = [{[[0] * 20] * 20}]", "larger than"),
]


@pytest.mark.parametrize(("basis", "reason"), BASES)
def test_a_basis_is_refused(basis, reason):
    with pytest.raises(ProblemError, match=reason):
        problem_of(tomllib.loads(f'name = "test"\n{POINTS}[group]\nname = "Own"\n{basis}\n'))


def test_options_are_refused():
    with pytest.raises(ValueError, match="layout must be one of"):
        Options(layout="diagonal")
    with pytest.raises(ValueError, match="jacobian must be among"):
        Options(jacobian="time")
    assert Options(jacobian="state").jacobian == ("state",)


SIDES = [
    ("J", 2, "do not add"),
    (("tr", ("mul", "ζ", ("T", "c"))), 0, "differ"),
    (("tr", "c"), 0, "trace of a matrix that is not square"),
    (("inner", "t", "c"), 0, "inner product of a scalar and a matrix"),
    (("inner", "t", "t"), 0, "differ"),
    (("inv", ("matrix", ("row", 1, 1), ("row", 1, 1))), 0, "singular"),
    (("entry", "t", 1), 0, "entries of matrices and vectors"),
    (("at", "q", 1), 0, "no member"),
    (("at", "q", "i"), 0, "no members of"),
    (("call", "g", "t"), 0, "no function"),
]


@pytest.mark.parametrize(("lhs", "rhs", "reason"), SIDES, ids=str)
def test_a_claim_without_meaning_is_refused(lhs, rhs, reason):
    d = record("so3")
    sides = ("add", lhs, rhs) if reason == "do not add" else lhs
    step = replace(d["so3.euler"], equations=(Equation(sides, rhs),))
    verdict = Checker(d.problem).check(step)
    assert not verdict.holds
    assert re.search(reason, verdict.reason), verdict.reason


SPRING = {"kind": "spring", "stiffness": 1, "length": 0, "between": [1, 2]}


def test_a_record_of_another_shape_is_refused():
    for change, reason in (
        (lambda p: p.update(potentials=[SPRING | {"between": [1]}]), "'between' must be two"),
        (lambda p: p.update(basis=[[["0"]]] * 5000), "more than"),
        (lambda p: p["body"].update(kind="given", given={"m": 1, "c": [0], "J": []}), "expected"),
    ):
        data = json.loads(to_json(record("so3")))
        change(data["problem"])
        with pytest.raises((RecordError, EvaluationError), match=reason):
            from_json(json.dumps(data))
