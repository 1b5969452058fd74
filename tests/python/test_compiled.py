"""derive.compile: the emitted C from Python, ready for solve_ivp and other solvers."""

import copy
import multiprocessing
import pickle
import re
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import derive
from tests.support.library import module_of
from tests.support.needs import needs

pytestmark = needs("cc")


@pytest.fixture(scope="module")
def top():
    return derive.compile("so3", jacobian=("state",))


START = np.concatenate([np.eye(3).ravel(), [0.1, 0, 9]])


def test_it_is_the_emitted_python(top):
    m = module_of("so3", jacobian=("state",))
    k = m.constants(top.p)
    assert top.PARAMETERS == m.PARAMETERS
    assert np.allclose(top.k, k, rtol=1e-14)
    rng = np.random.default_rng(1)
    for _ in range(5):
        x, u = rng.normal(size=12), rng.normal(size=3)
        assert np.allclose(top(0, x, u), m.rhs(0, x, k, u), rtol=1e-13)
        assert np.isclose(top.energy(0, x), m.energy(0, x, k), rtol=1e-13)
        dx, D = top.jacobian(0, x)
        assert np.allclose(dx, top.rhs(0, x))
        assert D.shape == (6, 6)


def test_results_are_not_overwritten(top):
    first = top(0, START)
    kept = first.copy()
    top(0, 2 * START)
    assert np.array_equal(first, kept)


@pytest.mark.parametrize(
    ("x", "found"),
    [([1] * 5, "5"), (2.0, "1"), ([2.0], "1"), (np.ones((12, 2)), r"an array \(12, 2\)")],
)
def test_other_than_a_state(top, x, found):
    """Neither of another length nor, as NumPy has it, one number for all."""
    for call in (top, top.energy, top.jacobian, top.conserved):
        with pytest.raises(ValueError, match=f"^expected 12 numbers, not {found}$"):
            call(0, x)
    for u in (1.0, [1.0], [1, 2]):
        with pytest.raises(ValueError, match=r"^expected 3 numbers, not \d$"):
            top(0, START, u)
        with pytest.raises(ValueError, match=r"^expected 3 numbers, not \d$"):
            top.u = u


def test_other_parameters():
    f = derive.compile("so3", {"c_3": 0.0})
    assert f.p[2] == 0
    assert f.use({"c_3": 0.5}).p[2] == 0.5
    with pytest.raises(ValueError, match="unknown parameters zz"):
        f.use({"zz": 1})
    with pytest.raises(ValueError, match=r"unknown parameters c3; did you mean 'c_3'\?"):
        f.use({"c3": 1})
    with pytest.raises(ValueError, match="no body"):
        f.use([0.0] * len(f.PARAMETERS))
    group = derive.SO(3)
    bare = derive.Problem("bare", group, derive.Moments(), [derive.Gravity(0, 0, -1)])
    free = derive.compile(bare)
    with pytest.raises(ValueError, match="no value for the parameters c_1"):
        free.use()


def test_a_parameter_of_the_start_alone(tmp_path):
    """It is declared, and no equation has it."""
    path = tmp_path / "spin.toml"
    path.write_text(
        'name = "spin"\ngroup = "SO(3)"\n[parameters]\nw = 2.0\na = 1.0\n[body]\n'
        'given = { m = 1, c = [0, 0, 0], J = [["a", 0, 0], [0, 1, 0], [0, 0, 1]] }\n'
        '[initial]\nzeta_3 = "w"\n'
    )
    for f in (derive.compile(path), pickle.loads(pickle.dumps(derive.compile(path)))):
        with pytest.raises(ValueError, match=r"do not have w, .* as \[initial\]: leave it out"):
            f.use({"w": 3, "a": 2})
        assert f.use({"a": 2}).p.tolist() == [2]


def test_it_says_what_is_missing(top):
    bare = derive.Problem("bare", "SO(3)", derive.Moments(), derive.Gravity(0, 0, -1))
    with pytest.raises(ValueError, match="call use"):
        derive.compile(bare)(0, START)
    with pytest.raises(ValueError, match="call use"):
        derive.compile(bare).energy(0, START)
    with pytest.raises(ValueError, match="ask for it by compile"):
        top.jacobian_inputs(0, START)
    with pytest.raises(derive.ProblemError, match="leave out"):
        derive.compile("so3", form="header")
    for step in ("rk5", "gauss_jax", ("gauss", "gauss_jax")):
        with pytest.raises(derive.ProblemError, match=r"among gauss, rk4, vern9, discrete$"):
            derive.compile("so3", step=step)
    with pytest.raises(derive.ProblemError, match="lang"):
        derive.compile("so3", lang="c")
    with pytest.raises(derive.CompileError, match="'nocc' is not on the path"):
        derive.compile("so3", compiler="nocc")
    with pytest.raises(ValueError, match="expected 12 parameters"):
        top.use([1.0])


def test_inputs_and_their_derivative():
    """B of a linearised system, by steps of the inputs, in which the rates are linear."""
    f = derive.compile("se3", jacobian=["inputs", "parameters"])
    f.u = [1, 2, 3, 4, 5, 6]
    x = np.concatenate([np.eye(3).ravel(), np.arange(9) / 10])
    B = f.jacobian_inputs(0, x)
    assert B.shape == (12, 6)
    assert not B[:6].any()
    base = f(0, x)[-6:]
    for i in range(6):
        f.u = np.arange(1, 7) + np.eye(6)[i]
        assert np.allclose(f(0, x)[-6:] - base, B[6:, i], atol=1e-12)
    assert f.jacobian_parameters(0, x).shape == (12, len(f.PARAMETERS))


