"""The emitted Python under other array libraries, and entry by entry, for libraries of symbols and
traced arrays: the standard itself, JAX, PyTorch, CasADi."""

import importlib
import math

import numpy as np
import pytest

from tests.support.library import emission, module_of
from tests.support.needs import need, needs

NAMES = ("so3", "se3", "sl3", "two_tops", "jelly", "top")
"""With inputs and without, of products, with lengths that may be 0, damped."""
LIBRARIES = ("array_api_strict", "torch", "jax.numpy")
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


def numbers(name, *batch):
    """The module, and numbers for its parameters, for states and inputs."""
    m, rng = module_of(name), np.random.default_rng(0)
    p = np.array([m.DEFAULTS[x] for x in m.PARAMETERS])
    x, u = (rng.normal(size=(*batch, len(names))) for names in (m.STATE, m.INPUTS))
    return m, p, x, u


def case(name):
    """The same of one state, with dx/dt by its rhs, and the derivative of this by the first
    parameter, by differences."""
    m, p, x, u = numbers(name)
    h = 1e-6 * np.eye(len(p))[0]
    ends = [m.rhs(0.1, x, m.constants(p + s * h), u) for s in (1, -1)]
    return m, p, x, u, m.rhs(0.1, x, m.constants(p), u), (ends[0] - ends[1]) / 2e-6


def close(found, expected, rtol=1e-12, atol=1e-14):
    return np.allclose(np.asarray(found, dtype=float).ravel(), np.ravel(expected), rtol, atol)


@pytest.fixture
def jax():
    """The module, with doubles."""
    need("the module jax")
    found = importlib.import_module("jax")
    found.config.update("jax_enable_x64", True)
    return found


def arrays_of(library):
    """A library, and its function from numbers to arrays."""
    need(f"the module {library.partition('.')[0]}")
    if library == "torch":
        need("the module array_api_compat")
    if library == "jax.numpy":
        importlib.import_module("jax").config.update("jax_enable_x64", True)
    xp = importlib.import_module(library)
    return xp, getattr(xp, "asarray", None) or xp.tensor


@pytest.mark.parametrize("library", LIBRARIES[:2])
@pytest.mark.parametrize("name", ["so3", "se3", "sl3"])
def test_other_arrays(name, library):
    """Nothing beyond the standard; the results are arrays of the library."""
    _, asarray = arrays_of(library)
    m, p, x, u = numbers(name, 5)
    k, known = m.constants(asarray(p)), m.constants(p)
    for given in (u, None):
        found = m.rhs(0.1, asarray(x), k, None if given is None else asarray(given))
        assert type(found) is type(k) is type(asarray(p))
        assert close(found, m.rhs(0.1, x, known, given), 1e-13)
    assert close(m.energy(0.1, asarray(x), k), m.energy(0.1, x, known))
    for function in (m.project, m.defect):
        found = function(asarray(x))
        assert type(found) is type(k)
        assert close(found, function(x), 1e-13)
    with pytest.raises(ValueError, match="singular"):
        m.constants(asarray(0 * p))


@pytest.mark.parametrize("library", LIBRARIES)
def test_a_length_of_0(library):
    """Asking whether a parameter is 0 needs nothing beyond the standard."""
    _, asarray = arrays_of(library)
    m, p, *_ = numbers("two_tops")
    for length in (0.0, 0.4):
        p[m.PARAMETERS.index("l")] = length
        found = np.asarray(m.constants(asarray(p)))
        assert close(found, m.constants(p), 1e-6)
        assert (found[m.CONSTANTS.index("slack_l")] > 0) == (length == 0)


def test_functions_of_numbers_alone():
    """Strict libraries have no cosine of a plain number."""
    xp, _ = arrays_of("array_api_strict")
    assert "xp.cos(0.7)" in emission(TURNED, ("python",))[1]["test.py"]
    m = module_of(TURNED)
    k, x = m.constants([2.0]), np.random.default_rng(0).normal(size=(5, len(m.STATE)))
    found = m.constants(xp.asarray([2.0]))
    assert close(found, k)
    assert close(m.rhs(0.0, xp.asarray(x), found), m.rhs(0.0, x, k), 1e-13)


@pytest.mark.parametrize("name", ["so3", "se3", "sl3"])
def test_jax(name, jax):
    """jit, vmap and grad; tests/code/test_gauss_jax.py shares a batch out over devices."""
    m, p, x, u = numbers(name, 8)
    k, expected = m.constants(jax.numpy.array(p)), m.rhs(0.0, x, m.constants(p), u)
    assert close(jax.jit(m.rhs)(0.0, x, k, u), expected, 1e-13)
    assert close(jax.vmap(m.rhs, (None, 0, None, 0))(0.0, x, k, u), expected, 1e-13)
    assert close(jax.jit(m.project)(x), m.project(x), 1e-13)
    assert close(jax.vmap(m.defect)(x), m.defect(x), 1e-13)
    slope = jax.grad(lambda y: m.energy(0.0, y, k))(jax.numpy.array(x[0]))
    step = 1e-6 * np.eye(len(m.STATE))[3]
    ends = [m.energy(0.0, x[0] + s * step, m.constants(p)) for s in (1, -1)]
    assert abs(slope[3] - (ends[0] - ends[1]) / 2e-6) < 1e-6 * (1 + abs(slope[3]))


