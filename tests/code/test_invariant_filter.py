"""The emitted filter of kinematics of first order, beside one that is written here with NumPy.

The error moves linearly in its logarithm, also where it is large; the update is Kalman's; the error
at the end of many runs has the covariance that the filter says (the mean of the normalised squared
error is that of χ² with as many degrees of freedom as the group has dimensions).
"""

import ctypes
import subprocess
import tomllib
from functools import cache

import numpy as np
import pytest

import derive
from derive.command.cli import main
from derive.problem.toml import problem_of
from tests.support.cached import ROOT
from tests.support.needs import CC

D = 9


@cache
def data():
    return tomllib.loads((ROOT / "derive/problems/imu.toml").read_text(encoding="utf-8"))


@cache
def imu(side="left"):
    """The compiled filter of the ready-made problem, with an error on one side."""
    own = data() | {"kinematics": data()["kinematics"] | {"error": side}}
    found = derive.derive(problem_of(own))
    return derive.compile(found, step=("rk4", "vern9"), exponential=True)


# -- the same with NumPy --------------------------------------------------------------------------


def hat(xi):
    """Σ ξ_a E_a in the basis of the problem."""
    x, y, z = xi[:3]
    m = np.zeros((5, 5))
    m[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    m[:3, 3], m[:3, 4] = xi[3:6], xi[6:]
    return m


def vee(m):
    return np.array([m[2, 1], m[0, 2], m[1, 0], *m[:3, 3], *m[:3, 4]])


def series(m, terms=40):
    """exp m."""
    total = power = np.eye(len(m))
    for k in range(1, terms):
        power = power @ m / k
        total = total + power
    return total


def logarithm(g):
    """By square roots and the series of log, which the emitted one is not."""
    values, vectors = np.linalg.eig(g[:3, :3])
    R = (vectors * np.log(values)) @ np.linalg.inv(vectors)
    W = R.real
    whole, power = np.zeros((3, 3)), np.eye(3)
    for k in range(60):  # the left Jacobian
        whole, power = whole + power, power @ W / (k + 2)
    m = np.zeros((5, 5))
    m[:3, :3], m[:3, 3:] = W, np.linalg.solve(whole, g[:3, 3:])
    return vee(m)


def velocity(g, u, gravity=9.81):
    f = np.zeros((5, 5))
    f[:3, :3] = g[:3, :3] @ hat([*u[:3], *[0] * 6])[:3, :3]
    f[:3, 3] = g[:3, :3] @ u[3:] - [0, 0, gravity]
    f[:3, 4] = g[:3, 3]
    return f


def generator(u, side, gravity=9.81):
    w, a = (hat([*x, *[0] * 6])[:3, :3] for x in (u[:3], u[3:]))
    A = np.zeros((D, D))
    A[6:, 3:6] = np.eye(3)
    if side == "left":
        for k in (0, 3, 6):
            A[k : k + 3, k : k + 3] = -w
        A[3:6, :3] = -a
    else:
        A[3:6, :3] = hat([0, 0, -gravity, *[0] * 6])[:3, :3]
    return A


def adjoint(g):
    back = np.linalg.inv(g)
    return np.array([vee(g @ hat(e) @ back) for e in np.eye(D)]).T


def unpacked(x):
    """The estimate and the covariance in a state."""
    g = np.eye(5)
    g[:3] = np.reshape(x[:15], (3, 5))
    P = np.zeros((D, D))
    P[np.triu_indices(D)] = x[15:]
    return g, P + np.triu(P, 1).T


def packed(g, P):
    return np.array([*g[:3].ravel(), *P[np.triu_indices(D)]])


def rates(x, u, side, Q):
    g, P = unpacked(x)
    A = generator(u, side)
    G = np.eye(D)[:, :6] if side == "left" else (adjoint(g) @ np.eye(D)[:, :6])
    f = velocity(g, u)
    return np.array([*f[:3].ravel(), *(A @ P + P @ A.T + G @ Q @ G.T)[np.triu_indices(D)]])


def updated(x, o, Y, N, side, seen):
    """Kalman's update; H by the definition of the error."""
    g, _ = unpacked(x)
    B = g if seen == "left" else np.linalg.inv(g)
    sign = 1 if seen == "left" else -1
    columns = [sign * (B @ hat(e) @ o if side == seen else hat(e) @ B @ o)[:3] for e in np.eye(D)]
    return corrected(x, Y - (B @ o)[:3], np.array(columns).T, N, side)


def corrected(x, z, H, N, side):
    """Kalman's update, its gain by an inverse, by the innovation z."""
    g, P = unpacked(x)
    S = H @ P @ H.T + N
    K = P @ H.T @ np.linalg.inv(S)
    change = series(hat(K @ z))
    moved = g @ change if side == "left" else change @ g
    return packed(moved, P - K @ S @ K.T)


def drawn(seed):
    """A state and inputs."""
    random = np.random.default_rng(seed)
    root = random.normal(size=(D, D))
    x = packed(series(hat(random.normal(size=D))), root @ root.T)
    return random, x, random.normal(size=6) * [1, 1, 1, 5, 5, 5]


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_rates_are_those_of_a_filter_with_numpy(side):
    filtering = imu(side)
    for seed in range(5):
        _, x, u = drawn(seed)
        Q = np.diag([1e-4] * 3 + [1e-2] * 3)
        found = filtering.rhs(0.0, x, u)
        wanted = rates(x, u, side, Q)
        assert np.allclose(found, wanted, rtol=0, atol=1e-12 * np.abs(wanted).max())


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize("seen", ["left", "right"])
def test_the_update_is_that_of_a_filter_with_numpy(side, seen):
    filtering = imu(side)
    for seed in range(5):
        random, x, _ = drawn(seed)
        o, Y = random.normal(size=5), random.normal(size=3)
        root = random.normal(size=(3, 3))
        N = root @ root.T + np.eye(3)
        found = getattr(filtering, f"update_{seen}")(x, o, Y, N)
        wanted = updated(x, o, Y, N, side, seen)
        assert np.allclose(found, wanted, rtol=0, atol=1e-12 * max(1, np.abs(wanted).max()))


@pytest.mark.parametrize("side", ["left", "right"])
def test_an_update_by_any_observation(side):
    """A distance and a speed, two numbers of three; their H by differences along the error."""
    filtering = imu(side)

    def h(g):
        return np.array([np.linalg.norm(g[:3, 4] - [1, 2, 3]), np.linalg.norm(g[:3, 3])])

    for seed in range(5):
        random, x, _ = drawn(seed)
        g, step = unpacked(x)[0], 1e-6
        ends = [
            [h(g @ series(hat(s * e)) if side == "left" else series(hat(s * e)) @ g)
             for s in (step, -step)]
            for e in np.eye(D)
        ]  # fmt: skip
        H = np.array([(a - b) / (2 * step) for a, b in ends]).T
        z, N = random.normal(size=2), np.diag([0.1, 0.4])
        wanted = corrected(x, z, H, N, side)
        whole = np.vstack([H, np.zeros(D)])
        found = filtering.update(x, [*z, 0], whole, np.diag([0.1, 0.4, 1]))
        assert np.allclose(found, wanted, rtol=0, atol=1e-12 * max(1, np.abs(wanted).max()))


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_logarithm_of_a_large_error_moves_linearly(side):
    """Two emitted motions by the same inputs, and exp of the emitted 𝒜."""
    filtering = imu(side)
    random, x, u = drawn(1)
    g, P = unpacked(x)
    xi = random.normal(size=D) * [0.8, 0.8, 0.8, *[5] * 6]
    change = series(hat(xi))
    other = packed(g @ change if side == "left" else change @ g, P)
    ends = []
    for start in (x, other):
        filtering.u = u
        ends.append(unpacked(filtering.begin(start).move(0.01, 100, "vern9").x)[0])
    first, second = ends
    back = np.linalg.inv(first)
    error = logarithm(back @ second if side == "left" else second @ back)
    wanted = series(generator(u, side)) @ xi
    assert np.linalg.norm(wanted) > 5
    assert np.allclose(error, wanted, rtol=0, atol=1e-9)


# -- many runs ------------------------------------------------------------------------------------

RUNS, SECONDS, H = 1000, 10.0, 0.05
FILTER = """
#include "imu.h"
#include "imu_group.h"
#include "imu_steps.h"

/* One run: inputs u of the filter and their noise w at each step, the place seen after it. */
void run(double h, int steps, const double *k, const double *u, const double *w, const double *v,
         double variance, double *truth, double *estimate)
{
    const double o[5] = {0, 0, 0, 0, 1};
    const double N[9] = {variance, 0, 0, 0, variance, 0, 0, 0, variance};
    imu_motion moved, followed;
    imu_begin(&moved, 0, truth);
    imu_begin(&followed, 0, estimate);
    for (int i = 0; i < steps; i++) {
        double given[6], Y[3], after[imu_N_STATE];
        for (int j = 0; j < 6; j++)
            given[j] = u[6*i + j] + w[6*i + j];
        imu_rk4(&moved, k, given, h, 1);
        imu_rk4(&followed, k, u + 6*i, h, 1);
        for (int j = 0; j < 3; j++)
            Y[j] = moved.x[5*j + 4] + v[3*i + j];
        imu_update_left(followed.x, o, Y, N, after);
        imu_begin(&followed, followed.t, after);
    }
    for (int i = 0; i < imu_N_STATE; i++) {
        truth[i] = moved.x[i];
        estimate[i] = followed.x[i];
    }
}
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The function above, compiled with what is emitted."""
    folder = tmp_path_factory.mktemp("imu")
    main(["emit", "imu", "--lang", "c", "--exponential", "--step", "rk4", "--out", str(folder)])
    (folder / "run.c").write_text(FILTER, encoding="utf-8")
    command = [CC, "-std=c99", "-O2", "-fPIC", "-shared", "run.c", "imu.c", "-o", "run.so", "-lm"]
    subprocess.run(command, cwd=folder, check=True)
    found = ctypes.CDLL(str(folder / "run.so")).run
    found.restype = None
    return found


def test_the_error_of_many_runs_has_the_covariance_of_the_filter(run):
    random, steps = np.random.default_rng(7), int(SECONDS / H)
    times = np.arange(steps) * H
    u = np.array([0.3 * np.sin(times), 0.2 * np.cos(2 * times), 0.4 + 0 * times,
                  np.sin(times), 2 * np.cos(times), 9.81 + 0 * times]).T.copy()  # fmt: skip
    Q, variance = np.array([1e-4] * 3 + [1e-2] * 3), 0.04
    start = np.diag([0.1**2] * 3 + [0.3**2] * 3 + [0.5**2] * 3)
    k = np.array([9.81, 1e-4, 1e-2])
    assert tuple(imu().PARAMETERS) == ("g", "q_w", "q_a")
    assert np.array_equal(imu().k, k)
    pointers = [ctypes.c_double] + [ctypes.c_int] + [ctypes.c_void_p] * 4
    run.argtypes = [*pointers, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p]
    squares = []
    for _ in range(RUNS):
        first = series(hat(random.normal(size=D)))
        xi = random.normal(size=D) * np.sqrt(np.diag(start))
        estimate, truth = packed(first, start), packed(first @ series(hat(xi)), start)
        w = random.normal(size=(steps, 6)) * np.sqrt(Q / H)
        v = random.normal(size=(steps, 3)) * np.sqrt(variance)
        arrays = [x.ctypes.data for x in (k, u, w, v)]
        run(H, steps, *arrays, variance, truth.ctypes.data, estimate.ctypes.data)
        g, P = unpacked(estimate)
        error = logarithm(np.linalg.inv(g) @ unpacked(truth)[0])
        squares.append(error @ np.linalg.solve(P, error))
    assert abs(np.mean(squares) - D) < 0.35
