"""Every language says the same as the emitted C: compiled or read back, run and compared."""

import shutil
import subprocess

import numpy as np
import pytest

from derive import SE, Points, Potential, Problem, derive
from derive.code.languages import LANGUAGES
from derive.problem.toml import problem_of
from tests.code.test_indefinite import REGULAR, typed
from tests.support.calls import T
from tests.support.languages import (
    BUILDS,
    ONE_BUILD,
    OTHERS,
    PIECES,
    REFERENCE,
    RUSTC,
    Emitted,
    agree,
    built,
    command,
    known,
)
from tests.support.needs import CC, need
from tests.support.read_julia import DimensionMismatchError, Module, Numbers

ALL = ("state", "inputs", "parameters", "raw")
RUST_LIBRARY = ("--crate-type=lib", "--emit=metadata", "-Dwarnings")
BARE = Problem(  # nothing but numbers: no parameter, no constant, no input
    "bare",
    SE(2),
    Points((2, [1, 0]), (1, [0, 1])),
    Potential(
        "sin(t)*exp(r1_x) + sqrt(1 + r1_x^2) + r2_y/3 + 1e-7*r2_x + log(2 + cos(r1_y))"
        " + atan(r2_x) + tanh(r1_x)*sinh(r1_y) + cosh(r2_y) + tan(r1_y/9)"
    ),
)
PROBLEMS = {
    "so3": ALL,
    "saff3": ALL[:1],
    "riemann_ellipsoid": (ALL[0], *ALL[2:]),
    "bare": ALL[:1],
}
"""Which are linearised in what; two in the state alone, for the sake of time."""

TURNING = {
    "name": "test",
    "group": "SE(2)",
    "lagrangian": {
        "L": "zeta_1^2 + zeta_2^2 + zeta_3^2 + A_11*zeta_1^2/2 + t*zeta_3^2 + T_1*zeta_2"
    },
    "input": [{"name": "u", "kind": "covector"}],
}
MOMENTA = {
    "of_points": "se3",
    "turning_momenta": problem_of(TURNING),
    "indefinite": typed(REGULAR[0]),
}
"""Those with the motion in momenta."""

KEPT = ("so3", "saff3")
"""Those that say what their motion keeps."""
PRESSED = ("saff3",)
"""Those that keep a volume, and say its multiplier."""


@pytest.fixture(scope="module")
def emitted(tmp_path_factory):
    """Problems in all languages, in one folder; with other options test_pairs_of_options has
    them."""
    need("cc")
    folder, languages = tmp_path_factory.mktemp("languages"), (*REFERENCE, *OTHERS)
    plain = [
        Emitted(name, BARE if name == "bare" else name, folder, languages, chosen)
        for name, chosen in (
            (name, {"jacobian": x, "conserved": name in KEPT, "multiplier": name in PRESSED})
            for name, x in PROBLEMS.items()
        )
    ]
    for name, problem in MOMENTA.items():
        given = Emitted(name, problem, folder, languages, {"momenta": True}, tolerance=1e-11)
        plain.append(given)
    reasons = {status for x in plain for status in x.reference["status"]}
    assert reasons == {0, 1, 2}
    assert {1, 2} <= {*plain[0].reference["status"]}
    return folder, plain


def test_every_language_is_built_and_compared():
    assert {*LANGUAGES} == {*ONE_BUILD} | {*PIECES} | {"c"}
    assert not {*ONE_BUILD} & {*PIECES}


@pytest.mark.parametrize("build", BUILDS)
def test_every_language_says_the_same(build, emitted):
    folder, plain = emitted
    agree(build, folder, plain)


@pytest.fixture(scope="module")
def floats(tmp_path_factory):
    need("cc")
    folder = tmp_path_factory.mktemp("floats")
    languages = (*REFERENCE, *OTHERS)
    return folder, [Emitted("bare", BARE, folder, languages, {"jacobian": ALL[:1]}, "float")]


