"""The emitted steps of every form of the state: C moves as SciPy, other languages as C, and back;
inputs that change with the time, builds, and the motion of the compiled C."""

import subprocess

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive.code.emit import EmitError
from tests.problems.line import FALLING
from tests.support.corpus import DRIVEN
from tests.support.emitted import import_python
from tests.support.motions import emitted, follow
from tests.support.needs import need

LANGUAGES = ("c", "python", "javascript", "rust")
FORMS = {
    "so3": {},
    "so3 quaternion": {"attitude": "quaternion"},
    "so3 principal": {"frame": "principal"},
    "se3": {},
    "se3 columns": {"layout": "col"},
    "sl3 tangent": {"velocity": "tangent"},
    "kirchhoff conserved": {"conserved": True},
    **{name: {} for name in ("so4", "sp4", "heisenberg", "two_tops", "comet", "gyrostat")},
    **{name: {} for name in ("top", "riemann_ellipsoid", "zeitlin", "euler_poisson")},
}
DISCRETE = ("so3", "se3", "sl3", "saff3", "gl3", "so4", "heisenberg", "screw", "sim3", "sp4")
DISCRETE += ("pushed SO(3)", "pushed SL(3)", "pushed GL(3)", "pushed SE(3)")
CASES = [(name, step) for name in FORMS for step in ("gauss", "vern9")]
CASES += [(name, "discrete") for name in DISCRETE]
WRITTEN = [(*x, y) for x in CASES for y in LANGUAGES[: 2 if "principal" in x[0] else 4]]
PUSHED = DRIVEN.replace('"driven"', '"pushed"').replace("length = 1 ", "length = 0 ")


def case(name, step, *languages):
    """The folder, the name and the module of a problem in a form, with one step."""
    problem = PUSHED.replace("GROUP", name[7:]) if name.startswith("pushed") else name.split()[0]
    options = {"order": 4} if step == "discrete" else FORMS[name]
    folder, own = emitted(problem, ("c", "python", *languages), step=step, **options)
    return folder, own, import_python(own, folder)


