"""Every refusal of a problem file says where and why: those that no other test brings about."""

import json
import re
import tomllib
from dataclasses import replace
from fractions import Fraction
from functools import cache

import numpy as np
import pytest

from derive import SO, Points, Problem, derive
from derive.check.checker import Checker
from derive.code.emit import emit
from derive.code.options import Options
from derive.pipeline import program
from derive.problem.problem import ProblemError
from derive.problem.toml import problem_of
from derive.record.json_reader import from_json
from derive.record.json_writer import to_json
from derive.record.record import Equation, RecordError
from derive.validate.read_c import read_c
from derive.validate.terms import CodeError
from tests.support.walks import SEED, problem, record

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
    (
        "any",
        ANY + potential('kind = "gravity"\ng = [1, 0, 0]'),
        "no points on which this could act",
    ),
    ("any", ANY + '[[input]]\nname = "F"\nkind = "force"\non = 1', "no points on which"),
    ("any", ANY + "[[damping]]\ncoefficient = 1\nat = [1, 0, 0]", "no points on which"),
    ("SO(3)", BODY + BOX, "either one table .body. or the tables ..solid.."),
    (PRODUCT, BODY, "a product moves ..point.. tables alone"),
    ("SO(3)", POINTS + BODY, "either ..point.. tables or moments"),
    ("SO(4)", BOX, "a solid is in R.3, and SO.4. moves points of R.4"),
    ("SO(3)", GIVEN.format(f"J = [{ONE}], I = [{ONE}]"), "give one of J, .* or I, the tensor"),
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
    ('action = "affine"\nbasis = [[[1, 0, 0], [0, 0, 0], [0, 0, 1]]]', "last row of an affine one"),
    ("basis = [[[1]]]", "move points of R.1; from R.2 to R.8 are known$"),
    ('action = "affine"\nbasis = [[[1, 0], [0, 0]]]', 'action = "linear" with the same basis'),
    ("basis = [[[0, 1], [0, 0]], [[0, 0], [1, 0]]]", "not a Lie algebra"),
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
    (("inner", "t", "t"), 0, "numbers have no inner product"),
    (("tr", "m"), "m", "trace of a number"),
    (("T", "m"), "m", "transpose of a number"),
    (("entry", ("T", "c"), "i"), ("T", "c"), "a vector has entries of one index"),
    (("T", "c"), "c", "a 1×3 matrix and a 3×1 matrix"),
    (("add", "Z", ("mul", -1, "Z")), ("add", "t", ("mul", -1, "t")), "a 3×3 matrix and a number"),
    (("mul", "c", "c"), 0, "have no product"),
    (("bracket", "Z", "c"), 0, "have no product"),
    (("div", "t", "c"), 0, "in the place of a number"),
    (("hat", "Z"), 0, "in the place of a vector of space"),
    (("inner", "Z", "c"), 0, "have no inner product"),
    (("matrix", ("row", "c")), 0, "in the place of a number"),
    (("inv", ("matrix", ("row", 1, 1), ("row", 1, 1))), 0, "singular"),
    (("entry", "t", 1), 0, "entries of matrices and vectors"),
    (("at", "q", 1), 0, "no member"),
    (("at", "q", "i"), 0, "no members of"),
    (("call", "q", "t"), 0, "no function"),
]


@pytest.mark.parametrize(("lhs", "rhs", "reason"), SIDES, ids=str)
def test_a_claim_without_meaning_is_refused(lhs, rhs, reason):
    d = record("so3")
    sides = ("add", lhs, rhs) if reason == "do not add" else lhs
    step = replace(d["so3.euler"], equations=(Equation(sides, rhs),))
    verdict = Checker(d.problem, SEED).check(step)
    assert not verdict.holds
    assert re.search(reason, verdict.reason), verdict.reason


SPRING = {"kind": "spring", "stiffness": 1, "length": 0, "between": [1, 2]}


TETRAHEDRON = {"kind": "tetrahedron", "density": 1, "sizes": {"vertices": [[0, 0, 0]]}}
BALL = {"kind": "ball", "density": 1, "sizes": {"side": 1}}
MESH = {"vertices": [[0, 0, 0]], "faces": [[0, 0, 9]]}
BARE = {"m": 1, "c": [0, 0, 0], "J": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}

GIVEN_BODY = {"kind": "given", "given": BARE | {"J": []}, "solids": []}


def of_solid(solid):
    solid |= {"rotation": None, "shift": None}
    return lambda p: p.update(body={"kind": "given", "given": BARE, "solids": [solid]})


