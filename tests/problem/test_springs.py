"""A spring whose ends meet: where its natural length is a parameter that is 0, the force is −kd."""

import subprocess
import tomllib

import numpy as np
import pytest

from derive import derive
from derive.problem.toml import problem_of
from derive.programs import program
from derive.validate.chart import Chart
from derive.validate.compare import compare
from derive.validate.exact_points import Claims
from derive.validate.read_file import read
from derive.validate.terms import DiffersError
from tests.support.emitted import compile_c, import_python
from tests.support.needs import CC, need, needs

TIED = """
name = "tied"
group = "GROUP"
[parameters]
k = 2.0
LENGTH
[[point]]
mass = 1
at = [1, 0, 0.5]
[[point]]
mass = 2
at = [0, 1, 0]
[[point]]
mass = 0.5
at = [0, 0.3, 1]
[[point]]
mass = 0.7
at = [0.1, 0.3, -1]
[[potential]]
kind = "spring"
on = 1
anchor = [1, 0, 0.5]
stiffness = "k"
length = VALUE
"""
GROUPS = ("SE(3)", "SL(3)", "SAff(3)")


def made(group, length, folder, **options):
    """Emitted for a natural length that is a parameter l, or 0 in the file; the record."""
    text = TIED.replace("GROUP", group).replace("LENGTH", "l = 0" if length else "")
    d = derive(problem_of(tomllib.loads(text.replace("VALUE", '"l"' if length else "0"))))
    folder.mkdir(exist_ok=True)
    d.emit(folder, ("c", "python", *OTHERS), **options)
    return import_python("tied", folder), d


def states(m):
    """At g = 1 the ends meet; then near and far from there; ζ is any."""
    rng = np.random.default_rng(2)
    x = np.array([float(name in ("A_11", "A_22", "A_33")) for name in m.STATE])
    free = [i for i, name in enumerate(m.STATE) if name[0] not in "AT"]
    x[free] = rng.normal(size=len(free))
    beside = np.array([float(name[0] in "AT") for name in m.STATE]) * rng.normal(size=len(x))
    return [x + size * beside for size in (0, 1e-9, 1e-3, 0.5)]


@pytest.mark.parametrize("group", GROUPS)
def test_length_0_is_that_of_a_linear_spring(group, tmp_path):
    m, _ = made(group, True, tmp_path / "a", jacobian=("state", "parameters"))
    plain, _ = made(group, False, tmp_path / "b", jacobian=("state",))
    k, k_plain = m.constants([2.0, 0.0]), plain.constants([2.0])
    for x in states(m):
        dx, D = m.jacobian(0, x, k)
        expected, D_plain = plain.jacobian(0, x, k_plain)
        assert np.allclose(dx, expected, rtol=1e-13, atol=1e-13)
        assert np.allclose(D, D_plain, rtol=1e-12, atol=1e-12)
        assert np.allclose(m.rhs(0, x, k), dx, rtol=1e-13, atol=1e-13)
        assert np.isclose(m.energy(0, x, k), plain.energy(0, x, k_plain), rtol=1e-13)
        assert np.isfinite(m.jacobian_parameters(0, x, np.array([2.0, 0.0]))).all()
    many = np.array(states(m))
    assert np.allclose(m.rhs(0, many, k), [m.rhs(0, x, k) for x in many], rtol=1e-14, atol=1e-14)
    lengths = m.constants(np.array([[2.0, 0.0], [2.0, 0.3]]))
    assert np.allclose(lengths[0], k, rtol=1e-15)
    assert np.allclose(lengths[1], m.constants([2.0, 0.3]), rtol=1e-15)