def start(code):
    """Parameters of a body, small inputs, and a state near 1 that moves, on the group."""
    rng = np.random.default_rng(5)
    moments = {"m": 2, "J_11": 1.5, "J_12": 0.1, "J_22": 1.3, "J_23": 0.05, "J_33": 1.1}
    known = moments | {"c_1": 0.1, "c_2": 0.2, "c_3": 0.3, "J_13": 0.0}
    defaults = {x: v for x, v in code.DEFAULTS.items() if v is not None}
    p = [known.get(x, defaults.get(x, 0.7)) for x in code.PARAMETERS]
    still = [x[0] in "ATq" for x in code.STATE]
    x = np.where(still, 0.0, 0.2 * rng.normal(size=len(still)))
    ones = [k for k, s in enumerate(code.STATE) if s == "q_0" or (s[0] == "A" and s[-1] == s[-2])]
    x[ones] = 1
    if "mu" in code.PARAMETERS:
        x[code.STATE.index("T_1")] = 2  # away from the centre of attraction
    if any(s.endswith("_dot") for s in code.STATE):
        x[len(x) // 2 :] = [0.1, 0.2, 0, -0.1, 0.05, 0.1, 0.2, 0, -0.15]
    return np.array(p), 0.1 * rng.normal(size=len(code.INPUTS)), x


@pytest.mark.parametrize(("name", "step", "language"), WRITTEN, ids=str)
def test_every_form_moves_alike_and_goes_back(name, step, language):
    folder, own, code = case(name, step, *{language} - {"c", "python"})
    p, u, x = start(code)
    commands = [(step, 0.02, 20), ("dense", 0.393, 0), (step, -0.02, 20)]
    commands += [(f"{step}_to", 0.3, 1e-12), (f"{step}_to", 0.0, 1e-12)] * (step != "discrete")
    places = follow(language, folder, own, commands, x, p, u)
    size = max(1.0, np.abs(x).max())
    assert [place.status for place in places] == [0] * len(commands)
    assert np.abs(places[0].x - x).max() > 1e-3
    for place in places[2::2]:
        assert np.abs(place.x - x).max() < (1e-6 if step == "vern9" else 1e-12) * size
    if language == "c":
        k = code.constants(p)
        exact = solve_ivp(
            lambda t, x: code.rhs(t, x, k, *([u] if len(u) else [])), (0, 0.4), x,
            method="DOP853", rtol=1e-12, atol=1e-13, t_eval=[0.393, 0.4],
        ).y.T  # fmt: skip
        close = 1e-6 if step == "discrete" else 1e-9
        for place, wanted in zip(places[1::-1], exact, strict=True):
            assert np.abs(place.x - wanted).max() < close * max(1, np.abs(wanted).max())
        return
    for place, same in zip(places, follow("c", folder, own, commands, x, p, u), strict=True):
        assert abs(place.t - same.t) < 1e-15
        assert np.abs(place.x - same.x).max() < 1e-12 * np.abs(same.x).max()


TORQUE = """
#include "so3_steps.h"
#include <stdio.h>
static void torque(double t, const double *x, double *u, void *data)
{
    (void)x;
    u[0] = *(double *)data*cos(3*t);
    u[1] = u[2] = 0;
}
int main(void)
{
    const double p[] = {0, 0, 0.2, 1.3, 0.1, 0, 0.9, 0, 0.4, 0, 0, -9.81};
    const double x[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0, 9};
    double k[so3_SIZE_K], size = 2;
    so3_motion m;
    so3_constants(p, k);
    so3_begin(&m, 0, x);
    m.inputs = torque;
    m.data = &size;
    if (so3_gauss_to(&m, k, 0, 1, 1e-12)) return 1;
    if (so3_vern9_to(&m, k, 0, 2, 1e-12)) return 2;
    for (int i = 0; i < so3_N_STATE; ++i) printf("%.17g ", m.x[i]);
    return 0;
}
"""
IN_JAVASCRIPT = """
import * as c from "./so3.mjs";
const p = [0, 0, 0.2, 1.3, 0.1, 0, 0.9, 0, 0.4, 0, 0, -9.81];
const m = c.begin(0, [1, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0, 9]), k = c.constants(p);
m.inputs = (t, x) => [2*Math.cos(3*t), 0, 0];
if (c.gauss_to(m, k, null, 1, 1e-12) || c.vern9_to(m, k, null, 2, 1e-12)) throw new Error();
console.log(...m.x);
"""


@pytest.mark.parametrize("language", ["c", "python", "javascript"])
def test_inputs_as_a_function_of_time(language):
    """A torque that changes within a step: against SciPy."""
    folder, _ = emitted("so3", LANGUAGES, step=("gauss", "vern9"))
    code, x = import_python("so3", folder), np.array([*np.eye(3).ravel(), 0.1, 0, 9])
    k = code.constants([0, 0, 0.2, 1.3, 0.1, 0, 0.9, 0, 0.4, 0, 0, -9.81])

    def torque(t, x):
        return np.array([2 * np.cos(3 * t), 0, 0])

    if language == "python":
        m = code.begin(0.0, x)
        assert code.gauss_to(m, k, torque, 1.0, 1e-12) == code.OK
        assert code.vern9_to(m, k, torque, 2.0, 1e-12) == code.OK
        end = m.x
    else:
        program = ["node", "torque.mjs"] if language == "javascript" else ["./torque"]
        need("node" if language == "javascript" else "sanitizers of gcc")
        (folder / "torque.mjs").write_text(IN_JAVASCRIPT)
        (folder / "torque.c").write_text(TORQUE)
        if language == "c":
            flags = ["-std=c99", "-O1", "-march=native", "-fsanitize=address,undefined"]
            built = ["gcc", *flags, "torque.c", "so3.c", "-o", "torque", "-lm"]
            subprocess.run(built, cwd=folder, check=True)
        done = subprocess.run(program, cwd=folder, check=True, capture_output=True, text=True)
        end = np.array(done.stdout.split(), float)
    field = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}
    exact = solve_ivp(lambda t, x: code.rhs(t, x, k, torque(t, x)), (0, 2), x, **field).y[:, -1]
    assert np.abs(end - exact).max() < 1e-9


@pytest.mark.parametrize("language", LANGUAGES)
def test_beside_other_steps_it_moves_as_alone(language):
    """Names of one method do not hide those of another."""
    steps = ("discrete", "gauss", "vern9", "rk4")
    p, u, x = start(case("so3", "gauss")[2])
    for step in steps[:2]:
        made = [emitted("so3", (language,), step=chosen) for chosen in ((step,), steps)]
        alone, beside = (follow(language, *y, [(step, 0.1, 9)], x, p, u)[0] for y in made)
        assert alone.t == beside.t
        assert np.abs(beside.x - alone.x).max() < 1e-14


# ---------------------------------------------------------------- builds

STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]


@pytest.mark.parametrize("compiler", ["gcc -std=c99", "g++ -std=c++17", "clang -std=c99"])
def test_it_compiles_strictly_for_this_machine(compiler):
    """With the square roots of lanes, of springs: headers of GCC 12 warn of their own."""
    need(compiler.split()[0])
    folder, _ = emitted(FALLING, ("c",), step="gauss")
    text = (folder / "line_steps.h").read_text()
    assert "line_sqrt_lanes(" in text
    assert "1e-15" in text.partition("#ifndef")[0]  # what a tolerance of 0 is taken for
    source = folder / ("all.cpp" if compiler.startswith("g++") else "all.c")
    source.write_text(
        '#include "line_steps.h"\n'
        "int go(line_motion *m, const double *k, const double *u);\n"
        "int go(line_motion *m, const double *k, const double *u)\n"
        "{ return line_gauss_to(m, k, u, 1.0, 1e-9); }\n"
    )
    strict = ["-O3", "-march=native", *STRICT, "-c"]
    subprocess.run([*compiler.split(), *strict, source.name], check=True, cwd=folder)


