"""The emitted step of order 16 in JAX: the motion of Python's, under jit and vmap, over devices."""

import importlib
import os
import subprocess
import sys
from functools import cache

import numpy as np
import pytest

import derive
from tests.problems.moving import FALLING
from tests.support.library import module_of
from tests.support.needs import need

need("the module jax")
jax = importlib.import_module("jax")

AT_ONE = [1.0, 0, 0, 0, 1, 0, 0, 0, 1]


@pytest.fixture(autouse=True)
def _doubles():
    with jax.enable_x64(True):
        yield


def emitted(problem, **options):
    """The module with both steps, and constants."""
    m = module_of(problem, step=("gauss", "gauss_jax"), **options)
    return m, m.constants([m.DEFAULTS.get(x, 0.7) for x in m.PARAMETERS])


@pytest.fixture(scope="module")
def top():
    return emitted("so3")


def heavy():
    """A state of the heavy top."""
    return np.array([*AT_ONE, 0.1, 0, 9])


@cache
def steps_of(m):
    """The steps of a module, and those to a time, each compiled once: (motion, k, inputs, h, n) and
    (motion, k, t, tol) → motion."""
    steps = jax.jit(m.gauss_jax)
    return steps, jax.jit(lambda n, k, t, tol: m.gauss_jax_to(n, k, None, t, tol))


def begun(m, x, k):
    """Both motions from a state, Python's and JAX's, and steps of the latter without inputs."""
    steps, _ = steps_of(m)
    none = np.zeros(len(m.INPUTS))
    return m.begin(0.0, x), m.begin_jax(0.0, x), lambda n, h, c: steps(n, k, none, float(h), c)


def near_the_identity(names, options):
    """A state of small velocity."""
    rng = np.random.default_rng(2)
    if options.get("velocity") == "tangent":
        return np.array([*AT_ONE, 0.1, 0.2, 0, -0.1, 0.05, 0.1, 0.2, 0, -0.15])
    one = [name == "q_0" or (name[0] == "A" and name[-1] == name[-2]) for name in names]
    moves = [not name.startswith(("A", "T", "q_")) for name in names]
    return one + moves * rng.normal(size=len(names))


@pytest.mark.parametrize(
    ("problem", "options"),
    [
        ("so3", {}),
        ("so3", {"attitude": "quaternion"}),
        ("se3", {"frame": "principal", "layout": "col"}),
        ("sl3", {"velocity": "tangent"}),
        ("heisenberg", {}),
        ("zeitlin", {}),
    ],
)
def test_the_steps_are_those_of_python(problem, options):
    """In every kind of state: fixed steps, within one, and adaptive ones back."""
    m, k = emitted(problem, **options)
    x = near_the_identity(m.STATE, options)
    own, other, steps = begun(m, x, k)
    assert m.gauss(own, k, None, 0.05, 10) == m.OK
    other = steps(other, 0.05, 10)
    assert (other.status, float(other.t)) == (m.OK, own.t)
    scale = max(1, np.abs(own.x).max())
    assert np.abs(other.x - own.x).max() < 1e-13 * scale
    assert np.abs(m.dense_jax(other, 0.47) - m.dense(own, 0.47)).max() < 1e-13 * scale
    assert 0.7 < other.evaluations / own.evaluations < 1.4
    back = steps_of(m)[1](other, k, 0.0, 1e-12)
    assert (back.status, float(back.t)) == (m.OK, 0)
    assert np.abs(back.x - x).max() < 1e-10 * scale


def test_many_are_those_of_one_by_one(top):
    """Under vmap each has steps, a status and constants of its own; one is no number."""
    m, _ = top
    p = np.array([m.DEFAULTS[x] for x in m.PARAMETERS])
    ks = m.constants(p * np.linspace(0.9, 1.1, 6)[:, None])
    x = np.tile(heavy(), (6, 1))
    x[:, 9:] *= np.linspace(0.1, 3, 6)[:, None]
    x[2, 10] = np.nan

    def moved(x, k, t1):
        return m.gauss_jax_to(m.begin_jax(0.0, x), k, None, t1, 1e-11)

    ends = 2.0 + np.arange(6)
    found = jax.jit(jax.vmap(moved))(x, ks, ends)
    assert [*found.status] == [m.OK, m.OK, m.NOT_FINITE, m.OK, m.OK, m.OK]
    assert [*found.t] == [2, 3, 0, 5, 6, 7]
    assert len({*np.asarray(found.evaluations)}) == 6
    for i in range(6):
        alone = steps_of(m)[1](m.begin_jax(0.0, x[i]), ks[i], ends[i], 1e-11)
        assert alone.status == found.status[i]
        assert np.allclose(alone.x, found.x[i], rtol=0, atol=1e-13, equal_nan=True)
        if i != 2:
            own = m.begin(0.0, x[i])
            assert m.gauss_to(own, ks[i], None, ends[i], 1e-11) == m.OK
            assert np.abs(own.x - alone.x).max() < 1e-9


def test_a_coarse_step_is_made_in_halves(top):
    m, k = top
    own, other, steps = begun(m, heavy(), k)
    assert m.gauss(own, k, None, 2.0, 2) == m.OK
    other = steps(other, 2.0, 2)
    assert abs(float(other.h)) < 2.0
    assert (other.status, float(other.t), float(other.h)) == (m.OK, own.t, own.h)
    # an iteration part by part converges for larger steps, so that halves and errors differ
    assert np.abs(other.x - own.x).max() < 1e-6


