"""Every language says the same as the emitted C; what one language alone is asked."""

import tomllib
from functools import cache

import numpy as np
import pytest

from derive import SE, Points, Potential, Problem
from derive.code.languages import LANGUAGES
from derive.problem.toml import problem_of
from tests.code.test_charts import FORMS as CHARTS
from tests.code.test_forms import DRAG
from tests.code.test_mass_matrix import REGULAR, typed
from tests.problems import PROBLEMS as FILES
from tests.support.corpus import stirred_torus
from tests.support.languages import PIECES, Case, T, command
from tests.support.library import BUILDS, emission, library, loaded
from tests.support.needs import need
from tests.support.read_julia import DimensionMismatchError, Module, Numbers

BARE = Problem(  # nothing but numbers: no parameter, no constant, no input
    "bare",
    SE(2),
    Points((2, [1, 0]), (1, [0, 1])),
    Potential(
        "sin(t)*exp(r1_x) + sqrt(1 + r1_x^2) + r2_y/3 + 1e-7*r2_x + log(2 + cos(r1_y))"
        " + atan(r2_x) + tanh(r1_x)*sinh(r1_y) + cosh(r2_y) + tan(r1_y/9)"
    ),
)
TURNING = {
    "name": "test",
    "group": "SE(2)",
    "lagrangian": {
        "L": "zeta_1^2 + zeta_2^2 + zeta_3^2 + A_11*zeta_1^2/2 + t*zeta_3^2 + T_1*zeta_2"
    },
    "input": [{"name": "u", "kind": "covector"}],
}
HYPERBOLIC = TURNING | {"group": "SO(2)", "lagrangian": {"L": "cosh(zeta_1) + A_11"}}
OBSERVED = FILES["SE(2) x SO(2) outputs"]
JACOBIANS = ("state", "inputs", "parameters", "raw")
CHARTED = ("four factors", "and matrices", "by a basis")
IN_CHARTS = {"jacobian": ("state", "step"), "step": ("rk4", "gauss")}
PROBLEMS = {
    "body": ("so3", {"jacobian": JACOBIANS, "conserved": True}),
    "pressed": ("saff3", {"conserved": True, "multiplier": True}),
    "ellipsoid": ("riemann_ellipsoid", {"jacobian": JACOBIANS[:1]}),
    "observed": (
        problem_of(tomllib.loads(OBSERVED)),
        {"jacobian": ("outputs", "raw"), "dynamics": True},
    ),
    "functions": (BARE, {"jacobian": JACOBIANS[:1]}),
    "dragged": (problem_of(tomllib.loads(DRAG)), {"jacobian": JACOBIANS[:1]}),
    "momenta": (problem_of(TURNING), {"momenta": True}),
    "newton": (problem_of(HYPERBOLIC), {"momenta": True}),
    "indefinite": (typed(REGULAR[0]), {"momenta": True}),
    "torus": (stirred_torus(9), {"conserved": True, "jacobian": JACOBIANS[:3]}),
    "torus, written out": (stirred_torus(3), {"jacobian": JACOBIANS[:3]}),
    **{
        f"charts, {x}": (
            CHARTS[x][0],
            {"attitude": CHARTS[x][1], "conserved": x != "and matrices", **IN_CHARTS},
        )
        for x in CHARTED
    },
    "floats": (BARE, {"jacobian": JACOBIANS[:1]}),
    "newton in floats": (problem_of(HYPERBOLIC), {"momenta": True}),
}
"""What is emitted, and options; with others test_pairs_of_options has them."""
CLOSE = {"newton": 1e-13, "momenta": 1e-11, "indefinite": 1e-11, "torus": 1e-13}
CLOSE |= {f"charts, {x}": 1e-13 for x in CHARTED}


@cache
def case(name):
    """A problem with numbers."""
    need("cc")
    problem, options = PROBLEMS[name]
    real = "float" if "float" in name else "double"
    return Case(problem, options, real, CLOSE.get(name, 1e-14))


def test_every_language_is_built():
    assert {*LANGUAGES} == {language for language, _ in BUILDS.values()} | {*PIECES}


READ = ("python", "javascript", "julia", "rust2021")
"""The first build of each language but C++, which calls the C."""