REFUSED = {
    "x has 11 numbers, not 12": lambda m, x, k, u: m.rhs(0.1, x[:-1], k, u),
    "k has": lambda m, x, k, u: m.rhs(0.1, x, k[1:], u),
    "u has no numbers, not 3": lambda m, x, k, u: m.rhs(0.1, x, k, 1.0),
    "u has 2 numbers, not 3": lambda m, x, k, u: m.rhs(0.1, [x, x], k, [u[:2]] * 2),
    "p has 2 numbers": lambda m, x, k, u: m.constants([1.0, 2.0]),
    "x has 10 numbers, not 12": lambda m, x, k, u: m.rhs_of(math, 0, x[:-2], k),
    "k has 1 numbers": lambda m, x, k, u: m.rhs_of(math, 0, x, k[:1]),
    "u has 1 numbers": lambda m, x, k, u: m.rhs_of(math, 0, x, k, u[:1]),
    "p has 1 numbers": lambda m, x, k, u: m.constants_of(math, [1.0]),
    "no parameters zz": lambda m, x, k, u: m.constants_of(math, {"zz": 1.0}),
}


@pytest.mark.parametrize("says", REFUSED)
def test_as_many_as_there_are(says):
    """The message names the array, how long it is and how long it should be."""
    m, p, x, u = numbers("so3")
    with pytest.raises(ValueError, match=f"so3: {says}"):
        REFUSED[says](m, x, m.constants(p), u)


def test_one_state_is_computed_in_plain_numbers(monkeypatch):
    """No array for each operation: no call of NumPy's arithmetic but the one that makes dx."""
    m, p, x, _ = numbers("so3")
    k, seen, rhs = m.constants(p), [], m._rhs
    monkeypatch.setattr(m, "_rhs", lambda *given: seen.append(given) or rhs(*given))
    assert m.rhs(0, x, k).dtype == float
    ((module, _, *rest),) = seen
    assert module.__name__ == "math"
    assert all(type(y) is float for part in rest for y in part)


def test_what_has_no_value_is_not_an_error():
    """1/0 and √−1 of one state are inf and nan, as in a batch."""
    m, p, x, _ = numbers("sl3")
    with np.errstate(all="ignore"):
        assert not np.isfinite(m.rhs(0, 0 * x, m.constants(p))).all()


# ---------------------------------------------------------------- entry by entry


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("xp", [math, np])
def test_numbers(name, xp):
    m, p, x, u, expected, _ = case(name)
    found = m.rhs_of(xp, 0.1, x.tolist(), m.constants_of(xp, p.tolist()), u.tolist())
    assert type(found) is list
    assert close(found, expected)
    named = m.constants_of(xp, dict(zip(m.PARAMETERS, p.tolist(), strict=True)))
    assert close(named, m.constants(p))


def test_columns_are_a_batch():
    m, p, x, u = numbers("so3")
    many, k = np.outer([1, 2, 3], x), m.constants(p)
    found = np.stack(m.rhs_of(np, 0.1, many.T, k, u), axis=-1)
    assert close(found, m.rhs(0.1, many, k, u))


@needs("the module casadi")
@pytest.mark.parametrize("kind", ["SX", "MX"])
@pytest.mark.parametrize("name", NAMES)
def test_symbols_of_casadi(name, kind):
    import casadi

    m, p, x, u, expected, known = case(name)
    symbol = getattr(casadi, kind).sym
    T, P, X, U = symbol("t"), symbol("p", len(p)), symbol("x", len(x)), symbol("u", len(u))
    k = m.constants_of(casadi, casadi.vertsplit(P))
    rates = m.rhs_of(casadi, T, casadi.vertsplit(X), k, casadi.vertsplit(U) if len(u) else ())
    dx = casadi.vertcat(*rates)
    f = casadi.Function("f", [T, X, P, U], [dx, casadi.jacobian(dx, P)])
    value, slope = f(0.1, x, p, u)
    assert close(value, expected)
    assert close(np.asarray(slope)[:, 0], known, 1e-6, 1e-6)


@pytest.mark.parametrize("name", NAMES)
def test_traced_parameters_of_jax(name, jax):
    jnp = jax.numpy
    m, p, x, u, expected, known = case(name)

    def rates(p):
        return jnp.stack(jnp.broadcast_arrays(*m.rhs_of(jnp, 0.1, x, m.constants_of(jnp, p), u)))

    assert close(jax.jit(rates)(jnp.array(p)), expected)
    slope = jax.jit(jax.grad(lambda p: rates(p).sum()))(jnp.array(p))
    assert abs(slope[0] - known.sum()) < 1e-6 * (1 + abs(slope[0]))


@pytest.mark.parametrize("name", NAMES)
def test_tensors_of_torch(name):
    torch, _ = arrays_of("torch")
    m, p, x, u, expected, known = case(name)
    P, X, U = (torch.tensor(a, dtype=torch.double) for a in (p, x, u))
    P.requires_grad_(True)
    rates = m.rhs_of(torch, 0.1, X, m.constants_of(torch, P), U)
    found = torch.stack([torch.as_tensor(y, dtype=torch.double) for y in rates])
    assert close(found.detach(), expected)
    found.sum().backward()
    assert abs(P.grad[0] - known.sum()) < 1e-6 * (1 + abs(P.grad[0]))
