"""Emitted files of a fluid on the torus, with loops: equal to the record; no change passes."""

import ctypes
import itertools
import math
import re
import shutil
import subprocess
from fractions import Fraction
from functools import cache
from types import ModuleType

import mpmath
import numpy as np
import pytest

from derive.code.emit import emit
from derive.code.options import Options
from derive.command.cli import main
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.programs import program
from derive.validate.chart import Chart
from derive.validate.emission import EmittedFiles
from derive.validate.straight_line import Measured
from derive.validate.syntax import SYNTAX, tokens
from derive.validate.terms import CodeError
from derive.validate.torus.loop_reader import LoopReader
from derive.validate.torus.loops_of_languages import JuliaLoopReader
from derive.validate.torus.run_loops import Cells, Loops
from derive.validate.torus.torus_files import (
    TorusClaims,
    agreement_of_module,
    compare_loops,
    cosine,
)
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
def emission(N, **chosen):
    algebra, inertia = {"of": "torus", "N": N}, {"operator": "laplacian"}
    p = problem_of({"name": "fluid", "algebra": algebra, "inertia": inertia})
    d, options = walk(p), Options(**{"conserved": True} | chosen)
    compiled = program(p, d, options)
    return d, compiled, emit(compiled, d, ("c", "python"), "fluid", options)


@cache
def claims(N):
    d, compiled, _ = emission(N)
    return TorusClaims(d, "", compiled.numbers())


@pytest.mark.parametrize("N", SIZES)
@pytest.mark.parametrize("chosen", [{}, {"form": "header", "real": "float"}])
def test_what_is_emitted_equals_the_record(N, chosen):
    d, compiled, files = emission(N, **chosen)
    reports = EmittedFiles(files, "fluid", Chart(), compiled.numbers(), fresh=files).reports(d)
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
        compare_loops(name, emission(N)[2] | {name: text}, "fluid", claims(N))


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


