"""Emitted files of a fluid on the torus, with loops: equal to the record; no change passes."""

import ctypes
import itertools
import math
import re
import subprocess
import tempfile
from fractions import Fraction
from functools import cache
from pathlib import Path
from types import ModuleType

import mpmath
import numpy as np
import pytest

from derive.validate.straight_line import Measured
from derive.validate.syntax import SYNTAX, tokens
from derive.validate.terms import CodeError
from derive.validate.torus.loop_reader import LoopReader
from derive.validate.torus.loops_of_languages import JuliaLoopReader
from derive.validate.torus.run_loops import Cells, LoopInterpreter
from derive.validate.torus.torus_files import (
    TorusClaims,
    agreement_of_module,
    compare_loops,
    cosine,
)
from tests.support.corpus import STIRRED, fluid
from tests.support.emitted_files import ENDS, Emission
from tests.support.needs import CC, need
from tests.support.read_julia import Module, Numbers

SIZES = (3, 5, 7, 9, 11, 13)
SOME = {"c": 150, "python": 40, "julia": 60}
"""Changes of each file, spread over all of it."""
TOKEN = re.compile(
    r"\*\*|[0-9]+\.[0-9]+(?:e-?[0-9]+)?|[0-9]+|[A-Za-z_]\w*|[<>=!]=|[-+*/]=|\+\+|--|\S"
)
OTHER = {"+": "-", "-": "+", "+=": "-=", "-=": "+=", "*": "+", "/": "*", "<": "<=", ">": ">="}
TURNED = (("re", "im"), ("im", "re"), ("even", "odd"), ("W", "P"), ("cosines", "sines"))
TURNED += (("COSINES", "SINES"), ("SINES", "COSINES"), ("_SUMS", "_ENTRIES"), ("real", "imag"))


@cache
def emission(N, languages=("c", "python"), **chosen):
    algebra, inertia = {"of": "torus", "N": N}, {"operator": "laplacian"}
    data = {"name": "fluid", "algebra": algebra, "inertia": inertia}
    return Emission(data, languages, **({"conserved": True} | chosen))


LANGUAGES = ("c", "python", "julia", "rust", "javascript")


@cache
def stirred(N):
    return Emission(fluid(N) | STIRRED, LANGUAGES, conserved=True)


@pytest.mark.parametrize("N", [3, 7, 11])
def test_forcing_and_drag_equal_the_record(N):
    reports = stirred(N).reports(fresh=stirred(N).files)
    assert len(reports) == len(LANGUAGES)
    for report in reports:
        assert report.holds, report.text
    assert "rhs_batch" in reports[0].text


JACOBIANS = ("jacobian", "jacobian_inputs", "jacobian_parameters")


@cache
def linearised(N):
    data = fluid(N) | STIRRED | {"damping": [*STIRRED["damping"], CURVED]}
    chosen = tuple(x.removeprefix("jacobian").strip("_") or "state" for x in JACOBIANS)
    return Emission(data, LANGUAGES, jacobian=chosen)


CURVED = {"kind": "laplacian", "coefficient": "kappa/nu^2 + 3*nu^6", "power": 1}
"""A coefficient that no polynomial of a low degree is."""


@pytest.mark.parametrize("N", [3, 7])
def test_jacobians_equal_the_record(N):
    for report in linearised(N).reports(fresh=linearised(N).files):
        assert report.holds, report.text
        assert ", ".join(JACOBIANS) in report.text


OF_LINEARISED = [
    ("fluid.c", "more_im - less_im", "more_im + less_im"),
    ("fluid.c", "D[below] = less_im + more_im;", "D[below] = less_im;"),
    ("fluid.c", "dx[at] = 0.5*rate_re;", "dx[at] = rate_re;"),
    ("fluid.c", "D[(at + 1)*49] -= drag;", ""),
    ("fluid.c", "at == row ? 1 : 0", "at == row ? 1 : 1"),
    ("fluid.c", "D[here + 2] = -drag*x[at + 1];", "D[here + 2] = -drag*x[at];"),
    ("fluid.c", "slopes[0] = 1.0;", "slopes[0] = 2.0;"),
    ("fluid.rs", "(a + 7 - b) % 7", "(a + b) % 7"),
    ("fluid.jl", "here = at + to * 48", "here = at + to * 24"),
    ("fluid.mjs", "inverse[more_d][more_a] - ", "inverse[more_d][more_a] + "),
    ("fluid.py", "other = n - sign * m", "other = n + sign * m"),
    ("fluid.py", "-14 * sign", "14 * sign"),
    ("fluid.py", "less - drag[..., None]", "less + drag[..., None]"),
    ("fluid.py", "[xp.imag(a), -xp.real(b)]", "[xp.imag(a), xp.real(b)]"),
]

