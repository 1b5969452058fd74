"""The emitted right-hand side entry by entry, for libraries of symbols and traced arrays."""

import importlib
import math

import numpy as np
import pytest

from tests.support.library import emission, module_of
from tests.support.needs import need, needs

NAMES = ("so3", "se3", "sl3", "two_tops", "jelly", "top")
"""With inputs and without, of products, with lengths that may be 0, damped."""


def case(name):
    """The module, numbers for its parameters, state and inputs, and dx/dt by its rhs."""
    m = module_of(name)
    rng = np.random.default_rng(0)
    p = np.array([m.DEFAULTS[x] for x in m.PARAMETERS])
    x, u = rng.normal(size=len(m.STATE)), rng.normal(size=len(m.INPUTS))
    return m, p, x, u, m.rhs(0.1, x, m.constants(p), u)


def close(found, expected):
    return np.allclose(np.asarray(found, dtype=float).ravel(), expected, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("xp", [math, np])
def test_numbers(name, xp):
    m, p, x, u, expected = case(name)
    found = m.rhs_of(xp, 0.1, x.tolist(), m.constants_of(xp, p.tolist()), u.tolist())
    assert type(found) is list
    assert close(found, expected)
    named = m.constants_of(xp, dict(zip(m.PARAMETERS, p.tolist(), strict=True)))
    assert close(named, m.constants(p))


def test_columns_are_a_batch():
    m, p, x, u, _ = case("so3")
    many = np.outer([1, 2, 3], x)
    k = m.constants(p)
    found = np.stack(m.rhs_of(np, 0.1, many.T, k, u), axis=-1)
    assert close(found, m.rhs(0.1, many, k, u).ravel())


@needs("the module casadi")
@pytest.mark.parametrize("kind", ["SX", "MX"])
@pytest.mark.parametrize("name", NAMES)
def test_symbols_of_casadi(name, kind):
    """The values, and the derivative by a parameter beside a quotient of differences."""
    import casadi

    m, p, x, u, expected = case(name)
    symbol = getattr(casadi, kind).sym
    T, P, X, U = symbol("t"), symbol("p", len(p)), symbol("x", len(x)), symbol("u", len(u))
    k = m.constants_of(casadi, casadi.vertsplit(P))
    rates = m.rhs_of(casadi, T, casadi.vertsplit(X), k, casadi.vertsplit(U) if len(u) else ())
    dx = casadi.vertcat(*rates)
    f = casadi.Function("f", [T, X, P, U], [dx, casadi.jacobian(dx, P)])
    value, slope = f(0.1, x, p, u)
    assert close(value, expected)
    i, h = 0, 1e-6
    ends = [m.rhs(0.1, x, m.constants(p + s * h * np.eye(len(p))[i]), u) for s in (1, -1)]
    assert np.allclose(np.asarray(slope)[:, i], (ends[0] - ends[1]) / (2 * h), rtol=1e-6, atol=1e-6)


@needs("the module jax")
@pytest.mark.parametrize("name", NAMES)
def test_traced_parameters_of_jax(name):
    import jax

    jax.config.update("jax_enable_x64", True)
    jnp = jax.numpy
    m, p, x, u, expected = case(name)

    def rates(p):
        return jnp.stack(jnp.broadcast_arrays(*m.rhs_of(jnp, 0.1, x, m.constants_of(jnp, p), u)))

    assert close(jax.jit(rates)(jnp.array(p)), expected)
    slope = jax.jit(jax.grad(lambda p: rates(p).sum()))(jnp.array(p))
    i, h = 0, 1e-6
    ends = [m.rhs(0.1, x, m.constants(p + s * h * np.eye(len(p))[i]), u).sum() for s in (1, -1)]
    assert abs(slope[i] - (ends[0] - ends[1]) / (2 * h)) < 1e-6 * (1 + abs(slope[i]))


@pytest.mark.parametrize("name", NAMES)
def test_tensors_of_torch(name):
    need("the module torch")
    torch = importlib.import_module("torch")
    m, p, x, u, expected = case(name)
    P, X, U = (torch.tensor(a, dtype=torch.double) for a in (p, x, u))
    P.requires_grad_(True)
    rates = m.rhs_of(torch, 0.1, X, m.constants_of(torch, P), U)
    found = torch.stack([torch.as_tensor(y, dtype=torch.double) for y in rates])
    assert close(found.detach(), expected)
    found.sum().backward()
    i, h = 0, 1e-6
    ends = [m.rhs(0.1, x, m.constants(p + s * h * np.eye(len(p))[i]), u).sum() for s in (1, -1)]
    assert abs(P.grad[i] - (ends[0] - ends[1]) / (2 * h)) < 1e-6 * (1 + abs(P.grad[i]))


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        (
            lambda m: m.rhs_of(math, 0, [1.0] * 11, [1.0] * len(m.CONSTANTS)),
            "x has 11 numbers, not 12",
        ),
        (lambda m: m.rhs_of(math, 0, [1.0] * 12, [1.0]), "k has 1 numbers"),
        (
            lambda m: m.rhs_of(math, 0, [1.0] * 12, [1.0] * len(m.CONSTANTS), [1.0]),
            "u has 1 numbers",
        ),
        (lambda m: m.constants_of(math, [1.0]), "p has 1 numbers"),
        (lambda m: m.constants_of(math, {"zz": 1.0}), "no parameters zz"),
    ],
)
def test_as_many_as_there_are(asked, says):
    with pytest.raises(ValueError, match=f"so3: {says}"):
        asked(module_of("so3"))


def test_where_there_are_none():
    """Loops over a lattice have no entries; integrals and the axes of a frame are of numbers."""
    for name in ("zeitlin", "riemann_ellipsoid"):
        assert "def rhs_of" not in emission(name, ("python",))[1][f"{name}.py"]
    framed = emission("so3", ("python",), frame="principal")[1]["so3.py"]
    assert "def rhs_of" in framed
    assert "def constants_of" not in framed
