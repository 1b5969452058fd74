"""The emitted step of order 16: its order, what it keeps, what it says where it cannot go on."""

import subprocess

import numpy as np
import pytest
from scipy.special import ellipj

import derive
from tests.problems.line import FALLING
from tests.support.emitted import import_python
from tests.support.motions import follow
from tests.support.needs import CC, need

TOP = (1.3, 0.1, 0.05, 0.9, -0.07, 0.4)
AT_ONE = [1.0, 0, 0, 0, 1, 0, 0, 0, 1]
WIDTHS = {
    "all": ("-O3", "-march=native"),
    "four": ("-O3", "-march=native", "-Dso3_LANES=4"),
    "loops": ("-O3", "-march=native", "-Dso3_LANES=1"),
    "plain": ("-O0",),
}
COMMON = ("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-fPIC", "-shared")


def heavy(f):
    """A state of the heavy top."""
    return np.array([*AT_ONE, 0.1, 0, 9])


@pytest.fixture(scope="module")
def top():
    return derive.compile("so3", step="gauss")


def moved(f, x, h, n):
    return f.begin(x).move(h, n).x


def test_the_order_is_16(top):
    """Between steps whose errors are far above rounding."""
    x = heavy(top)
    exact = top.begin(x).move_to(3.0, tol=1e-15).x
    large, small = (np.abs(moved(top, x, 3 / n, n) - exact).max() for n in (8, 12))
    assert 13 < np.log(large / small) / np.log(1.5) < 19


def test_forward_and_back(top):
    x, m = heavy(top), top.begin(heavy(top))
    m.move(0.1, 100)
    assert np.abs(m.move(-0.1, 100).x - x).max() < 1e-12
    assert m.t == 0


def test_the_time_of_an_adaptive_motion_is_that_asked_for(top):
    m = top.begin(heavy(top), t=1.0)
    assert m.move_to(4.3, 1e-9).t == 4.3
    back = m.move_to(1.0, 1e-12)
    assert back.t == 1.0
    assert np.abs(back.x - heavy(top)).max() < 1e-6


def test_every_width_is_the_same_motion():
    """In lanes of each width, in loops, and without any optimisation."""
    found = []
    for flags in WIDTHS.values():
        f = derive.compile("so3", step="gauss", flags=(*COMMON, *flags))
        found += [(moved(f, heavy(f), 0.1, 50), f.begin(heavy(f)).move_to(5.0, 1e-9).x)]
    for a, b in found[1:]:
        assert np.abs(a - found[0][0]).max() < 1e-12
        assert np.abs(b - found[0][1]).max() < 1e-8


def test_python_makes_the_same_steps(top, tmp_path):
    derive.derive("so3").emit(tmp_path, ("python",), step="gauss")
    module = import_python("so3", tmp_path)
    k, u, x = module.constants(top.p), np.zeros(3), heavy(top)
    m = module.begin(0.0, x)
    assert module.gauss(m, k, u, 0.1, 20) == module.OK
    own = top.begin(x).move(0.1, 20)
    assert np.abs(m.x - own.x).max() < 1e-13
    inside = m.t - 0.03
    assert np.abs(module.dense(m, inside) - own.dense(inside)).max() < 1e-13
    assert module.gauss_to(m, k, lambda t, x: u, 5.0, 1e-12) == module.OK
    assert np.abs(m.x - top.begin(x).move_to(5.0, 1e-12).x).max() < 1e-10


def test_within_a_step(top):
    """The polynomial of a step has order 9 at least between its ends."""
    x, errors = heavy(top), []
    for h in (0.4, 0.2):
        m = top.begin(x).move(h)
        part = 0.37 * h
        errors.append(np.abs(m.dense(part) - top.begin(x).move_to(part, 1e-15).x).max())
        assert np.abs(m.dense(h) - m.x).max() < 1e-14
        assert np.abs(m.dense(0.0) - x).max() < 1e-14
    assert np.log2(errors[0] / errors[1]) > 8


