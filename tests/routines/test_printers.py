"""Algorithms in each language: a small one does what Python, read plainly, says."""

import ctypes
import re
import shutil
import subprocess
from pathlib import Path

import numpy
import pytest

from derive.routines.c import C
from derive.routines.javascript import JavaScript
from derive.routines.julia import Julia
from derive.routines.python import Python
from derive.routines.source import Source
from tests.support.needs import need
from tests.support.read_julia import Module, Numbers

ROOT = Path(__file__).parents[2]
TEXT = '''
def added(n: count, x: real[N], y: out[real[N]], z: out[real[N]]) -> real:
    """z becomes TWO and multiples of x, y what z was; a sum."""
    total: var[real] = 0.0
    largest: var[real] = -1.0
    weights: table[real, N] = WEIGHTS
    for i in range(N):
        y[i] = TWO + weights[i] * x[i]
        largest = abs(x[i]) if abs(x[i]) > largest else largest
    for i in reversed(range(N)):
        total += y[i]  # the sum
    if LONG:
        while total > 10.0:
            total /= 2.0
    for i in unrolled(3):
        if ROW[i]:
            total += ROW[i] * x[i]
    for i in range(N):
        other: real = y[i]
        y[i] = z[i]
        z[i] = other
    return total + largest if n > 0 else 0.0
'''
GIVEN = {"N": 3, "TWO": 2.0, "WEIGHTS": [1.0, -1.0, 0.5], "LONG": True, "ROW": [0.0, 0.25, 3.0]}
X, Y, Z = [3.0, -7.5, 11.0], [0.5, 0.25, 0.125], [5.0, 9.5, 7.5]
TOTAL = 22.0 / 2 / 2 - 7.5 / 4 + 33.0 + 11.0


def printed(printer, **more):
    given = {**GIVEN, "N_STATE": 3, "public": set(), "real": "double", **more}
    source = Source()
    source.read(TEXT, given)
    return printer(source, given).text(["added"])


def test_python():
    module = {"numpy": numpy, "math": __import__("math")}
    text = printed(Python, named=set(), returned={}, entry=[], status="")
    exec(text, module)
    y, z = numpy.zeros(3), numpy.array(Y)
    assert module["_added"](1, numpy.array(X), y, z) == TOTAL
    assert (y.tolist(), z.tolist()) == (Y, Z)
    assert module["_added"](0, numpy.array(X), y, z) == 0.0
    assert "for i in range(3)" not in text  # over whole arrays


def test_c(tmp_path):
    need("cc")
    text = printed(C, prefix="a", fabs="fabs", inline="")
    head = "#include <math.h>\n#include <stddef.h>\n"
    (tmp_path / "a.c").write_text(head + text, encoding="utf-8")
    command = ["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "a.c"]
    subprocess.run([*command, "-o", "a.so"], cwd=tmp_path, check=True)
    function = ctypes.CDLL(str(tmp_path / "a.so")).a_added
    function.restype = ctypes.c_double
    y, z = (ctypes.c_double * 3)(), (ctypes.c_double * 3)(*Y)
    assert function(ctypes.c_size_t(1), (ctypes.c_double * 3)(*X), y, z) == TOTAL
    assert ([*y], [*z]) == (Y, Z)


def test_a_pragma_stands_before_loops_whose_first_index_is_known():
    text = printed(C, prefix="a", fabs="fabs", inline="", pragma="#pragma unroll")
    assert text.count("\n#pragma unroll\n    for (int i = ") == text.count("for (int i = ") == 3
    source, given = Source(), {"N": 3, "prefix": "a", "real": "float", "inline": "", "pragma": "#!"}
    rest = "    for i in range(n, N):\n        x[i] = 0.0\n"
    source.read(f'def f(n: index, x: out[real[N]]):\n    "zeros"\n{rest}', given)
    assert "#!" not in C(source, given).text(["f"])


def test_javascript(tmp_path):
    if shutil.which("node") is None:
        need("node")
    text = printed(JavaScript, real="Float64Array", tags={}, entry=[], status="")
    call = f"\nconst y = [0, 0, 0], z = {Y};\nconsole.log(added(1, {X}, y, z), ...y, ...z);\n"
    (tmp_path / "a.mjs").write_text(text + call, encoding="utf-8")
    command = ["node", "a.mjs"]
    done = subprocess.run(command, cwd=tmp_path, check=True, capture_output=True, text=True)
    assert [*map(float, done.stdout.split())] == [TOTAL, *Y, *Z]


def test_julia():
    module = Module(f"module a\n{printed(Julia, real='Float64')}end\n")
    x, y, z = (Numbers(3, values=map(numpy.float64, values)) for values in (X, [0.0] * 3, Y))
    assert module.call("added!", 1, x, y, z) == TOTAL
    assert ([*y], [*z]) == (Y, Z)
    assert module.call("added!", 0, x, y, z) == 0.0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("def f():\n    ''\n    with x:\n        pass\n", "no statement of a routine"),
        ("def f():\n    ''\n    x: real = [1]\n", "no expression of a routine"),
        ("def f():\n    ''\n    x: real = 1.0 / 2.0\n", "C takes the quotient whole"),
        ("def f(x: 3):\n    ''\n    x = 1\n", "no type"),
        ("for i in unrolled(n):\n    x = 1\n", "not known when a file is written"),
    ],
)
def test_what_is_no_routine_is_said(text, words):
    given = {"prefix": "a", "real": "double", "fabs": "fabs", "inline": ""}

    def in_c():
        source = Source()
        source.read(text, given)
        return C(source, given).text(["f"])

    with pytest.raises(ValueError, match=words):
        in_c()


LEFT = {
    "rhs_each",
    "begin",
    "dense",
    "multiplied",
    "solved",
    "discrete_within",
    "rhs_lanes",
    "inputs_at",
    "hold_inputs",
    "factored",
    "lu_solve",
    "velocity",
    "momentum_rhs",
    "axes",
}
"""What an algorithm leaves to a template, or is called from one under another name."""
HEAD = re.compile(
    r"^(?:(?:export )?function |(?:pub )?fn |def _?|static inline [\w ]*\{\{ prefix \}\}_)"
    r"(\w+)!?\(",
    re.MULTILINE,
)


def test_no_template_has_a_function_of_the_name_of_a_routine():
    """As the loops on the torus, which stand in the same file."""
    written = (ROOT / "derive" / "routines" / "algorithms").glob("*.py")
    routines = {x for f in written for x in re.findall(r"def (\w+)", f.read_text(encoding="utf-8"))}
    for language in ("c", "javascript", "julia", "python", "rust"):
        for template in (ROOT / "templates" / language).glob("*.jinja"):
            own = {*HEAD.findall(template.read_text(encoding="utf-8"))}
            assert own & routines <= LEFT, template.name