SHAPES = [
    (lambda p: p.update(potentials=[SPRING | {"between": [1]}]), "'between' must be two"),
    (lambda p: p.update(basis=[[["0"]]] * 5000), "more than"),
    (
        lambda p: p["body"].update(kind="given", given=BARE | {"J": []}, solids=[]),
        "expected a list of 3 rows",
    ),
    (lambda p: p.update(title="long" * 1000), "longer than"),
    (of_solid(BALL), "the sizes must be radius"),
    (of_solid(TETRAHEDRON), "expected a list of 4 points"),
    (of_solid({"kind": "mesh", "density": 1, "sizes": MESH}), "three numbers of vertices"),
    (of_solid({"kind": "mesh", "density": 1, "sizes": MESH | {"faces": []}}), "no faces"),
]


@pytest.mark.parametrize(("change", "reason"), SHAPES, ids=[x[1] for x in SHAPES])
def test_a_record_of_another_shape_is_refused(change, reason):
    data = json.loads(to_json(record("so3")))
    change(data["problem"])
    with pytest.raises(RecordError, match=reason):
        from_json(json.dumps(data))


@cache
def so3():
    compiled = program(problem("so3"), record("so3"))
    return emit(compiled, record("so3"), ("c", "python"), "so3")


IN_C = [
    ("#include <math.h>", "#include <math.h>\ntypedef int whole;", "Typedef"),
    ("#include <math.h>", "#include <math.h>\nconst double table[] = {1.0};", "Decl"),
    ("#include <math.h>", "#include <math.h>\nenum { other };", "Enumerator"),
    ("#include <math.h>", "#include <math.h>\nenum { other = 0x10 };", "Enumerator"),
    ("#include <math.h>", "#include <math.h>\nenum { other = 'a' };", "a character is not read"),
    ("#include <math.h>", "#include <math.h>\n#if 1\n", "unknown condition|without #endif"),
    ("#include <math.h>", "#include <math.h>\n#ifdef __cplusplus\n", "under a condition"),
    ("#include <math.h>", "#include <math.h>\n#error no\n", "unknown directive"),
    ("const double I_11 =", "const long I_11 =", "TypeDecl"),
    ("const double I_11 =", "const unsigned long I_11 =", "TypeDecl"),
    ("const double I_11 =", "const double *I_11 =", "PtrDecl"),
    ("    k[0] = J_12;\n", "    for (;;) k[0] = J_12;\n", "For"),
    ("    k[0] = J_12;\n", "    if (k) k[0] = J_12;\n", "Assignment"),
    ("    k[0] = J_12;\n", "    k[p] = J_12;\n", "ID in so3.c"),
    ("    k[0] = J_12;\n", "    J_12 = 1.0;\n", "Assignment"),
    ("    k[0] = J_12;\n", "    return;\n", "Return"),
    ("double so3_energy(", "double so3_other(", "not known here"),
    ("    k[0] = J_12;\n", "    k[0] = J_12\n#ifndef __GNUC__\n+ 1.0\n#endif\n;", "under a cond"),
    ("    k[0] = J_12;\n", "    k[0] = J_12 // see\r + 1.0\n;", "'.r' is not read"),
    ("    k[0] = J_12;\n", "    k[0] = J_12 + (50000*50000 - 2500000000.0);\n", "integers"),
    ("    k[0] = J_12;\n", "    k[0*0] = J_12;\n", "BinaryOp"),
    ("    k[0] = J_12;\n", "    static const double a = 1.0;\n    k[0] = a;\n", "Decl"),
    ("#include <math.h>", "#include <math.h>\n#pragma redefine_extname sqrt cbrt", "directive"),
    ("#include <math.h>", "#include <math.h>\n#define y_H\n", "unknown macro"),
    ("#include <math.h>", "#include <math.h>\nint so3_constants();\n", "Decl"),
    ('    "A_11",', '    [0] = "A_11",', "Decl"),
    ('    "A_11",', "    A_11,", "Decl"),
    ("1.0/I_d_3", "sqrt()/I_d_3", "FuncCall"),
    ("u[0*n + s]", "n*1.0", "n stands"),
]


@pytest.mark.parametrize(("old", "new", "reason"), IN_C, ids=[x[1] for x in IN_C])
def test_c_that_is_not_read(old, new, reason):
    text = so3()["so3.c"]
    assert old in text
    with pytest.raises(CodeError, match=reason):
        read_c("so3.c", {**so3(), "so3.c": text.replace(old, new, 1)}, "so3")


def test_a_function_of_c_that_stands_twice():
    text = so3()["so3.c"]
    start = text.index("double so3_energy(")
    with pytest.raises(CodeError, match="stands twice"):
        read_c("so3.c", {**so3(), "so3.c": text + text[start:]}, "so3")


def test_tables_from_python():
    """Arrays, fractions and tuples are what a file has."""
    places = np.array([[Fraction(1, 2), 0, 1], [0, 1, 0], [1, 1, 1]], dtype=object)
    body = Points(*((Fraction(k, 2), tuple(r)) for k, r in enumerate(places, 1)))
    assert derive(Problem("own", SO(3), body)).record["body"].equations
    with pytest.raises(ProblemError, match="expected Points"):
        Problem("own", SO(3), 5)
