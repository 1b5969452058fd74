"""The emitted Python under other array libraries: the standard itself, JAX, PyTorch."""

import importlib.util
import os
import subprocess
import sys

import numpy as np
import pytest

from tests.support.cached import ROOT
from tests.support.library import emission, module_of
from tests.support.needs import need, needs

JAX = """
import importlib.util, sys
import jax, jax.numpy as jnp, numpy as np
jax.config.update("jax_enable_x64", True)
spec = importlib.util.spec_from_file_location("emitted", sys.argv[1])
m = importlib.util.module_from_spec(spec)
spec.loader.exec_module(m)
p = jnp.array([m.DEFAULTS[x] for x in m.PARAMETERS])
k = m.constants(p)
rng = np.random.default_rng(0)
x = rng.normal(size=(8, len(m.STATE)))
u = rng.normal(size=(8, len(m.INPUTS)))
expected = m.rhs(0.0, x, np.asarray(k), u)
jitted = jax.jit(m.rhs)
assert np.allclose(jitted(0.0, x, k, u), expected, rtol=1e-13)
assert np.allclose(jax.vmap(m.rhs, (None, 0, None, 0))(0.0, x, k, u), expected, rtol=1e-13)
assert np.allclose(jax.jit(m.project)(x), m.project(x), rtol=1e-13)
assert np.allclose(jax.vmap(m.defect)(x), m.defect(x), rtol=1e-13)
slope = jax.grad(lambda y: m.energy(0.0, y, k))(jnp.array(x[0]))
i, h = 3, 1e-6
step = h * np.eye(len(m.STATE))[i]
ends = [m.energy(0.0, x[0] + s * step, np.asarray(k)) for s in (1, -1)]
assert abs(slope[i] - (ends[0] - ends[1]) / (2 * h)) < 1e-6 * (1 + abs(slope[i]))
devices = jax.devices()
assert len(devices) == 4
mesh = jax.sharding.Mesh(np.array(devices), ("states",))
split = jax.sharding.NamedSharding(mesh, jax.sharding.PartitionSpec("states"))
shared = jitted(0.0, jax.device_put(x, split), k, jax.device_put(u, split))
assert len(shared.sharding.device_set) == 4
assert np.allclose(shared, expected, rtol=1e-13)
"""
TURNED = """
name = "test"
group = "SO(3)"
[parameters]
rho = 2.0
[[solid]]
kind = "box"
density = "rho"
sides = [1, 2, 3]
rotation = { axis = [1, 2, 2], angle = "0.7" }
"""


@needs("the module jax")
@pytest.mark.parametrize("name", ["so3", "se3", "sl3"])
def test_jax(name):
    """jit, vmap, grad, and a batch sharded over four devices of the host."""
    path = ROOT / "generated" / name / f"{name}.py"
    flags = {"XLA_FLAGS": "--xla_force_host_platform_device_count=4", "JAX_PLATFORMS": "cpu"}
    command = [sys.executable, "-c", JAX, str(path)]
    done = subprocess.run(command, env=os.environ | flags, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]


@pytest.mark.parametrize("library", ["array_api_strict", "torch"])
@pytest.mark.parametrize("name", ["so3", "se3", "sl3"])
def test_other_arrays(name, library):
    """Nothing beyond the standard; the results are arrays of the library."""
    need(f"the module {library}")
    if library == "torch":
        need("the module array_api_compat")
    xp, m = importlib.import_module(library), module_of(name)
    asarray = xp.asarray if hasattr(xp, "asarray") else xp.tensor
    p = np.array([m.DEFAULTS[x] for x in m.PARAMETERS])
    rng = np.random.default_rng(0)
    x, u = rng.normal(size=(5, len(m.STATE))), rng.normal(size=(5, len(m.INPUTS)))
    expected = m.rhs(0.1, x, m.constants(p), u)
    k = m.constants(asarray(p))
    for given in (asarray(u), None):
        found = m.rhs(0.1, asarray(x), k, given)
        assert type(found) is type(k) is type(asarray(p))
        wanted = expected if given is not None else m.rhs(0.1, x, m.constants(p))
        assert np.allclose(np.asarray(found), wanted, rtol=1e-13)
    assert np.allclose(np.asarray(m.energy(0.1, asarray(x), k)), m.energy(0.1, x, m.constants(p)))
    for function in (m.project, m.defect):
        found = function(asarray(x))
        assert type(found) is type(k)
        assert np.allclose(np.asarray(found), function(x), rtol=1e-13)
    with pytest.raises(ValueError, match="singular"):
        m.constants(asarray(0 * p))