@pytest.mark.parametrize("N", [5, 7, 11])
def test_no_change_of_c_passes(N, tmp_path):
    need("cc")
    text = emission(N)[2]["fluid.c"]
    found = [*changes(text, text.index("};", text.index("_state_names")), len(text))]
    taken = found[:: max(1, len(found) // SOME["c"])]
    assert {kind for kind, _ in taken} == {"number", "other"}
    same = 0
    for i, (_, changed) in enumerate(taken):
        try:
            held(N, "fluid.c", changed)
        except CodeError:
            continue
        here, there = (meaning(N, x, tmp_path / f"{i}{k}") for k, x in enumerate((text, changed)))
        assert np.array_equal(here, there), difference(text, changed)
        same += 1
    assert same < len(taken) / 5


def test_no_change_of_python_passes():
    N, same = 9, 0
    text = emission(N)[2]["fluid.py"]
    found = [*changes(text, text.index("COSINES"), text.index("def _named("))]
    taken = found[:: max(1, len(found) // SOME["python"])]
    x = np.random.default_rng(1).normal(size=(2, N * N - 1))

    def meant(text):
        m = run(text)
        k = m.constants([])
        return [z for f in (m.rhs, m.energy, m.conserved) for z in f(0.0, x, k).ravel()]

    for _, changed in taken:
        try:
            held(N, "fluid.py", changed)
        except (ArithmeticError, LookupError, NameError, SyntaxError, TypeError, ValueError):
            continue
        assert np.array_equal(meant(changed), meant(text)), difference(text, changed)
        same += 1
    assert same < len(taken) / 5


def run(text):
    module = ModuleType("changed")
    exec(compile(text, "changed", "exec"), module.__dict__)
    return module


def difference(text, changed):
    pairs = itertools.zip_longest(text.split("\n"), changed.split("\n"))
    return next(pair for pair in pairs if pair[0] != pair[1])


def meaning(N, text, folder):
    """The numbers of the functions, compiled."""
    folder.mkdir()
    (folder / "fluid.h").write_text(emission(N)[2]["fluid.h"], encoding="utf-8")
    (folder / "fluid.c").write_text(text, encoding="utf-8")
    library = folder / "fluid.so"
    subprocess.run(
        [CC, "-O1", "-shared", "-fPIC", "-o", library, folder / "fluid.c", "-lm"], check=True
    )
    c = ctypes.CDLL(str(library))
    c.fluid_energy.restype = ctypes.c_double
    t, x = ctypes.c_double(0), np.random.default_rng(1).normal(size=(N * N - 1))
    k, dx, out = np.zeros(99), np.zeros_like(x), np.zeros(3)
    x, k_, dx_, out_ = (y.ctypes.data_as(ctypes.c_void_p) for y in (x, k, dx, out))
    c.fluid_constants(k_, k_)
    c.fluid_rhs(t, x, k_, k_, dx_)
    c.fluid_conserved(t, x, k_, out_)
    shutil.rmtree(folder)
    return [*dx, *out, c.fluid_energy(t, x, k_)]


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
    text = emission(11)[2]["fluid.c"]
    assert old in text
    with pytest.raises(CodeError, match=said):
        held(11, "fluid.c", text.replace(old, new))


HEADS = {"fluid.rs": "fn rhs", "fluid.mjs": "function rhs", "fluid.jl": "function rhs!"}


@pytest.mark.parametrize("N", [3, 5])
def test_what_is_written_out_is_read_in_other_languages(N):
    d, compiled, _ = emission(N, conserved=False)
    files = emit(compiled, d, ("rust", "javascript", "julia"), "fluid", Options())
    given = Chart(), compiled.numbers(), True, files
    for report in EmittedFiles(files, "fluid", *given).reports(d):
        assert report.holds, report.text
        assert report.text.startswith("constants, rhs, energy equal the record at 1 exact point;")
    for file, head in HEADS.items():
        start = files[file].index(head)
        changed = files[file][:start] + files[file][start:].replace("re_1_0*im", "im_1_0*im", 1)
        assert changed != files[file]
        found = EmittedFiles(files | {file: changed}, "fluid", *given).reports(d)
        assert [x.holds for x in found] == [x != file for x in HEADS]


def test_what_stands_beside_steps_is_read_in_other_languages():
    """Their tables are not."""
    chosen = Options(step=("gauss", "rk4", "vern9"), conserved=True)
    d, compiled, _ = emission(7, step=chosen.step)
    files = emit(compiled, d, ("rust", "javascript", "julia"), "fluid", chosen)
    given = Chart(), compiled.numbers(), True, files
    for report in EmittedFiles(files, "fluid", *given).reports(d):
        assert report.holds, report.text
        assert "constants, rhs, energy, conserved equal the record" in report.text
        assert "not validated: steps in time" in report.text


@pytest.mark.parametrize("N", [7])
def test_no_change_of_julia_passes(N):
    """Judged by what evaluates Julia."""
    d, compiled, _ = emission(N)
    text = emit(compiled, d, ("julia",), "fluid", Options(conserved=True))["fluid.jl"]
    code = text[: text.index('"""\n    constants')], text[text.index("function rhs!") :]
    x, same = np.random.default_rng(1).normal(size=N * N - 1), 0
    found = [*changes(text, len(code[0]) // 2, len(code[0]))]
    found += [*changes(text, len(text) - len(code[1]), len(text))]
    taken = found[:: len(found) // SOME["julia"]]

    def meant(text):
        m, state = Module(text), Numbers(N * N - 1, values=x)
        rates, out, k = Numbers(N * N - 1), Numbers(3), Numbers(0)
        m.call("rhs!", rates, state, k, np.float64(0))
        m.call("conserved!", out, state, k, np.float64(0))
        return [*rates, *out, m.call("energy", np.float64(0), state, k)]

    for _, changed in taken:
        try:
            compare_loops("fluid.jl", {"fluid.jl": changed}, "fluid", claims(N))
        except CodeError:
            continue
        assert np.array_equal(meant(changed), meant(text)), difference(text, changed)
        same += 1
    assert same < len(taken) / 5


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
    loops = Loops(reader, p, lambda x: int(10 * float(x)) * pow(10, -1, p) % p, None)
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
    d, compiled, files = emission(7)
    changed = files | {"fluid.py": "raise SystemExit\n" + files["fluid.py"]}
    for fresh in (files, None):
        found = EmittedFiles(changed, "fluid", Chart(), compiled.numbers(), fresh=fresh).reports(d)
        assert [r.holds for r in found] == [True, False]
        assert "it is not what is emitted, and so it is not run" in found[1].text


def test_the_command(tmp_path, capsys):
    path = tmp_path / "fluid.toml"
    path.write_text(
        'name = "fluid"\n[algebra]\nof = "torus"\nN = 7\n[inertia]\noperator = "laplacian"\n',
        encoding="utf-8",
    )
    out = ["emit", str(path), "--out", str(tmp_path), "--validate"]
    assert main(out) == 0
    assert capsys.readouterr().err.count("equal the record") == 2
    c = tmp_path / "fluid.c"
    c.write_text(c.read_text(encoding="utf-8").replace("a*c - b*d", "a*c + b*d"), encoding="utf-8")
    assert main([*out, "--check"]) == 1
    assert "DIFFERS: rhs" in capsys.readouterr().err


def test_cosines_are_those_of_another_library():
    with mpmath.workdps(60):
        for k in range(-7, 15):
            turns = mpmath.cos(2 * mpmath.pi * k / 11)
            found = cosine(Fraction(k, 11))
            assert abs(mpmath.mpf(found.numerator) / found.denominator - turns) < 1e-50