@pytest.mark.parametrize("build", built(but=REFERENCE))
def test_floats_agree_to_their_accuracy(build, floats):
    folder, chosen = floats
    agree(build, folder, chosen, "float", 2e-6)


def test_cpp_on_one_header_of_c(emitted, tmp_path):
    _, plain = emitted
    chosen = [x for x in plain if x.name in ("so3", "bare")]
    for x in chosen:
        x.derived.emit(tmp_path, ("cpp",), form="header", **x.options)
        assert not (tmp_path / f"{x.name}.c").exists()
    agree("g++20", tmp_path, chosen)


WORDS = (
    "become box crate dyn fn gen impl let loop macro match mod move mut priv pub ref self Self "
    "super trait type unsafe use where Some Ok Err begin end function module local quote isa "
    "elseif nothing undef eltype Vector Float64 arguments debugger eval extends instanceof null "
    "package var Math Float64Array Number RangeError char8_t N_STATE N_CONSTANTS ZERO_INPUTS "
    "Singular DEFAULTS length D STATE rhs energy constants jacobian project defect out "
    "conserved CONSERVED N_CONSERVED Conserved"
)
COMPILED = {
    "cc": (CC, "-std=c99", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "words.c"),
    "g++": ("g++", "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "words.hpp"),
    "rust2021": (RUSTC, "--edition=2021", *RUST_LIBRARY, "words.rs"),
    "rust2024": (RUSTC, "--edition=2024", *RUST_LIBRARY, "words.rs"),
    "node": ("node", "--check", "words.mjs"),
}


LENGTHS = """\
import * as m from "./test.mjs";
const p = new Float64Array(m.PARAMETERS.length).fill(1), x = new Float64Array(m.STATE.length);
const k = new Float64Array(m.CONSTANTS.length), u = new Float64Array(m.INPUTS.length);
const calls = {
    constants: [p], rhs: [0, x, k, u], energy: [0, x, k], project: [x], conserved: [0, x, k],
    jacobian: [0, x, k, u], jacobian_parameters: [0, x, p, u], momentum_rhs: [0, x, k, u],
    from_matrix: [new Float64Array(x.length + 5)],
};
for (const [name, given] of Object.entries(calls)) {
    given.forEach((own, i) => {
        for (const more of own.length === undefined ? [] : [-1, 1]) {
            const others = given.map((x, j) => (j === i ? new Float64Array(own.length + more) : x));
            try {
                m[name](...others);
                console.log(name, i, "takes", own.length + more);
            } catch (e) {
                if (!/^test: [xkpuyz] has [0-9]+ numbers/.test(e.message)) console.log(name, i, e);
            }
        }
    });
}
m.rhs(0, x, k);
"""


def test_javascript_refuses_arrays_of_another_length(tmp_path):
    need("node")
    chosen = {"attitude": "quaternion", "momenta": True, "conserved": True}
    found = derive("se3").emit(
        tmp_path, "javascript", "test", jacobian=["state", "parameters"], **chosen
    )
    assert [*found] == ["test.mjs"]
    (tmp_path / "main.mjs").write_text(LENGTHS, encoding="utf-8")
    done = subprocess.run(["node", "main.mjs"], cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout + done.stderr == ""


def test_julia_refuses_arrays_of_another_length(tmp_path):
    """One that is too long was read in part."""
    files = derive("se3").emit(tmp_path, "julia", "test", attitude="quaternion", momenta=True)
    module = Module(files["test.jl"])
    sizes = (module.names[f"N_{x}"] for x in ("STATE", "CONSTANTS", "PARAMETERS"))
    x, k, p = (Numbers(n, values=np.ones(n)) for n in sizes)
    takes = {"constants": [p], "energy": [np.float64(T), x, k], "defect": [x]}
    takes["rhs!"] = [Numbers(*x.shape), x, k, np.float64(T)]
    for name, given in takes.items():
        for i, own in enumerate(given):
            if own not in (x, k, p):
                continue
            for more in (-1, 1):
                other = Numbers(own.shape[0] + more, values=np.ones(own.shape[0] + more))
                with pytest.raises(
                    DimensionMismatchError, match=r"^test: [xkp] has [0-9]+ numbers"
                ):
                    module.call(name, *given[:i], other, *given[i + 1 :])


@pytest.fixture(scope="module")
def worded(tmp_path_factory):
    """A problem whose parameters are called as keywords are, and as what the templates need."""
    words = WORDS.split()
    U = " + ".join(f"{w}^2*r{i % 2 + 1}_x^{i % 3 + 1}" for i, w in enumerate(words))
    points = Points((words[0], [1, 0]), (1, [0, "fn"]))
    problem = Problem("words", SE(2), points, Potential(U), dict.fromkeys(words, 1.5))
    folder = tmp_path_factory.mktemp("words")
    files = derive(problem).emit(folder, ("c", *OTHERS), jacobian=(ALL[0], ALL[2]))
    texts = [files[f"words{end}"] for x in OTHERS for end in LANGUAGES[x].files["source"]]
    assert all(f'"{w}"' in text for w in words for text in texts)
    return folder


@pytest.mark.parametrize("compiler", COMPILED)
def test_words_of_a_language_are_names_in_another(compiler, worded):
    known(compiler, COMPILED[compiler])
    command(*COMPILED[compiler], cwd=worded)


def test_words_of_a_language_are_names_in_julia(worded):
    module = Module((worded / "words.jl").read_text(encoding="utf-8"))
    p = Numbers(len(WORDS.split()), values=np.full(len(WORDS.split()), 1.5))
    x, D = Numbers(9, values=np.ones(9)), Numbers(6, 6)
    module.call("jacobian!", Numbers(9), D, x, module.call("constants", p), np.float64(T))
    assert all(map(np.isfinite, D.whole()))


# -- Rust without std ---------------------------------------------------------------------------

ELSEWHERE = """\
#![no_std]
#![forbid(unsafe_code)]
#![deny(warnings)]
pub trait Elementary: Sized {{
{methods}
}}
impl Elementary for f64 {{}}
pub mod bare {{
    {brought}
    include!("bare.rs");
}}
"""
METHODS = "atan cos cosh exp ln sin sinh sqrt tan tanh"


@pytest.mark.parametrize("year", [2021, 2024])
def test_rust_without_std_takes_its_functions_from_a_trait(year, emitted, tmp_path):
    need("Rust 2024" if year == 2024 else "rustc")
    folder, _ = emitted
    shutil.copy(folder / "bare.rs", tmp_path)
    methods = "\n".join(f"    fn {m}(self) -> Self {{ self }}" for m in METHODS.split())
    library = tmp_path / "lib.rs"
    words = (RUSTC, f"--edition={year}", *RUST_LIBRARY, "lib.rs")
    library.write_text(ELSEWHERE.format(methods=methods, brought="use super::Elementary as _;"))
    command(*words, cwd=tmp_path)
    library.write_text(ELSEWHERE.format(methods=methods, brought=""))
    with pytest.raises(AssertionError, match="no method named `sqrt` found for type `f64`"):
        command(*words, cwd=tmp_path)


@pytest.mark.parametrize("year", [2021, 2024])
def test_rust_without_functions_needs_core_alone(year, emitted, tmp_path):
    need("Rust 2024" if year == 2024 else "rustc")
    folder, plain = emitted
    # so3: the angular momentum along gravity, ⟨g, L⟩/|g|
    calling = ("bare", "so3", "riemann_ellipsoid")
    rational = [x.name for x in plain if x.name not in calling]
    modules = "".join(f'#[path = "{folder}/{name}.rs"]\npub mod {name};\n' for name in rational)
    (tmp_path / "lib.rs").write_text(f"#![no_std]\n#![forbid(unsafe_code)]\n{modules}")
    command(RUSTC, f"--edition={year}", *RUST_LIBRARY, "lib.rs", cwd=tmp_path)
