"""The emitted code of a fluid on the torus: C, Python and plain sums; what is kept; languages."""

import re
import subprocess
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import derive
from derive.code.options import Options
from derive.pipeline import walk
from derive.problem.toml import problem_of
from derive.programs import program
from tests.oracles import relative_error, torus
from tests.support.corpus import STIRRED
from tests.support.library import ONE_BUILD, STEPPED, built, emission, library, module_of
from tests.support.needs import CC, need

SIZES = (3, 9, 31, 5, 7, 11)


@cache
def fluid(N):
    return problem_of(told(N))


def told(N):
    algebra, inertia = {"of": "torus", "N": N}, {"operator": "laplacian"}
    return {"name": f"fluid{N}", "algebra": algebra, "inertia": inertia}


@cache
def stirred(N):
    return problem_of(told(N) | STIRRED)


def drag(N, kappa, nu):
    """κ + ν|n|⁴ for each number of the state."""
    return np.array([kappa + nu * (a * a + b * b) ** 2 for a, b in torus.half_plane(N)]).repeat(2)


def close(found, expected):
    assert relative_error(found, expected) <= 1e-12


@pytest.mark.parametrize("N", SIZES)
def test_c_python_and_plain_sums_agree(N):
    need("cc")
    m, c = module_of(fluid(N), conserved=True), library("c", fluid(N), conserved=True)
    x = np.random.default_rng(N).normal(size=N * N - 1)
    k = m.constants([])
    status, in_c = c.constants(np.zeros(0))
    assert status == 0
    expected = torus.rates(N, x)
    close(m.rhs(0.0, x, k), expected)
    close(c.rhs(0.0, x, in_c), expected)
    close(m.energy(0.0, x, k), torus.energy(N, x))
    close(c.energy(0.0, x, in_c), torus.energy(N, x))
    close(m.conserved(0.0, x, k), torus.traces(N, x))
    both = np.stack([x, 2 * x, x[::-1]], axis=-1)
    close(c.rhs_batch(0.0, both, in_c).T, m.rhs(0.0, both.T, k))
    assert m.STATE[:4] == (
        "re_1_0",
        "im_1_0",
        *(("re_m1_1", "im_m1_1") if N == 3 else m.STATE[2:4]),
    )


@pytest.mark.parametrize("N", SIZES)
def test_forcing_and_drag_are_added_to_plain_sums(N):
    need("cc")
    m, c = module_of(stirred(N)), library("c", stirred(N))
    x, u = np.random.default_rng(N).normal(size=(2, N * N - 1))
    k, (status, in_c) = m.constants({"nu": 0.07, "kappa": 0.4}), c.constants(np.array([0.4, 0.07]))
    assert status == 0
    still = torus.rates(N, x) - drag(N, 0.4, 0.07) * x
    close(m.rhs(0.0, x, k, u), still + u)
    close(c.rhs(0.0, x, in_c, u), still + u)
    close(m.rhs(0.0, x, k), still)
    several = np.stack([x, -x, x[::-1]], axis=-1), np.stack([u, u[::-1], 3 * u], axis=-1)
    found = c.rhs_batch(0.0, several[0], in_c, several[1]).T
    close(found, m.rhs(0.0, several[0].T, k, several[1].T))
    assert m.PARAMETERS == ("kappa", "nu")
    assert m.INPUTS[:2] == ("f_re_1_0", "f_im_1_0")


@pytest.mark.parametrize("N", [3, 5, 7, 9])
def test_jacobians_are_the_derivatives_of_plain_sums(N):
    """Of a form of degree 2 half a difference of values is the derivative; damping is linear in its
    coefficients."""
    need("cc")
    chosen = {"jacobian": ("state", "inputs", "parameters")}
    m, c = module_of(stirred(N), **chosen), derive.compile(stirred(N), **chosen)
    x, u = np.random.default_rng(N).normal(size=(2, N * N - 1))
    p, each = np.array([0.4, 0.07]), np.eye(N * N - 1)
    c.use(p)
    moved = [(torus.rates(N, x + e) - torus.rates(N, x - e)) / 2 for e in each]
    by_state = np.transpose(moved) - np.diag(drag(N, *p))
    by_parameters = np.transpose([-drag(N, *e) * x for e in np.eye(2)])
    for rates, D in (m.jacobian(0.0, x, m.constants(p), u), c.jacobian(0.0, x, u)):
        close(rates, torus.rates(N, x) - drag(N, *p) * x + u)
        close(D, by_state)
    for D in (m.jacobian_inputs(0.0, x, m.constants(p), u), c.jacobian_inputs(0.0, x, u)):
        assert np.array_equal(D, each)
    for D in (m.jacobian_parameters(0.0, x, p, u), c.jacobian_parameters(0.0, x, u)):
        close(D, by_parameters)
    several = np.stack([2 * x, x])
    found = m.jacobian(0.0, several, m.constants(p), u)[1], m.jacobian_parameters(0.0, several, p)
    close(found[0][1], by_state)
    close(found[1], np.stack([2 * by_parameters, by_parameters]))