def test_the_free_top_is_that_of_elliptic_functions(top):
    """ζ of moments I₁ > I₂ > I₃, on the side of I₁ of the separatrix."""
    I1, I2, I3 = 4.0, 3.0, 2.0
    J = [(I2 + I3 - I1) / 2, 0, 0, (I1 + I3 - I2) / 2, 0, (I1 + I2 - I3) / 2]
    top.use([0, 0, 0, *J, 0, 0, 0])
    a, c = 1.1, 0.4  # ζ(0) = (a, 0, c)
    k2 = I3 * (I2 - I3) * c**2 / (I1 * (I1 - I2) * a**2)
    rate = a * np.sqrt((I1 - I2) * (I1 - I3) / (I2 * I3))
    b = c * np.sqrt(I3 * (I1 - I3) / (I2 * (I1 - I2)))
    m = top.begin([*AT_ONE, a, 0, c])
    for t in (1.0, 30.0, 100.0):
        sn, cn, dn, _ = ellipj(rate * t, k2)
        exact = np.array([a * dn, b * sn, c * cn])
        found = m.move_to(t, 1e-13).x[9:]
        assert min(np.abs(found - exact * [1, s, 1]).max() for s in (1, -1)) < 1e-11 * t**0.5
    top.use()


@pytest.mark.parametrize(
    ("problem", "choices"),
    [
        ("so3", {"attitude": "quaternion"}),
        ("so3", {"frame": "principal"}),
        ("se3", {}),
        ("se3", {"layout": "col"}),
        ("sl3", {"velocity": "tangent"}),
        ("top", {}),
        ("sp4", {}),
        ("heisenberg", {}),
        ("two_tops", {}),
        ("riemann_ellipsoid", {}),
        ("zeitlin", {}),
        ("comet", {}),
        ("gyrostat", {}),
    ],
)
def test_every_form_of_the_state(problem, choices):
    """Against SciPy, and on the group; with the warnings of compilers as errors."""
    f = derive.compile(  # -Wrestrict: k of no numbers, in the array that the binding has
        problem, step="gauss", flags=(*COMMON, "-O2", "-march=native", "-Wno-restrict"), **choices
    )
    rng = np.random.default_rng(3)
    defaults = {x: v for x, v in f._names.defaults.items() if v is None}
    f.use(dict.fromkeys(defaults, 0.7))
    x = start(f, rng, choices)
    m = f.begin(x).move_to(0.3, 1e-12)
    from scipy.integrate import solve_ivp

    exact = solve_ivp(f.rhs, (0, 0.3), x, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    assert np.abs(m.x - exact).max() < 1e-9 * max(1, np.abs(exact).max())


def start(f, rng, choices):
    """A state near the identity, of small velocity."""
    x = []
    for name in f.STATE:
        head, _, place = name.partition("_")
        velocity = head[0] not in "ATq" or head[1:2] == "d"
        one = (place in ("11", "22", "33", "44") and head[0] == "A") or name in ("q_0", "q_1")
        x.append(0.2 * rng.normal() if velocity else float(one))
    if choices.get("velocity") == "tangent":
        half = len(x) // 2
        x[half:] = np.array([0.1, 0.2, 0, -0.1, 0.05, 0.1, 0.2, 0, -0.15])
    if "mu" in f.PARAMETERS:
        x[9:12] = [2, 0, 0]  # away from the centre of attraction
    if choices.get("attitude") == "quaternion":
        x[:4] = [1, 0, 0, 0]
    return np.array(x)


def test_inputs_as_a_function_of_time(tmp_path):
    """A torque that changes within a step: against SciPy."""
    source = """
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
        if (so3_gauss_to(&m, k, 0, 2, 1e-12)) return 1;
        for (int i = 0; i < so3_N_STATE; ++i) printf("%.17g ", m.x[i]);
        return 0;
    }
    """
    derive.derive("so3").emit(tmp_path, ("c",), step="gauss")
    (tmp_path / "main.c").write_text(source)
    flags = ["-std=c99", "-O1", "-march=native", "-fsanitize=address,undefined"]
    built = [CC, *flags, "main.c", "so3.c", "-o", "main", "-lm"]
    subprocess.run(built, cwd=tmp_path, check=True)
    printed = subprocess.run("./main", cwd=tmp_path, check=True, capture_output=True, text=True)
    f = derive.compile("so3")
    f.use([0, 0, 0.2, 1.3, 0.1, 0, 0.9, 0, 0.4, 0, 0, -9.81])
    from scipy.integrate import solve_ivp

    exact = solve_ivp(
        lambda t, x: f(t, x, [2 * np.cos(3 * t), 0, 0]),
        (0, 2),
        [*AT_ONE, 0.1, 0, 9],
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
    ).y[:, -1]
    assert np.abs(np.array(printed.stdout.split(), dtype=float) - exact).max() < 1e-9


def test_a_coarse_step_is_made_in_halves(top):
    """One whose iteration does not converge: the motion is the same but for the error."""
    x = heavy(top)
    exact = top.begin(x).move_to(4.0, 1e-14).x
    assert np.abs(moved(top, x, 2.0, 2) - exact).max() < 1e-2


def test_no_number_is_no_motion(top):
    m = top.begin([*AT_ONE, np.nan, 0, 0])
    with pytest.raises(derive.StepError, match="no finite value at t = 0"):
        m.move(0.1)
    with pytest.raises(derive.StepError, match="no finite value"):
        m.move_to(1.0)


@pytest.mark.parametrize("step", ["gauss", "vern9"])
@pytest.mark.parametrize("language", ["c", "python", "javascript", "rust"])
def test_a_motion_goes_on_after_a_step_of_no_size(tmp_path, language, step):
    """It is as it was; and a tolerance that is no number is the least one."""
    d = derive.derive("so3")
    d.emit(tmp_path, (language,), step=step)
    calls = [(step, np.nan, 1), (f"{step}_to", 1.0, 1e-12), (f"{step}_to", 2.0, np.nan)]
    x, p = [*AT_ONE, 0.1, 0, 9], derive.compile("so3").p
    none, first, second = follow(language, tmp_path, "so3", calls, x, p, np.zeros(3))
    assert none.status in (2, 3)
    assert (none.t, none.x.tolist()) == (0, x)
    f = derive.compile("so3", step="gauss")
    for place, t in ((first, 1.0), (second, 2.0)):
        assert (place.status, place.t) == (0, t)
        assert np.abs(place.x - f.begin(x).move_to(t, 1e-15).x).max() < 1e-9


def test_a_collision_stops_before_it(tmp_path):
    """A point falls from rest at 1 into the centre, which it reaches after pi/sqrt(8)."""
    (tmp_path / "line.toml").write_text(FALLING)
    f = derive.compile(tmp_path / "line.toml", step="gauss")
    at_rest = [float(name in ("A_11", "A_22", "T_1")) for name in f.STATE]
    m = f.begin(at_rest)
    with pytest.raises(derive.StepError, match=r"too short|no finite value"):
        m.move_to(10.0, 1e-9)
    assert np.isfinite(m.x).all()
    assert abs(m.t - np.pi / np.sqrt(8)) < 1e-6


def test_what_is_kept_to_rounding(top):
    """Energy under gravity and the momentum about the vertical, over 20 000 steps."""
    x, m = heavy(top), top.begin(heavy(top))
    energy = top.energy(0, x)
    m.move(0.1, 20_000)
    assert abs(top.energy(0, m.x) - energy) < 1e-11 * abs(energy)
    assert top.defect(m.x) < 2e-15


def test_wrong_words(top):
    with pytest.raises(ValueError, match="no step 'euler' was compiled; there is gauss"):
        top.begin(heavy(top)).move(0.1, step="euler")
    for h, n in ((np.nan, 1), (np.inf, 1), (0.1, -1)):
        with pytest.raises(ValueError, match=f"n = {n}, h = {h}"):
            top.begin(heavy(top)).move(h, n)
    for tol in (0, -1.0, np.nan):
        with pytest.raises(ValueError, match="tol must be positive"):
            top.begin(heavy(top)).move_to(1.0, tol)
    with pytest.raises(ValueError, match="a state of 12 numbers"):
        top.begin([1.0])
    with pytest.raises(ValueError, match='step="gauss"'):
        derive.compile("so3").begin(heavy(top))


def test_a_start_is_on_the_group(top):
    """Up to what rounding, or some digits in a file, leave of it."""
    x = heavy(top)
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


@pytest.mark.parametrize("compiler", ["gcc -std=c99", "g++ -std=c++17", "clang -std=c99"])
def test_it_compiles_strictly_for_this_machine(tmp_path, compiler):
    """With the square roots of lanes, of springs: headers of GCC 12 warn of their own."""
    need(compiler.split()[0])
    (tmp_path / "line.toml").write_text(FALLING)
    derive.derive(tmp_path / "line.toml").emit(tmp_path, ("c",), step="gauss")
    text = (tmp_path / "line_steps.h").read_text()
    assert "line_sqrt_lanes(" in text
    assert "1e-15" in text.partition("#ifndef")[0]  # what a tolerance of 0 is taken for
    source = tmp_path / ("all.cpp" if compiler.startswith("g++") else "all.c")
    calls = "line_gauss_to(m, k, u, 1.0, 1e-9)"
    source.write_text(
        '#include "line_steps.h"\n'
        "int go(line_motion *m, const double *k, const double *u);\n"
        f"int go(line_motion *m, const double *k, const double *u) {{ return {calls}; }}\n"
    )
    strict = ["-O3", "-march=native", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-c"]
    subprocess.run([*compiler.split(), *strict, source.name], check=True, cwd=tmp_path)