def test_inputs_of_one_call():
    """They are those of that call alone; those of the object are not written into."""
    f = derive.compile("so3", jacobian=["state", "inputs"])
    u = np.array([1.0, 2.0, 3.0])
    before = [f(0, START), f(0, START, u), f(0, START)]
    assert not np.allclose(before[0], before[1])
    assert np.array_equal(before[0], before[2])
    assert np.array_equal(f.jacobian(0, START, u)[0], before[1])
    assert f.jacobian_inputs(0, START, u).shape == (6, 3)
    f.u = u
    u[:] = 0
    assert np.array_equal(f(0, START), before[1])
    assert np.array_equal(f(0, START, u), before[0])
    for kept in (f.u, f.p, f.k):
        with pytest.raises(ValueError, match="read-only"):
            kept[0] = 1
    with pytest.raises(ValueError, match="expected 3 numbers, not 2"):
        f(0, START, [1, 2])
    assert np.array_equal(f(0, START), before[1])


def test_a_call_within_a_call(top):
    """A state that itself asks for a right-hand side while it is read."""

    class Asking:
        def __array__(self, dtype=None, copy=None):
            top(5.0, 2 * START, [1, 1, 1])
            return START

    assert np.array_equal(top(0, Asking()), top(0, START))


def test_threads_share_it():
    """States, inputs and parameters of one thread do not reach the calls of another."""
    f = derive.compile("so3")
    rng = np.random.default_rng(2)
    states, inputs = rng.normal(size=(4, 500, 12)), rng.normal(size=(4, 3))
    pairs = zip(states, inputs, strict=True)
    alone = [[f(0, x, u) for x in many] for many, u in pairs]
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)

    def wrong(thread):
        own = [np.array([f(0, x, inputs[thread]) for x in states[thread]]) for _ in range(20)]
        return sum(int((found != alone[thread]).any(axis=1).sum()) for found in own)

    try:
        with ThreadPoolExecutor(4) as pool:
            assert [*pool.map(wrong, range(4))] == [0, 0, 0, 0]
    finally:
        sys.setswitchinterval(interval)


def test_calls_keep_the_parameters_they_began_with():
    """While one thread changes them, another sees either body, never a part of each."""
    f = derive.compile("so3")
    bodies = [{"c_3": x, "J_11": 1.0 + x} for x in (0.1, 0.7)]
    rates = {f.use(body)(0, START).tobytes() for body in bodies}
    with ThreadPoolExecutor(2) as pool:
        changing = pool.submit(lambda: [f.use(bodies[k % 2]) for k in range(2000)])
        while not changing.done():
            assert f(0, START).tobytes() in rates
    assert len(rates) == 2


def test_pickle():
    """Another process computes the same, with the parameters and inputs of this one."""
    f = derive.compile("so3", {"c_3": 0.4})
    f.u = [1, 2, 3]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert np.array_equal(pool.apply(f, (0.0, START)), f(0, START))
    other = copy.deepcopy(f)
    other.u = [0, 0, 0]
    assert not np.array_equal(other(0, START), f(0, START))
    bare = derive.Problem("bare", "SO(3)", derive.Moments(), derive.Gravity(0, 0, -1))
    with pytest.raises(ValueError, match="call use"):
        pickle.loads(pickle.dumps(derive.compile(bare)))(0, START)


def test_without_a_compiler(monkeypatch):
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("CC", raising=False)
    with pytest.raises(derive.CompileError, match="no C compiler"):
        derive.compile("so3")


def test_a_compiler_that_refuses():
    with pytest.raises(derive.CompileError, match="refused the emitted C"):
        derive.compile("so3", flags=["--no-such-flag"])


@needs("the module scipy")
def test_solve_ivp(top):
    """SciPy integrates it; energy stays."""
    from scipy.integrate import solve_ivp

    found = solve_ivp(top, (0, 1), START, rtol=1e-10, atol=1e-12)
    assert found.success
    assert abs(top.energy(1, found.y[:, -1]) - top.energy(0, START)) < 1e-7
    m = module_of("so3")
    other = solve_ivp(m.rhs, (0, 1), START, rtol=1e-10, atol=1e-12, args=(m.constants(top.p),))
    assert np.allclose(found.y[:, -1], other.y[:, -1], rtol=1e-9, atol=1e-9)


@needs("the module sksundae")
def test_cvode(top):
    """SUNDIALS integrates it, through a Python package where there is one."""
    from sksundae.cvode import CVODE

    def field(t, y, dy):
        dy[:] = top.rhs(t, y)

    solver = CVODE(field, rtol=1e-10, atol=1e-12)
    found = solver.solve(np.linspace(0, 1, 3), START)
    assert abs(top.energy(1, found.y[-1]) - top.energy(0, START)) < 1e-7


@pytest.mark.parametrize("name", ["so3", "se3", "sl3", "saff3", "sp4", "su2", "heisenberg", "gl3"])
def test_a_motion_begins_on_the_group_by_the_same_rule_on_each(name):
    """det A = 1 on SL(n) as ĀA = 1 on SO(n); on GL(n) there is nothing to be kept."""
    f = derive.compile(name, step="rk4")
    x = np.zeros(len(f.STATE))
    x[[k for k, s in enumerate(f.STATE) if re.fullmatch(r"A_(\d)\1", s)]] = 1
    f.begin(x)
    x[0] = 2
    if name == "gl3":
        assert f.begin(x).x[0] == 2
        return
    with pytest.raises(ValueError, match="the state is not on the group, its defect is "):
        f.begin(x)
