"""Rust, JavaScript, C++ and Julia say the same as the emitted C: compiled, run and compared."""

import ctypes
import shutil
import subprocess

import numpy as np
import pytest

from derive import SE, Points, Potential, Problem, derive
from derive.code.languages import LANGUAGES
from tests import drivers
from tests.emitted import compile_c, import_python

T = 0.3
SINGULAR = ("so3", "se3", "sl3", "saff3")
ALL = ("state", "inputs", "parameters")
DEEP = ("so3", "se3", "two_tops")
"""Linearised in all three; the others in the state alone, for the sake of time."""
BARE = Problem(  # nothing but numbers: no parameter, no constant, no input
    "bare",
    SE(2),
    Points((2, [1, 0]), (1, [0, 1])),
    Potential("sin(t)*exp(r1_x) + sqrt(1 + r1_x^2) + r2_y/3 + 1e-7*r2_x"),
)
PROBLEMS = {name: name for name in (*SINGULAR, "two_tops")} | {"bare": BARE}
KINDS = ("cpp", "rust", "julia", "javascript")


class Drawn:
    """One problem: emitted, with numbers for its arrays and what the C makes of them."""

    def __init__(self, name, folder):
        self.name, self.derived = name, derive(PROBLEMS[name])
        moved = ALL if self.derived.problem.inputs else (ALL[0], ALL[2])
        asked = moved if name in DEEP else ALL[:1]
        self.derived.emit(folder, ("c", "python", *KINDS), jacobian=asked)
        m, rng = import_python(name, folder), np.random.default_rng(5)
        self.p = np.array([m.DEFAULTS.get(x, 1.0) + rng.uniform(-0.1, 0.1) for x in m.PARAMETERS])
        self.x, self.u = rng.normal(size=len(m.STATE)), rng.normal(size=len(m.INPUTS))
        self.names = [*m.STATE, *m.PARAMETERS, *m.INPUTS]
        self.matrices = [x for x in asked[1:] if len({"inputs": self.u, "parameters": self.p}[x])]

    def lines(self):
        """p, x, u and the parameters of a body without mass, a line each."""
        rows = (self.p, self.x, self.u, 0 * self.p)
        return "".join(" ".join(repr(float(v)) for v in row) + "\n" for row in rows)

    def reference(self, library):
        """What each line of a driver should hold."""
        status, k = library.constants(self.p)
        assert status == 0
        rates, D = library.jacobian(T, self.x, k, self.u)
        found = {"constants": k, "rhs": library.rhs(T, self.x, k, self.u), "rates": rates}
        found |= {"unforced": library.rhs(T, self.x, k), "jacobian": D.ravel()}
        found |= {"energy": np.array([library.energy(T, self.x, k)])}
        found |= {"singular": np.array([float(library.constants(0 * self.p)[0])])}
        array = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
        for what in self.matrices:
            size = len(self.p if what == "parameters" else self.u)
            found[f"jacobian_{what}"] = out = np.full(2 * library.sizes["ALGEBRA"] * size, np.nan)
            function = getattr(library.library, f"{self.name}_jacobian_{what}")
            function.restype, function.argtypes = None, [ctypes.c_double, *[array] * 4]
            function(T, self.x, self.p if what == "parameters" else k, self.u, out)
        return found


@pytest.fixture(scope="module")
def emitted(tmp_path_factory):
    """The folder of all problems in all languages, the problems, and their reference."""
    needed("gcc")
    folder = tmp_path_factory.mktemp("languages")
    problems = [Drawn(name, folder) for name in PROBLEMS]
    made = {x.name: x.reference(compile_c("gcc", x.name, folder, folder)) for x in problems}
    assert all(made[name]["singular"] == 1 for name in SINGULAR)
    return folder, problems, made


def command(*words, **options):
    """Run a program in a folder; its warnings are errors."""
    done = subprocess.run(words, capture_output=True, text=True, **options)
    assert done.returncode == 0, done.stderr
    assert not done.stderr, done.stderr
    return done.stdout


def needed(program):
    """Skip where a program is absent."""
    if shutil.which(program) is None:
        pytest.skip(f"no {program} on the path")


def filled(kind, module, problems, given, **fields):
    """The text of a driver that has a block for each problem."""
    frame, block, more = (getattr(drivers, kind + part) for part in ("", "_BLOCK", "_MORE"))
    blocks = []
    for i, x in enumerate(problems):
        extra = (
            more.format(name=x.name, what=w, upper=w.upper(), given=given[w]) for w in x.matrices
        )
        blocks.append(block.format(name=x.name, i=i, more="".join(extra), **fields))
    modules = "\n".join(module.format(name=x.name) for x in problems)
    first = problems[0].name
    return frame.format(modules=modules, blocks="".join(blocks), first=first, **fields)


def build_rust(folder, problems, real, words):
    module, given = '#[path = "{name}.rs"]\nmod {name};', {"inputs": "&k", "parameters": "p"}
    real = LANGUAGES["rust"].reals[real]
    (folder / "main.rs").write_text(filled("RUST", module, problems, given, real=real))
    command(*words, "-Dwarnings", "-odrive-rs", "main.rs", cwd=folder)
    return ["./drive-rs"]