ALL_FORMS = {
    "quaternion": {"attitude": "quaternion"},
    "columns, in one header": {"layout": "col", "form": "header"},
    "principal": {"frame": "principal"},
    "momenta": {"momenta": True},
    "tangent": {"velocity": "tangent"},
}


@pytest.mark.parametrize("form", ALL_FORMS)
@pytest.mark.parametrize("compiler", ["gcc", "clang", "g++"])
def test_every_form_of_the_state_has_them_all(form, compiler):
    """As C99 and as C++11."""
    need(compiler)
    folder, _ = emitted("se3", ("c",), step=("gauss", "rk4", "vern9"), **ALL_FORMS[form])
    (folder / "all.c").write_text('#include "se3_steps.h"\n#include "se3_steps.h"\n')
    language = ["-x", "c++", "-std=c++11"] if compiler == "g++" else ["-std=c99", "-pedantic"]
    command = [compiler, *language, *STRICT[:2], "-Werror", "-fsyntax-only", "all.c"]
    subprocess.run(command, cwd=folder, check=True)


@pytest.mark.parametrize("language", ["c", "javascript", "rust"])
def test_gauss_is_of_doubles(language):
    with pytest.raises(EmitError, match="leave out"):
        derive.derive("so3").emit(None, (language,), step="gauss", real="float")


# ---------------------------------------------------------------- the compiled C


@pytest.fixture(scope="module")
def top():
    need("cc")
    return derive.compile("so3", step=("gauss", "vern9"))


HEAVY = np.array([*np.eye(3).ravel(), 0.1, 0, 9])


def test_wrong_words(top):
    m = top.begin(HEAVY)
    with pytest.raises(ValueError, match="no step 'euler' was compiled; there is gauss, vern9"):
        m.move(0.1, step="euler")
    for h, n in ((np.nan, 1), (np.inf, 1), (0.1, -1)):
        with pytest.raises(ValueError, match=f"n = {n}, h = {h}"):
            m.move(h, n)
    for tol in (0, -1.0, np.nan):
        with pytest.raises(ValueError, match="tol must be positive"):
            m.move_to(1.0, tol)
    with pytest.raises(ValueError, match="a state of 12 numbers"):
        top.begin([1.0])
    with pytest.raises(ValueError, match='step="gauss"'):
        derive.compile("so3").begin(HEAVY)


def test_a_start_is_on_the_group(top):
    """Up to what rounding, or some digits in a file, leave of it."""
    x = HEAVY.copy()
    x[0] += 1e-10
    top.begin(x)
    x[4] = 1.1
    with pytest.raises(ValueError, match=r"its defect is 0\.21: project\(x\)"):
        top.begin(x)
    for _ in range(5):
        x = top.project(x)
    assert top.begin(x).move(0.1).t == 0.1
    x[0] = np.nan
    with pytest.raises(ValueError, match="its defect is nan"):
        top.begin(x)


def test_a_motion_that_cannot_go_on_says_so(top, tmp_path):
    m = top.begin([*np.eye(3).ravel(), np.nan, 0, 0])
    for move in (lambda: m.move(0.1), lambda: m.move_to(1.0)):
        with pytest.raises(derive.StepError, match="no finite value at t = 0"):
            move()
    (tmp_path / "line.toml").write_text(FALLING)
    f = derive.compile(tmp_path / "line.toml", step="gauss")
    m = f.begin([float(name in ("A_11", "A_22", "T_1")) for name in f.STATE])
    with pytest.raises(derive.StepError, match=r"too short|no finite value"):
        m.move_to(10.0, 1e-9)
    assert np.isfinite(m.x).all()
    assert abs(m.t - np.pi / np.sqrt(8)) < 1e-6


def test_time_and_turns(top):
    """The time of an adaptive motion is that asked for; one method after the other, and copies."""
    m = top.begin(HEAVY, t=1.0)
    assert m.move_to(4.3, 1e-9, "gauss").t == 4.3
    back = m.move_to(1.0, 1e-12, "vern9")
    assert back.t == 1.0
    assert np.abs(back.x - HEAVY).max() < 1e-6
    inside = m.move(0.05, 2, "gauss").dense(m.t - 0.02)
    assert np.abs(inside - top.begin(HEAVY, t=1.0).move_to(m.t - 0.02, 1e-13).x).max() < 1e-6