@pytest.mark.parametrize("N", [5, 9])
def test_one_wave_that_is_forced_goes_to_rest_against_drag(N):
    """x(t) = x₀ e^(−λt) + u (1 − e^(−λt))/λ, as one wave alone is steady in Euler's equation."""
    m = module_of(stirred(N))
    x, u = np.zeros((2, N * N - 1))
    x[m.STATE.index("im_2_1")], u[m.INPUTS.index("f_im_2_1")] = 0.7, -0.3
    k, rate = m.constants([0.3, 0.02]), 0.3 + 0.02 * 25
    path = solve_ivp(m.rhs, (0, 2), x, "DOP853", args=(k, u), rtol=1e-12, atol=1e-14)
    left = np.exp(-2 * rate)
    assert np.abs(path.y[:, -1] - x * left - u * (1 - left) / rate).max() < 1e-11


@pytest.mark.parametrize("N", [5, 9])
def test_the_energy_changes_by_the_power_of_what_acts(N):
    """Along a motion the energy less the integral of Σ f̄ω/|n|² − Σ (κ + ν|n|⁴)|ω|²/|n|² stays."""
    m = module_of(stirred(N))
    rng = np.random.default_rng(2)
    x, u = rng.normal(size=(2, N * N - 1)) / N
    k, squares = m.constants([0.3, 0.02]), drag(N, 0, 1) ** 0.5

    def both(t, y):
        power = 2 * np.sum((u - drag(N, 0.3, 0.02) * y[:-1]) * y[:-1] / squares)
        return [*m.rhs(t, y[:-1], k, u), power]

    path = solve_ivp(both, (0, 4), [*x, 0.0], "DOP853", rtol=1e-12, atol=1e-13)
    last = path.y[:, -1]
    done = torus.energy(N, last[:-1]) - torus.energy(N, x)
    assert abs(done) > 1e-2
    assert abs(done - last[-1]) < 1e-9


def test_floats():
    x = np.random.default_rng(0).normal(size=120)
    m = module_of(fluid(11), real="float")
    found = m.rhs(0.0, x.astype(np.float32), m.constants([]).astype(np.float32))
    assert found.dtype == np.float32
    assert np.abs(found - torus.rates(11, x)).max() < 1e-4


@pytest.mark.parametrize("N", [5, 9, 15])
def test_energy_and_traces_are_kept(N):
    m = module_of(fluid(N), conserved=True)
    k = m.constants([])
    x = np.random.default_rng(1).normal(size=N * N - 1) / N
    path = solve_ivp(m.rhs, (0, 10), x, "DOP853", args=(k,), rtol=1e-12, atol=1e-13)
    last = path.y[:, -1]
    assert np.abs(last - x).max() > 1e-2
    for kept in (m.energy, m.conserved):
        assert np.abs(kept(0.0, last, k) - kept(0.0, x, k)).max() < 1e-9


def test_one_header_and_a_prefix():
    _, texts = emission(fluid(9), ("c",), "flow", form="header")
    assert [*texts] == ["flow.h"]
    assert "flow_FUNCTION void flow_transform(" in texts["flow.h"]