def test_the_slope_by_a_length_of_0(tmp_path):
    """Away from distance 0 it is that of any length; by steps to both sides."""
    m, _ = made("SE(3)", True, tmp_path, jacobian=("parameters",))
    x, h = states(m)[-1], 1e-6
    D = m.jacobian_parameters(0, x, np.array([2.0, 0.0]))
    ends = [m.rhs(0, x, m.constants([2.0, s * h])) for s in (1, -1)]
    slope = (ends[0] - ends[1])[-6:] / (2 * h)
    assert np.allclose(D[-6:, list(m.PARAMETERS).index("l")], slope, rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("group", GROUPS)
def test_a_length_has_no_direction_at_distance_0(group, tmp_path):
    m, d = made(group, True, tmp_path)
    k = m.constants([2.0, 0.5])
    there, near, *_ = states(m)
    with np.errstate(divide="ignore", invalid="ignore"):
        assert np.isnan(m.rhs(0, there, k)).any()
    assert np.isfinite(m.rhs(0, near, k)).all()
    header = " ".join(d.emit(tmp_path, ["c"])["tied.h"].replace(" * ", " ").split())
    assert "Where the ends of a spring meet, its natural length must be 0" in header
    plain = derive("so3").emit(tmp_path, ["c"])["so3.h"]
    assert "natural length" not in plain


@needs("cc")
@pytest.mark.parametrize("real", ["double", "float"])
def test_in_c(real, tmp_path):
    m, d = made("SE(3)", True, tmp_path)
    c = compile_c(CC, "tied", tmp_path, tmp_path)
    status, k = c.constants([2.0, 0.0])
    assert status == 0
    for x in states(m):
        assert np.allclose(c.rhs(0, x, k), m.rhs(0, x, m.constants([2.0, 0.0])), rtol=1e-13)
    if real == "float":
        d.emit(tmp_path, ["c"], "small", real="float")
        (tmp_path / "main.c").write_text(
            FLOAT.replace("X", ", ".join(map(repr, map(float, states(m)[0]))))
        )
        command = [CC, "-std=c99", "-Wall", "-Wextra", "-Werror", "main.c", "small.c", "-lm"]
        subprocess.run([*command, "-o", "main"], cwd=tmp_path, check=True)
        done = subprocess.run(["./main"], cwd=tmp_path, capture_output=True, check=True)
        found = np.array([float(x) for x in done.stdout.split()])
        assert np.allclose(found, m.rhs(0, states(m)[0], m.constants([2.0, 0.0])), atol=1e-5)


FLOAT = """\
#include <stdio.h>
#include "small.h"
int main(void)
{
    const float p[] = {2, 0}, x[] = {X};
    float k[small_N_CONSTANTS], dx[small_N_STATE];
    if (small_constants(p, k)) return 1;
    small_rhs(0, x, k, NULL, dx);
    for (int i = 0; i < small_N_STATE; ++i) printf("%.9g\\n", dx[i]);
    return 0;
}
"""
RUST = """\
mod tied;
fn main() {
    let k = tied::constants(&[2.0, 0.0]).unwrap();
    let mut dx = [0.0; tied::N_STATE];
    tied::rhs(0.0, &[X], &k, &[], &mut dx);
    dx.iter().for_each(|v| println!("{v:e}"));
}
"""
NODE = """\
import * as m from "./tied.mjs";
for (const v of m.rhs(0, [X], m.constants([2, 0]))) console.log(v);
"""
OTHERS = {
    "rust": ("rustc", "main.rs", RUST, [["rustc", "--edition=2021", "main.rs"], ["./main"]]),
    "javascript": ("node", "main.mjs", NODE, [["node", "main.mjs"]]),
}


@pytest.mark.parametrize("language", OTHERS)
def test_in_other_languages(language, tmp_path):
    needed, name, text, commands = OTHERS[language]
    need(needed)
    m, _ = made("SE(3)", True, tmp_path)
    x = states(m)[0]
    (tmp_path / name).write_text(text.replace("X", ", ".join(map(repr, map(float, x))), 1))
    for command in commands:
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=True)
    found = np.array([float(v) for v in done.stdout.split()])
    assert np.allclose(found, m.rhs(0, x, m.constants([2.0, 0.0])), rtol=1e-14, atol=1e-14)


FAULTS = {
    "another length": ("1e-37*(l == 0)", "(l == 0)", "k_l/sqrt", "(k_l + slack_l)/sqrt"),
    "without it": ("", "", "k_l/sqrt", "(k_l + k_*slack_l)/sqrt"),
}


@pytest.mark.parametrize("case", FAULTS)
def test_what_holds_for_other_lengths_alone_is_refused(case, tmp_path):
    """Code that is right at random lengths and wrong at 0."""
    d = derive(
        problem_of(
            tomllib.loads(
                TIED.replace("GROUP", "SE(3)").replace("LENGTH", "l = 0").replace("VALUE", '"l"')
            )
        )
    )
    files = d.emit(tmp_path, ["c"])
    claims = Claims(d.record, Chart(), 2**64)
    numbers = program(d.problem, d.record).numbers()
    assert compare(read("tied.c", files, "tied").module, claims, numbers).points >= 2
    old, new, before, after = FAULTS[case]
    text = files["tied.c"]
    assert old in text
    start = text.index("void tied_rhs(")
    assert before in text[start:]
    wrong = text[:start].replace(old, new) + text[start:].replace(f"{before}", after, 2)
    with pytest.raises(DiffersError):
        compare(read("tied.c", {**files, "tied.c": wrong}, "tied").module, claims, numbers)