OF_STIRRED = [
    ("fluid.c", "dx[at] += u[at];", "dx[at] -= u[at];"),
    ("fluid.c", "k[3 - 1 - p]", "k[p]"),
    ("fluid.c", "drag*x[at + 1]", "drag*x[at]"),
    ("fluid.c", "held[i] = u[i*n + s];", "held[i] = u[i];"),
    ("fluid.c", "k[2] = nu;", "k[2] = kappa;"),
    ("fluid.c", '    "kappa",\n    "nu",', '    "nu",\n    "kappa",'),
    ("fluid.rs", "dx[at] += u[at];", "dx[at] += u[at + 1];"),
    ("fluid.jl", "drag * x[at + 1]", "drag * x[at + 2]"),
    ("fluid.mjs", "dx[at] += u[at];", ""),
    ("fluid.mjs", '"f_re_1_0", "f_im_1_0"', '"f_im_1_0", "f_re_1_0"'),
    ("fluid.py", '"f_re_1_0",\n    "f_im_1_0"', '"f_im_1_0",\n    "f_re_1_0"'),
    ("fluid.py", "rates - drag * omega", "rates + drag * omega"),
    ("fluid.py", "1j * u[..., 1::2]", "1j * u[..., 0::2]"),
    ("fluid.py", "drag * squares + k[..., 0, None]", "drag * squares"),
]


@pytest.mark.parametrize(
    ("made", "name", "old", "new"),
    [(stirred, *x) for x in OF_STIRRED] + [(linearised, *x) for x in OF_LINEARISED],
)
def test_other_forcing_drag_and_jacobians_are_refused(made, name, old, new):
    made = made(11 if made is stirred else 7)
    assert made.files[name].count(old) == 1
    text = made.files[name].replace(old, new)
    known = TorusClaims(made.record, "", made.program.numbers())
    judge = (
        (lambda: agreement_of_module(run(text), known))
        if name.endswith(".py")
        else (lambda: compare_loops(name, made.files | {name: text}, "fluid", known))
    )
    with pytest.raises(CodeError):
        judge()


@cache
def claims(N):
    made = emission(N)
    return TorusClaims(made.record, "", made.program.numbers())


@pytest.mark.parametrize("N", SIZES)
@pytest.mark.parametrize("chosen", [{}, {"form": "header", "real": "float"}])
def test_what_is_emitted_equals_the_record(N, chosen):
    made = emission(N, **chosen)
    reports = made.reports(fresh=made.files)
    assert len(reports) == 2
    for report in reports:
        assert report.holds, report.text
        assert "constants, rhs, energy, conserved" in report.text
        assert "1 exact point;" in report.text
    assert "rhs_batch" in reports[0].text


def held(N, name, text):
    """Holds one changed text against the record; ``CodeError`` where it differs."""
    if name.endswith(".py"):
        agreement_of_module(run(text), claims(N))
    else:
        compare_loops(name, emission(N).files | {name: text}, "fluid", claims(N))


def changes(text, begin, end):
    """(kind, changed text) for the tokens between two places, comments apart."""
    beside = r"|^    length\([^\n]*\n[^\n]*"  # an error check, which is not read
    blank = r'/\*.*?\*/|"""[^"]*"""|^ *#[^\n]*|\(void\)\w+;|"[^"]*"'
    blank = re.compile(blank + beside, re.S | re.M)
    plain = blank.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)
    for m in TOKEN.finditer(plain, begin, end):
        token, (a, b) = m[0], m.span()
        for new in replaced(token):
            yield ("number" if "." in token else "other"), text[:a] + new + text[b:]


def replaced(token):
    if token in OTHER:
        yield OTHER[token]
    elif "." in token and len(token) > 1:
        yield repr(math.nextafter(float(token), 9.0)) if float(token) else "0.5"
    elif token.isdigit():
        yield str(int(token) + 1)
    else:
        for old, new in TURNED:
            parts = token.split("_")
            if old in parts or token == old:
                yield new if token == old else "_".join(new if x == old else x for x in parts)
                break


