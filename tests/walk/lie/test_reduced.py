"""Algebras without a group in the state: the code beside Euler and Lagrange on a matrix group.

The oracle has no brackets and no rule for Γ: there Γ = ρ(g)⁻¹Γ₀, on the right ρ(g)Γ₀, is a function
of matrices, and ℓ one of (t, g, Z).
"""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from derive.algebra.families import group
from derive.problem.toml import problem_of
from tests.oracles.euler_lagrange import acceleration
from tests.support import advected
from tests.support.library import module_of
from tests.support.walks import problem


def oracle_representation(name, kind):
    """ρ(g) as a function of g by matrices alone, or of g and g⁻¹."""
    E = advected.matrices(name)
    flat = np.linalg.pinv(E.reshape(len(E), -1).T)
    if kind in ("standard", "dual"):
        return len(E[0]), lambda g: g if kind == "standard" else jnp.linalg.inv(g).T

    def adjoint(g):
        moved = jnp.einsum("ij,ajk,kl->ail", g, E, jnp.linalg.inv(g))
        return jnp.einsum("bm,am->ba", flat, moved.reshape(len(E), -1))

    return len(E), adjoint if kind == "adjoint" else lambda g: jnp.linalg.inv(adjoint(g)).T


@pytest.mark.parametrize(("case", "kind", "by_brackets"), advected.CASES)
def test_the_code_agrees(case, kind, by_brackets):
    found = module_of(advected.problem(case, kind, by_brackets))
    name, side, *_ = advected.GIVEN[case]
    E, (m, rho) = advected.matrices(name), oracle_representation(name, kind)
    text, right = advected.lagrangian(case).replace("^", "**"), side == "right"
    rng = np.random.default_rng(5)
    functions = {x: getattr(jnp, x) for x in ("sin", "exp")}
    for _ in range(2):
        zeta, start, u = rng.normal(size=len(E)), rng.normal(size=m), rng.normal(size=len(E))
        g = np.eye(len(E[0]))

        def carried(g, start=start):
            moved = rho(g)
            return moved @ start if right else jnp.linalg.inv(moved) @ start

        def lagrangian(t, g, zeta, carried=carried):
            names = {f"zeta_{a}": x for a, x in enumerate(zeta, 1)}
            names |= {f"x_{i}": x for i, x in enumerate(carried(g), 1)}
            return eval(text, functions, names | {"t": t})

        x = np.array([*zeta, *start])
        dx = found.rhs(0.4, x, found.constants([]), u)
        expected = acceleration(lagrangian, E, 0.4, g, zeta, u, right=right)
        scale = max(1, np.abs(expected).max())
        assert np.abs(dx[: len(E)] - expected).max() < 1e-12 * scale
        with jax.enable_x64(True):
            _, rate = jax.jvp(carried, (jnp.asarray(g),), (jnp.tensordot(zeta, E, 1),))
            rate = np.asarray(rate)
        assert np.abs(dx[len(E) :] - rate).max() < 1e-12 * scale


def test_as_with_an_element_of_the_group():
    """The heavy top by its attitude: γ is the last row of A, and both are one motion."""
    reduced = problem("euler_poisson")
    names = {f"gamma_{i}": f"A_3{i}" for i in (1, 2, 3)}
    text = "(I1*zeta_1^2 + I2*zeta_2^2 + I3*zeta_3^2)/2 - c1*gamma_1 - c3*gamma_3"
    for old, new in names.items():
        text = text.replace(old, new)
    values = {x: y.default for x, y in reduced.parameters.items()}
    data = {"name": "whole", "group": "SO(3)", "lagrangian": {"L": text}, "parameters": values}
    one, two = module_of("euler_poisson"), module_of(problem_of(data))
    A, zeta = np.array(group("SO(3)").sample(Small(), 3), float), np.array([0.3, -0.8, 1.1])
    start = np.array([*zeta, *A[2]])
    runs = [
        solve_ivp(f.rhs, (0, 5), x, "DOP853", rtol=1e-12, atol=1e-12, args=(f.constants(k),))
        for f, x, k in (
            (one, start, one.DEFAULTS),
            (two, np.array([*A.reshape(-1), *zeta]), two.DEFAULTS),
        )
    ]
    end, whole = (run.y[:, -1] for run in runs)
    assert np.abs(end[:3] - whole[9:]).max() < 1e-9
    assert np.abs(end[3:] - whole[6:9]).max() < 1e-9
    k = one.constants(one.DEFAULTS)
    energies = [one.energy(0.0, x, k) for x in runs[0].y.T]
    assert max(energies) - min(energies) < 1e-9


class Small:
    """A source of small integers, always the same."""

    def __init__(self):
        self.left = [1, -2, 3, 1, 2, -1, 1, 1, 2]

    def randint(self, low, high):
        return max(low, min(high, self.left.pop()))