def build_cpp(folder, problems, real, words):
    module, given = '#include "{name}.hpp"', {"inputs": "k", "parameters": "p"}
    (folder / "main.cpp").write_text(filled("CPP", module, problems, given, real=real))
    linked = [f"./{x.name}-gcc.so" for x in problems if (folder / f"{x.name}-gcc.so").exists()]
    if not linked:
        sources = [f"{x.name}.c" for x in problems if (folder / f"{x.name}.c").exists()]
        linked = [source[:-1] + "o" for source in sources]
        if sources:
            command("gcc", "-c", "-O1", *sources, cwd=folder)
    strict = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
    command(*words, *strict, "main.cpp", *linked, "-odrive-cpp", "-lm", cwd=folder)
    return ["./drive-cpp"]


def build_javascript(folder, problems, real, words):
    fields = {"T": T, "array": LANGUAGES["javascript"].reals[real]}
    names = [x.name for x in problems]
    (folder / "main.mjs").write_text(drivers.JAVASCRIPT.format(names=names, **fields))
    return [*words, "main.mjs"]


def build_julia(folder, problems, real, words):
    modules = "\n".join(f'include("{x.name}.jl")' for x in problems)
    fields = {"list": ", ".join(x.name for x in problems), "real": LANGUAGES["julia"].reals[real]}
    (folder / "main.jl").write_text(drivers.JULIA.format(modules=modules, T=T, **fields))
    return [*words, "main.jl"]


BUILDS = {
    "rust": (build_rust, ["rustc", "--edition=2021"]),
    "javascript": (build_javascript, ["node"]),
    "julia": (build_julia, ["julia", "--startup-file=no"]),
} | {
    f"{compiler}{year}": (build_cpp, [compiler, f"-std=c++{year}"])
    for compiler in ("g++", "clang++")
    for year in (17, 20)
}


def run(build, folder, problems, real="double"):
    """(problem, what) → the words of each line that the driver of a build prints."""
    function, words = BUILDS[build]
    program = function(folder, problems, real, words)
    printed = command(*program, cwd=folder, input="".join(x.lines() for x in problems))
    return [(*line.split(" ", 2), "")[:3] for line in printed.splitlines()]


def compare(printed, problems, made, tolerance):
    """Every line against the C, and none missing."""
    names = {x.name: x.names for x in problems}
    assert {x[:2] for x in printed} == {
        (x.name, what) for x in problems for what in ("names", *made[x.name])
    }
    for name, what, text in printed:
        if what == "names":
            assert text.split() == names[name]
            continue
        found, expected = np.array(text.split(), float), made[name][what]
        assert found.shape == expected.shape, (name, what)
        worst = np.abs(found - expected).max(initial=0)
        assert worst <= tolerance * np.abs(expected).max(initial=0), (name, what, worst)


@pytest.mark.parametrize("build", BUILDS)
def test_every_language_says_the_same(build, emitted):
    needed(BUILDS[build][1][0])
    folder, problems, made = emitted
    compare(run(build, folder, problems), problems, made, 1e-14)


@pytest.mark.parametrize("build", ["rust", "javascript", "julia", "g++17"])
def test_floats_agree_to_their_accuracy(build, emitted, tmp_path):
    needed(BUILDS[build][1][0])
    _, problems, made = emitted
    chosen = [x for x in problems if x.name in ("se3", "bare")]
    for x in chosen:
        asked = ("state", *x.matrices)
        x.derived.emit(tmp_path, KINDS, real="float", jacobian=asked)
    compare(run(build, tmp_path, chosen, "float"), chosen, made, 2e-6)


def test_cpp_on_one_header_of_c(emitted, tmp_path):
    needed("g++")
    _, problems, made = emitted
    chosen = [x for x in problems if x.name in ("so3", "bare")]
    for x in chosen:
        asked = ("state", *x.matrices)
        x.derived.emit(tmp_path, ("cpp",), form="header", jacobian=asked)
        assert not (tmp_path / f"{x.name}.c").exists()
    compare(run("g++20", tmp_path, chosen), chosen, made, 1e-14)


WORDS = (
    "become box crate dyn fn gen impl let loop macro match mod move mut priv pub ref self Self "
    "super trait type unsafe use where Some Ok Err begin end function module local quote isa "
    "elseif nothing undef eltype Vector Float64 arguments debugger eval extends instanceof null "
    "package var Math Float64Array Number RangeError char8_t N_STATE N_CONSTANTS ZERO_INPUTS "
    "Singular DEFAULTS D STATE rhs energy constants jacobian"
)
COMPILED = {
    "gcc": ("-std=c99", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "words.c"),
    "g++": ("-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "words.hpp"),
    "rustc": ("--edition=2021", "--crate-type=lib", "--emit=metadata", "-Dwarnings", "words.rs"),
    "node": ("--check", "words.mjs"),
    "julia": ("--startup-file=no", "words.jl"),
}


@pytest.fixture(scope="module")
def worded(tmp_path_factory):
    """A problem whose parameters are called as keywords are, and as what the templates need."""
    words = WORDS.split()
    U = " + ".join(f"{w}^2*r{i % 2 + 1}_x^{i % 3 + 1}" for i, w in enumerate(words))
    points = Points((words[0], [1, 0]), (1, [0, "fn"]))
    problem = Problem("words", SE(2), points, Potential(U), dict.fromkeys(words, 1.5))
    folder = tmp_path_factory.mktemp("words")
    files = derive(problem).emit(folder, ("c", *KINDS), jacobian=(ALL[0], ALL[2]))
    assert all(f'"{w}"' in files[f"words.{x}"] for w in words for x in ("rs", "jl", "mjs", "hpp"))
    return folder


@pytest.mark.parametrize("compiler", COMPILED)
def test_words_of_a_language_are_names_in_another(compiler, worded):
    needed(compiler)
    command(compiler, *COMPILED[compiler], cwd=worded)