def run(text):
    module = ModuleType("changed")
    exec(compile(text, "changed", "exec"), module.__dict__)
    return module


def difference(text, changed):
    pairs = itertools.zip_longest(text.split("\n"), changed.split("\n"))
    return next(pair for pair in pairs if pair[0] != pair[1])


def meant_by_c(N, text):
    """The numbers of the functions, compiled."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in (("fluid.h", emission(N).files["fluid.h"]), ("fluid.c", text)):
            Path(folder, name).write_text(content, encoding="utf-8")
        library = f"{folder}/fluid.so"
        words = [CC, "-O1", "-shared", "-fPIC", "-o", library, f"{folder}/fluid.c", "-lm"]
        subprocess.run(words, check=True)
        c = ctypes.CDLL(library)
    c.fluid_energy.restype = ctypes.c_double
    t, x = ctypes.c_double(0), np.random.default_rng(1).normal(size=(N * N - 1))
    k, dx, out = np.zeros(99), np.zeros_like(x), np.zeros(3)
    x, k_, dx_, out_ = (y.ctypes.data_as(ctypes.c_void_p) for y in (x, k, dx, out))
    c.fluid_constants(k_, k_)
    c.fluid_rhs(t, x, k_, k_, dx_)
    c.fluid_conserved(t, x, k_, out_)
    return [*dx, *out, c.fluid_energy(t, x, k_)]


def meant_by_python(N, text):
    m, x = run(text), np.random.default_rng(1).normal(size=(2, N * N - 1))
    k = m.constants([])
    return [z for f in (m.rhs, m.energy, m.conserved) for z in f(0.0, x, k).ravel()]


def meant_by_julia(N, text):
    """By what evaluates Julia."""
    m, x = Module(text), np.random.default_rng(1).normal(size=N * N - 1)
    state, rates, out, k = Numbers(N * N - 1, values=x), Numbers(N * N - 1), Numbers(3), Numbers(0)
    m.call("rhs!", rates, state, k, np.float64(0))
    m.call("conserved!", out, state, k, np.float64(0))
    return [*rates, *out, m.call("energy", np.float64(0), state, k)]


MEANT = {"c": meant_by_c, "python": meant_by_python, "julia": meant_by_julia}
BAD = (ArithmeticError, LookupError, NameError, SyntaxError, TypeError, ValueError, CodeError)


def changed_of(language, text):
    """(kind, changed text) of a file, but for its names and what takes them."""
    if language == "julia":
        tables = text.index('"""\n    constants')
        yield from changes(text, tables // 2, tables)
    begin = {"c": "};", "python": "COSINES", "julia": "function rhs!"}[language]
    first = text.index(begin, text.index("_state_names") if language == "c" else 0)
    yield from changes(
        text, first, text.index("def _named(") if language == "python" else len(text)
    )


def no_change_passes(language, N):
    """But for those that change nothing."""
    name, same = f"fluid{ENDS[language]}", 0
    text = emission(N, ("c", "python", "julia")).files[name]
    found = [*changed_of(language, text)]
    taken = found[:: max(1, len(found) // SOME[language])]
    assert {kind for kind, _ in taken} == {"number", "other"}
    for _, changed in taken:
        try:
            held(N, name, changed)
        except BAD:
            continue
        here, there = (MEANT[language](N, x) for x in (text, changed))
        assert np.array_equal(here, there), difference(text, changed)
        same += 1
    assert same < len(taken) / 5


def test_no_change_of_python_passes():
    no_change_passes("python", 9)


@pytest.mark.parametrize(("language", "N"), [("c", 5), ("c", 7), ("c", 11), ("julia", 7)])
def test_no_change_of_others_passes(language, N):
    need("cc")
    no_change_passes(language, N)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("W_re, W_im);", "W_im, W_re);", "differs from the record's"),
        ("ap[j] = 0;", "", "no value"),
        ("sums[d][s][0] += re", "sums[d][s][2] += re", "no value"),
        ("j < 12; ++j) {\n        ap[j]", "j < 13; ++j) {\n        ap[j]", "outside of an array"),
        ("++r", "--r", "not known here"),
        ("d > 0 ? 0 : 6", "x[0] > 0 ? 0 : 6", "not known here"),
        ("second/11", "second/12", "trace_2 differs"),
        ("i*n + s] = rate[i]", "s*n + i] = rate[i]", "rhs_batch"),
        ("return total;", "return total*t;", "the energy differs"),
        ("column < r ? column + 11 - r", "column < r ? (column - r) % 11", "negative"),
        ("double total = 0;", "double total;", "not known here"),
        ("double W_re[11][12];", "double W_re[11][13];", "of another kind"),
    ],
)
def test_what_is_wrong_is_said(old, new, said):
    text = emission(11).files["fluid.c"]
    assert old in text
    with pytest.raises(CodeError, match=said):
        held(11, "fluid.c", text.replace(old, new))


OTHERS = ("rust", "javascript", "julia")
HEADS = {"fluid.rs": "fn rhs", "fluid.mjs": "function rhs", "fluid.jl": "function rhs!"}


@pytest.mark.parametrize("N", [3, 5])
def test_what_is_written_out_is_read_in_other_languages(N):
    made = emission(N, OTHERS, conserved=False)
    for report in made.reports(fresh=made.files):
        assert report.holds, report.text
        assert report.text.startswith("constants, rhs, energy equal the record at 1 exact point;")
    for file, head in HEADS.items():
        text = made.files[file]
        start = text.index(head)
        changed = text[:start] + text[start:].replace("re_1_0*im", "im_1_0*im", 1)
        assert changed != text
        found = made.reports({file: changed}, made.files)
        assert [x.holds for x in found] == [x != file for x in HEADS]


def test_what_stands_beside_steps_is_read_in_other_languages():
    """Their tables are not."""
    made = emission(7, OTHERS, step=("gauss", "rk4", "vern9"))
    for report in made.reports(fresh=made.files):
        assert report.holds, report.text
        assert "constants, rhs, energy, conserved equal the record" in report.text
        assert "not validated: steps in time" in report.text


LISTS = {
    "julia": "const {} = ()\n",
    "rust": "pub const {}: [&str; N] = [];\n",
    "javascript": "export const {} = Object.freeze([]);\n",
}
LOOPS = {
    "julia": """const WEIGHTS = [1.0, 2.0, 0.5]
function entries!(x, twice, found)
    for i in 1:2
        for j in 1:1:2
            s = i + j < 4 ? i + j - 2 : i + j - 3
            if twice && s > 0
                found[j, i] = 2.0*x[i]
            else
                found[j, i] = -x[j]/Float64(s + 1)
            end
        end
    end
    return nothing
end
function energy(t, x, k)
    found = zeros(float(eltype(x)), 2, 2)
    total = 0.0
    entries!(x, true, found)
    for i in 1:2
        for j in 1:2
            total += WEIGHTS[i + j - 1]*found[j, i]
        end
    end
    return total
end
""",
    "rust": """const WEIGHTS: [f64; 3] = [1.0, 2.0, 0.5];
fn entries(x: &[f64; N_STATE], twice: bool, found: &mut [[f64; 2]; 2]) {
    for i in 0..2 {
        for j in (0..2).step_by(1) {
            let s: usize = if i + j < 2 { i + j } else { i + j - 1 };
            found[i][j] = if twice && s > 0 { 2.0 * x[i] } else { -x[j] / (s + 1) as f64 };
        }
    }
}
pub fn energy(t: f64, x: &[f64; N_STATE], k: &[f64; N_CONSTANTS]) -> f64 {
    let mut found: [[f64; 2]; 2] = [[0.0; 2]; 2];
    let mut total: f64 = 0.0;
    entries(x, true, &mut found);
    for i in 0..2 {
        for j in 0..2 {
            total += WEIGHTS[i + j] * found[i][j];
        }
    }
    return total;
}
""",
    "javascript": """const WEIGHTS = [1, 2, 0.5];
function entries(x, twice, found) {
    for (let i = 0; i < 2; ++i) {
        for (let j = 0; j < 2; j += 1) {
            const s = i + j < 2 ? i + j : i + j - 1;
            found[i][j] = twice && s > 0 ? 2*x[i] : -x[j]/(s + 1);
        }
    }
}
export function energy(t, x, k) {
    const found = Array.from({ length: 2 }, () => new Float64Array(2));
    let total = 0;
    entries(x, true, found);
    for (let i = 0; i < 2; ++i) {
        for (let j = 0; j < 2; ++j) {
            total += WEIGHTS[i + j]*found[i][j];
        }
    }
    return total;
}
""",
}
WRONG = [
    ("julia", "i in 1:2", "i in 1:3", "no value"),
    ("julia", "1:1:2", "1:x:2", "'entries!'|not known here"),
    ("julia", "eltype(x)), 2, 2)", "eltype(x)), 1, 2)", "no value"),
    ("julia", "s + 1)", "s/2)", "quotient of integers"),
    ("julia", "Float64(", "Float32(", "not known here"),
    ("julia", "twice && s > 0", "twice && x[1] > 0.0", "depends on numbers"),
    ("julia", "found[j, i] = 2.0", "found[i] = 2.0", "outside of an array"),
    (
        "julia",
        "for j in 1:2\n            total",
        "for k in 1:2\n            total",
        "declared twice",
    ),
    ("julia", "total = 0.0", "total = x[1]", "'.='"),
    ("julia", "return nothing", "return nothing\n    i = s", "entries!"),
    ("julia", "    return total", "    entries! = total\n    return total", "not known here"),
    ("rust", "i in 0..2", "i in 0..3", "no value"),
    ("rust", "[[0.0; 2]; 2];", "[[0.0; 2]; 3];", "other sizes"),
    ("rust", "-x[j] / (s + 1) as f64", "-x[j] / (s / 2) as f64", "quotient of integers"),
    ("rust", "let s: usize = if i", "let s: usize = if x[0] > 0.0 && i", "depends on numbers"),
    ("rust", "let s: usize = if", "let s: f64 = if", "depends on numbers"),
    ("rust", "entries(x, true", "entries(x, 1.5", "of another kind"),
    ("rust", "total += WEIGHTS", "total -= other + WEIGHTS", "'other'"),
    ("javascript", "j += 1", "j += 0", "may not end"),
    ("javascript", "j += 1", "--j", "'entries'"),
    ("javascript", "new Float64Array(2)", "new Float64Array(1)", "outside of an array"),
    ("javascript", "s > 0 ?", "x[s] > 0 ?", "depends on numbers"),
    ("javascript", "found[i][j] =", "found[x[0]][j] =", "no value"),
    ("javascript", "WEIGHTS[i + j]", "WEIGHTS[(i + j)/2]", "no value"),
    ("javascript", "const s = i + j < 2", "const s = Math.min(i, j) < 2", "'entries'"),
    ("javascript", "let total = 0", "const total = 0", "'.='"),
]


def energy_of(language, text):
    """What a text with loops computes, modulo a prime, of x = (3, 5)."""
    text = "".join(map(LISTS[language].format, ("STATE", "PARAMETERS", "INPUTS"))) + text
    kind = JuliaLoopReader if language == "julia" else LoopReader
    reader = kind(language, tokens(SYNTAX[language], text, "loops"))
    reader.module()
    p = 2**61 - 1
    loops = LoopInterpreter(reader, p, lambda x: int(10 * float(x)) * pow(10, -1, p) % p, None)
    x = Cells([2])
    x.update({0: Measured(3), 1: Measured(5)})
    return loops.numbers([loops.call("energy", Measured(0), x, Cells([0]))])[0]


@pytest.mark.parametrize("language", LOOPS)
def test_loops_of_other_languages_are_read(language):
    """found is ((−3, 6), (10, 10)), with weights 1, 2, 2 and 1/2."""
    assert energy_of(language, LOOPS[language]) == -3 + 2 * 6 + 2 * 10 + 5


@pytest.mark.parametrize(("language", "old", "new", "said"), WRONG)
def test_what_is_not_known_of_loops_is_an_error(language, old, new, said):
    assert old in LOOPS[language]
    with pytest.raises(CodeError, match=said):
        energy_of(language, LOOPS[language].replace(old, new, 1))


def test_python_that_is_not_emitted_is_not_run():
    made = emission(7)
    changed = {"fluid.py": "raise SystemExit\n" + made.files["fluid.py"]}
    for fresh in (made.files, None):
        found = made.reports(changed, fresh)
        assert [r.holds for r in found] == [True, False]
        assert "it is not what is emitted, and so it is not run" in found[1].text


def test_cosines_are_those_of_another_library():
    with mpmath.workdps(60):
        for k in range(-7, 15):
            turns = mpmath.cos(2 * mpmath.pi * k / 11)
            found = cosine(Fraction(k, 11))
            assert abs(mpmath.mpf(found.numerator) / found.denominator - turns) < 1e-50