@pytest.mark.parametrize("library", ["array_api_strict", "torch", "jax.numpy"])
def test_a_length_of_0(library):
    """Asking whether a parameter is 0 needs nothing beyond the standard."""
    need(f"the module {library.partition('.')[0]}")
    if library == "torch":
        need("the module array_api_compat")
    xp = importlib.import_module(library)
    m = module_of("two_tops")
    asarray = getattr(xp, "asarray", None) or xp.tensor
    p = np.array([m.DEFAULTS[x] for x in m.PARAMETERS])
    for length in (0.0, 0.4):
        p[m.PARAMETERS.index("l")] = length
        found = np.asarray(m.constants(asarray(p)))
        assert np.allclose(found, m.constants(p), rtol=1e-6)
        assert (found[m.CONSTANTS.index("slack_l")] > 0) == (length == 0)


@needs("the module array_api_strict")
def test_functions_of_numbers_alone():
    """Strict libraries have no cosine of a plain number."""
    import array_api_strict as xp

    assert "xp.cos(0.7)" in emission(TURNED, ("python",))[1]["test.py"]
    m = module_of(TURNED)
    k, x = m.constants([2.0]), np.random.default_rng(0).normal(size=(5, len(m.STATE)))
    found = m.constants(xp.asarray([2.0]))
    assert np.allclose(np.asarray(found), k, rtol=1e-14)
    assert np.allclose(np.asarray(m.rhs(0.0, xp.asarray(x), found)), m.rhs(0.0, x, k), rtol=1e-13)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda t, x, k, u: (t, x[:-1], k, u), "x has 11 numbers, not 12"),
        (lambda t, x, k, u: (t, x, k[1:], u), "k has"),
        (lambda t, x, k, u: (t, x, k, 1.0), "u has no numbers, not 3"),
        (lambda t, x, k, u: (t, [x, x], k, [u[:2]] * 2), "u has 2 numbers, not 3"),
    ],
)
def test_arrays_of_another_size(change, says):
    """The message names the array, how long it is and how long it should be."""
    m = module_of("so3")
    k = m.constants(np.array([m.DEFAULTS[x] for x in m.PARAMETERS]))
    given = (0.1, np.ones(len(m.STATE)), k, np.ones(len(m.INPUTS)))
    with pytest.raises(ValueError, match=f"so3: {says}"):
        m.rhs(*change(*given))
    with pytest.raises(ValueError, match="so3: p has 2 numbers"):
        m.constants([1.0, 2.0])


def test_one_state_is_computed_in_plain_numbers():
    """No array for each operation: no call of NumPy's arithmetic but the one that makes dx."""
    m = module_of("so3")
    k = m.constants(np.array([m.DEFAULTS[x] for x in m.PARAMETERS]))
    x = np.random.default_rng(0).normal(size=len(m.STATE))
    seen = []
    rhs, m._rhs = m._rhs, lambda xp, t, *rest: seen.append((xp, rest)) or rhs(xp, t, *rest)
    assert m.rhs(0, x, k).dtype == float
    ((module, rest),) = seen
    assert module.__name__ == "math"
    assert all(type(y) is float for part in rest for y in part)


def test_what_has_no_value_is_not_an_error():
    """1/0 and √−1 of one state are inf and nan, as in a batch."""
    m = module_of("sl3")
    k = m.constants(np.array([m.DEFAULTS[x] for x in m.PARAMETERS]))
    with np.errstate(all="ignore"):
        assert not np.isfinite(m.rhs(0, np.zeros(len(m.STATE)), k)).all()