def test_inputs_held_and_as_a_function(top):
    """A torque that changes within a step, as Python's."""
    m, k = top
    held, begin = np.array([0.3, -0.2, 1.0]), m.begin_jax(0.0, heavy())

    def asked(t, x):
        return jax.numpy.stack([jax.numpy.cos(3 * t), x[9], t])

    with_held = steps_of(m)[0](begin, k, held, 0.1, 10)
    with_asked = jax.jit(lambda n: m.gauss_jax(n, k, asked, 0.1, 10))(begin)
    for found, u in ((with_held, held), (with_asked, lambda t, x: [np.cos(3 * t), x[9], t])):
        own = m.begin(0.0, heavy())
        assert m.gauss(own, k, u, 0.1, 10) == m.OK
        assert np.abs(found.x - own.x).max() < 1e-13


def test_the_derivative_of_a_motion(top):
    """Forward, by the state where it begins: as differences."""
    m, k = top

    def end(x):
        return m.gauss_jax_to(m.begin_jax(0.0, x), k, None, 1.0, 1e-13).x

    found, h = jax.jit(jax.jacfwd(end))(heavy())[:, 9:], 1e-4
    sides = [[jax.jit(end)(heavy() + s * h * np.eye(12)[9 + i]) for i in range(3)] for s in (1, -1)]
    assert np.abs(found - ((np.array(sides[0]) - sides[1]) / (2 * h)).T).max() < 1e-6


def test_a_motion_that_ends_leaves_the_others():
    """Points that fall into a centre from 1, where they stop before it and stay, and from 100."""
    m, k = emitted(FALLING)
    x = np.zeros((4, len(m.STATE)))
    x[:, [m.STATE.index("A_11"), m.STATE.index("A_22")]] = 1
    x[:, m.STATE.index("T_1")] = [1, 100, 100, 1]
    to = jax.jit(jax.vmap(lambda n, t1: m.gauss_jax_to(n, k, None, t1), (0, None)))
    begun = jax.vmap(m.begin_jax, (None, 0))(0.0, x)
    found = to(begun, 5.0)
    assert [*np.flatnonzero(found.status)] == [0, 3]
    assert np.abs(np.asarray(found.t)[[0, 3]] - np.pi / np.sqrt(8)).max() < 1e-6
    assert np.isfinite(found.x).all()
    later = to(found, 6.0)
    assert np.array_equal(later.x[0], found.x[0])
    assert np.array_equal(later.t, [found.t[0], 6, 6, found.t[3]])


def test_no_number_is_no_motion(top):
    m, k = top
    own, n, steps = begun(m, [*AT_ONE, np.nan, 0, 0], k)
    assert m.gauss(own, k, None, 0.1) == steps(n, 0.1, 1).status == m.NOT_FINITE
    good = m.begin_jax(0.0, heavy())
    assert steps_of(m)[1](good, k, np.nan, 1e-9).status == m.NOT_FINITE
    assert np.array_equal(m.dense_jax(good, 0.3), heavy())


SHARDED = """
import sys
import jax, numpy as np
jax.config.update("jax_enable_x64", True)
sys.path.insert(0, sys.argv[1])
import so3 as m
k = m.constants(m.DEFAULTS)
x = np.tile([1.0, 0, 0, 0, 1, 0, 0, 0, 1, 0.1, 0, 9], (8, 1))
x[:, 9:] *= np.linspace(0.2, 2, 8)[:, None]
devices = np.array(jax.devices())
assert len(devices) == 4
mesh, P = jax.sharding.Mesh(devices, ("motions",)), jax.sharding.PartitionSpec("motions")
many = jax.vmap(lambda x: m.gauss_jax_to(m.begin_jax(0.0, x), k, None, 3.0, 1e-11))
alone = jax.jit(many)(x)
split = jax.device_put(x, jax.sharding.NamedSharding(mesh, P))
shared = jax.jit(many)(split)
apart = jax.jit(jax.shard_map(many, mesh=mesh, in_specs=P, out_specs=P, check_vma=False))(split)
for found in (shared, apart):
    assert len(found.x.sharding.device_set) == 4
    assert np.array_equal(found.status, alone.status) and not np.any(found.status)
    assert np.array_equal(found.evaluations, alone.evaluations)
    assert np.abs(np.asarray(found.x) - np.asarray(alone.x)).max() < 1e-13
"""


def test_over_devices(tmp_path):
    """A batch over four devices of the host, together and each at its own pace."""
    derive.derive("so3").emit(tmp_path, ("python",), step="gauss_jax")
    flags = {"XLA_FLAGS": "--xla_force_host_platform_device_count=4", "JAX_PLATFORMS": "cpu"}
    command = [sys.executable, "-c", SHARDED, str(tmp_path)]
    done = subprocess.run(command, env=os.environ | flags, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]


def test_what_is_refused(top):
    m, _ = top
    with (
        jax.enable_x64(False),
        pytest.raises(ValueError, match="so3: no doubles in JAX: "),
    ):
        m.begin_jax(0.0, heavy())
    with pytest.raises(ValueError, match=r"so3: x is not one state: jax\.vmap"):
        m.begin_jax(0.0, [heavy()])
    with pytest.raises(ValueError, match="so3: x has 11 numbers, not 12"):
        m.begin_jax(0.0, heavy()[1:])
