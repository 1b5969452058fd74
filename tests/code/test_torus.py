"""The emitted code of a fluid on the torus: C, Python and plain sums; what is kept; languages."""

import re
from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive.problem.toml import problem_of
from tests.oracles import relative_error, torus
from tests.support.library import ONE_BUILD, STEPPED, emission, library, module_of
from tests.support.needs import need

SIZES = (3, 9, 31, 5, 7, 11)


@cache
def fluid(N):
    algebra, inertia = {"of": "torus", "N": N}, {"operator": "laplacian"}
    return problem_of({"name": f"fluid{N}", "algebra": algebra, "inertia": inertia})


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