def test_the_shift_of_the_header_has_its_bracket():
    """h e_j = e_(j-1), as the head of a file says, and not the other one."""
    said = re.search(r"h e_j = e_\(j([-+])1\)", emission(fluid(9), ("c",))[1]["fluid9.h"])[1]
    N = 7
    w, j = np.exp(2j * np.pi / N), np.arange(N)
    for sign, step in (("-", -1), ("+", 1)):
        g, h = np.diag(w ** (2 * j)), np.eye(N)[:, (j + step) % N]
        assert np.array_equal(h @ np.eye(N)[2], np.eye(N)[2 + step])
        T = {
            (a, b): w ** (a * b) * np.linalg.matrix_power(g, a) @ np.linalg.matrix_power(h, b)
            for a, b in ((1, 2), (3, 1), (4, 3))
        }
        found = T[1, 2] @ T[3, 1] - T[3, 1] @ T[1, 2]
        expected = -2j * np.sin(2 * np.pi * (1 * 1 - 2 * 3) / N) * T[4, 3]
        assert np.allclose(found, expected) == (sign == said)


def test_written_out_up_to_five():
    found = {N: program(fluid(N), walk(fluid(N))) for N in (3, 5, 7)}
    assert [bool(p.loops) for p in found.values()] == [False, False, True]
    assert found[3].functions["rhs"].operations()["mul"] <= 32
    tables = program(fluid(5), walk(fluid(5)), Options(conserved=True)).loops
    assert tables.names == {"conserved"}


@pytest.mark.parametrize("build", [ONE_BUILD[x] for x in ("rust", "javascript", "julia")])
def test_the_rates_are_those_of_c_to_the_bit(build):
    x = np.random.default_rng(3).normal(size=9 * 9 - 1)
    (known,), (found,) = (
        library(y, fluid(9), step="rk4").follow([("rk4", 0.01, 3)], x) for y in ("c", build)
    )
    assert found.x.tolist() == known.x.tolist()


@pytest.mark.parametrize("build", [ONE_BUILD[x] for x in STEPPED])
def test_the_vorticity_is_measured_as_one(build):
    """Of a smooth flow, whose least modes are nothing but rounding, a tolerance is kept by steps
    that its order makes, not by those that rounding would."""
    N, T = 11, 1.0
    rng = np.random.default_rng(5)
    squares = np.array([a * a + b * b for a, b in torus.half_plane(N)]).repeat(2)
    x = np.exp(-2 * squares) * rng.normal(size=N * N - 1)
    commands = [("vern9_to", T, 1e-9), ("begin", 0, 0), ("vern9_to", T, 1e-12)]
    coarse, _, fine = library(build, fluid(N), step="vern9").follow(commands, x)
    path = solve_ivp(lambda t, y: torus.rates(N, y), (0, T), x, "DOP853", rtol=1e-13, atol=1e-15)
    for end, tol in ((coarse, 1e-9), (fine, 1e-12)):
        assert end.status == 0
        assert np.abs(end.x - path.y[:, -1]).max() < 20 * tol * np.abs(x).max()
    assert 1 <= coarse.h / fine.h < 6  # 1000^(1/9) = 2.2, but for where the last step ends


def test_the_header_says_what_memory_a_step_takes():
    """Without optimisation, in a process that has no more stack than that."""
    need("cc")
    _, texts = emission(fluid(31), ("c",), step=("gauss", "vern9"))
    motion, within = map(int, re.findall(r"(\d+) kB", texts["fluid31_steps.h"]))
    rhs = int(re.search(r"(\d+) kB", texts["fluid31.h"])[1])
    words = (CC, "-O0", "main.c", "fluid31.c", "-o", "out", "-lm")
    program = built([words], texts | {"main.c": MEMORY})
    command = f"ulimit -s {within + rhs + 128} && {program}"
    done = subprocess.run(["sh", "-c", command], check=True, capture_output=True)
    assert abs(motion - int(done.stdout) / 1024) < 0.02 * motion


MEMORY = """
#include "fluid31_steps.h"
#include <stdio.h>
static fluid31_motion m;
static double x[fluid31_N_STATE];
int main(void)
{
    double k[fluid31_SIZE_K], nothing[1] = {0};
    x[0] = x[61] = 1;
    fluid31_constants(nothing, k);
    fluid31_begin(&m, 0, x);
    printf("%d\\n", (int)sizeof m);
    return fluid31_gauss_to(&m, k, nothing, 0.1, 1e-9)
        || fluid31_vern9_to(&m, k, nothing, 0.2, 1e-9);
}
"""
