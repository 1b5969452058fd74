"""Every refusal says where and why: of options, claims, records, C."""

import json
import re
from dataclasses import replace
from functools import cache

import pytest

from derive.check.checker import Checker
from derive.code.emit import emit
from derive.programs import program
from derive.record.as_json import from_json, to_json
from derive.record.record import Equation, RecordError
from derive.validate.read_file import read
from derive.validate.terms import CodeError
from tests.support.walks import SEED, problem, record

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
    (lambda p: p.update(group="line\nSO(3)"), "key 'scope' must be"),
    (of_solid(BALL), "the sizes must be radius"),
    (of_solid(TETRAHEDRON), "expected a list of 4 points"),
    (of_solid({"kind": "mesh", "density": 1, "sizes": MESH}), "three numbers of vertices"),
    (of_solid({"kind": "mesh", "density": 1, "sizes": MESH | {"faces": []}}), "no faces"),
]


@pytest.mark.parametrize(("change", "reason"), SHAPES, ids=[x[1] for x in SHAPES])
def test_a_record_of_another_shape_is_refused(change, reason):
    data = json.loads(to_json(record("so3")))
    change(data["problem"])
    with pytest.raises(RecordError, match=reason) as told:
        from_json(json.dumps(data))
    assert "\n" not in str(told.value)


@cache
def so3():
    compiled = program(problem("so3"), record("so3"))
    return emit(compiled, record("so3"), ("c", "python"), "so3")


IN_C = [
    ("#include <math.h>", "#include <math.h>\ntypedef int whole;", "'typedef'"),
    ("#include <math.h>", "#include <math.h>\nconst double table[] = {1.0};", "'const'"),
    ("#include <math.h>", "#include <math.h>\nenum { other };", "'other'"),
    ("#include <math.h>", "#include <math.h>\nenum { other = 0x10 };", "'other'"),
    ("#include <math.h>", "#include <math.h>\nenum { other = 'a' };", "'other'"),
    ("#include <math.h>", "#include <math.h>\n#if 1\n", "the directive"),
    ("#include <math.h>", "#include <math.h>\n#ifdef __cplusplus\n", "the directive"),
    ("#include <math.h>", "#include <math.h>\n#error no\n", "the directive"),
    ("const double I_11 =", "const long I_11 =", "'const'"),
    ("const double I_11 =", "const unsigned long I_11 =", "'const'"),
    ("const double I_11 =", "const double *I_11 =", "'.' is not"),
    ("    k[0] = J_12;\n", "    for (;;) k[0] = J_12;\n", "';'"),
    ("    k[0] = J_12;\n", "    if (k) k[0] = J_12;\n", "'.' is not"),
    ("    k[0] = J_12;\n", "    k[p] = J_12;\n", "'p'"),
    ("    k[0] = J_12;\n", "    J_12 = 1.0;\n", "'J_12'"),
    ("    k[0] = J_12;\n", "    return;\n", "';'"),
    ("double so3_energy(", "double so3_other(", "not known here"),
    ("    k[0] = J_12;\n", "    k[0] = J_12\n#ifndef __GNUC__\n+ 1.0\n#endif\n;", "the directive"),
    ("    k[0] = J_12;\n", "    k[0] = J_12 // see\r + 1.0\n;", "'.r' is not read"),
    ("    k[0] = J_12;\n", "    k[0] = J_12 + (50000*50000 - 2500000000.0);\n", "integers"),
    ("    k[0] = J_12;\n", "    k[0*0] = J_12;\n", "a product of integers"),
    ("    k[0] = J_12;\n", "    static const double a = 1.0;\n    k[0] = a;\n", "'static'"),
    ("#include <math.h>", "#include <math.h>\n#pragma redefine_extname sqrt cbrt", "directive"),
    ("#include <math.h>", "#include <math.h>\n#define y_H\n", "the directive"),
    ("#include <math.h>", "#include <math.h>\nint so3_constants();\n", "other arguments"),
    ('    "A_11",', '    [0] = "A_11",', "'='"),
    ('    "A_11",', "    A_11,", "','"),
    ("1.0/I_d_3", "sqrt()/I_d_3", "'.' is not"),
    ("u[0*n + s]", "n*1.0", "n stands"),
]


@pytest.mark.parametrize(("old", "new", "reason"), IN_C, ids=[x[1] for x in IN_C])
def test_c_that_is_not_read(old, new, reason):
    text = so3()["so3.c"]
    assert old in text
    with pytest.raises(CodeError, match=reason):
        read("so3.c", {**so3(), "so3.c": text.replace(old, new, 1)}, "so3")


def test_a_function_of_c_that_stands_twice():
    text = so3()["so3.c"]
    start = text.index("double so3_energy(")
    with pytest.raises(CodeError, match="defined twice"):
        read("so3.c", {**so3(), "so3.c": text + text[start:]}, "so3")