def holds(name, build):
    """What a build says of a problem is what the C says."""
    known = case(name)
    double = known.real == "double"
    if double or build != "python":
        known.agrees(build, None if double else 2e-6)


@pytest.mark.parametrize("build", READ)
@pytest.mark.parametrize("name", PROBLEMS)
def test_every_language_says_the_same(name, build):
    assert name != "body" or {*case(name).reference["status"]} >= {1, 2}
    holds(name, build)


@pytest.mark.parametrize("build", ["rust2021", "javascript", "julia"])
def test_integrals_over_an_ellipsoid_are_those_of_c_to_the_bit(build):
    case("ellipsoid").agrees(build, 1e-30)


COMPILED = [(name, x) for name in PROBLEMS for x in BUILDS if x not in (*READ, "c")]


@pytest.mark.parametrize(("name", "build"), COMPILED, ids=[f"{x}: {y}" for x, y in COMPILED])
def test_every_compiler_says_the_same(name, build):
    holds(name, build)


@pytest.mark.parametrize("build", [x for x in BUILDS if BUILDS[x][0] != "c"])
def test_newton_finds_a_velocity_or_says_that_there_is_none(build):
    """Π = sinh ζ, which asinh turns round, and no number."""
    made = library(build, PROBLEMS["newton"][0], momenta=True)
    _, k = made.constants(np.zeros(0))
    call = next(x for x in made.calls if x.name == "velocity")
    for momentum, zeta in ((0.7, np.arcsinh(0.7)), (np.nan, np.nan)):
        x = np.array([1, 0, 0, 1, momentum])
        values = made.values(t=T, p=np.zeros(0), k=k, u=np.array([0.3]), x=x)
        for found in made.shown(call, values, False)[:1]:
            np.testing.assert_allclose(found[4], zeta, rtol=1e-14)


def test_cpp_on_one_header_of_c():
    for name in ("body", "functions"):
        known = case(name)
        prefix, texts = emission(known.problem, ("cpp",), form="header", **known.options)
        assert f"{prefix}.c" not in texts
        known.compare(loaded("g++20", prefix, texts))


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
    jacobian = ("state", "parameters")
    _, texts = emission("se3", ("javascript",), "test", jacobian=jacobian, **chosen)
    assert [*texts] == ["test.mjs"]
    (tmp_path / "test.mjs").write_text(texts["test.mjs"], encoding="utf-8")
    (tmp_path / "main.mjs").write_text(LENGTHS, encoding="utf-8")
    assert command("node", "main.mjs", cwd=tmp_path) == ""


def test_julia_refuses_arrays_of_another_length():
    """One that is too long was read in part."""
    _, texts = emission("se3", ("julia",), "test", attitude="quaternion", momenta=True)
    module = Module(texts["test.jl"])
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


YEARS = pytest.mark.parametrize("year", [2021, 2024])


def compiled(source, year, tmp_path, *names):
    """A library of Rust with some of the problems beside it."""
    need("Rust 2024" if year == 2024 else "rustc")
    for name in names:
        prefix, texts = case(name).texts("rust")
        (tmp_path / f"{prefix}.rs").write_text(texts[f"{prefix}.rs"], encoding="utf-8")
    (tmp_path / "lib.rs").write_text(source, encoding="utf-8")
    words = ("--crate-type=lib", "--emit=metadata", "-Dwarnings", "lib.rs")
    command("rustc", f"--edition={year}", *words, cwd=tmp_path)


@YEARS
def test_rust_without_std_takes_its_functions_from_a_trait(year, tmp_path):
    methods = "\n".join(f"    fn {m}(self) -> Self {{ self }}" for m in METHODS.split())
    brought = ELSEWHERE.format(methods=methods, brought="use super::Elementary as _;")
    compiled(brought, year, tmp_path, "functions")
    with pytest.raises(AssertionError, match="no method named `sqrt` found for type `f64`"):
        compiled(ELSEWHERE.format(methods=methods, brought=""), year, tmp_path, "functions")


@YEARS
def test_rust_without_functions_needs_core_alone(year, tmp_path):
    modules = '#[path = "saff3.rs"]\npub mod saff3;\n#[path = "test.rs"]\npub mod test;\n'
    head = "#![no_std]\n#![forbid(unsafe_code)]\n"
    compiled(head + modules, year, tmp_path, "pressed", "momenta")
